#pragma once

/// \file
/// Laying a tape around a field: level sections and their convex hulls.

#include <functional>
#include <vector>

#include "lorica/geometry/vectors.h"

namespace lorica::manikin {

/// What a tape and calipers read at a level section.
struct TapeReading {
  double girth = 0.0;    ///< of the convex hull
  double breadth = 0.0;  ///< side to side
  double depth = 0.0;    ///< back to front
};

/// Reads the part of a section that is seen from a point inside it.
/// \pre field(inside) < 0
TapeReading tapeAround(const std::function<double(const geometry::Vec3d&)>& field, const geometry::Vec3d& inside);

/// Girth of the convex hull of points in a plane.
double hullGirth(std::vector<Eigen::Vector2d> points);

}  // namespace lorica::manikin
