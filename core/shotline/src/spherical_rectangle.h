#pragma once

#include <array>

#include "lorica/geometry/vectors.h"

namespace lorica::shotline {

/// Directions spread evenly over the solid angle of a rectangle across the z axis, its middle on that axis: C. Urena,
/// M. Fajardo and A. King, "An area-preserving parametrization for spherical rectangles", Comput. Graph. Forum 32
/// (2013).
class SphericalRectangle {
 public:
  /// \pre all are positive
  SphericalRectangle(double width, double height, double distance);

  double solidAngle() const { return solidAngle_; }
  /// A point of the rectangle as seen from the origin, from two numbers in [0, 1).
  geometry::Vec3d point(const std::array<double, 2>& u) const;

 private:
  double halfWidth_;
  double halfHeight_;
  double distance_;
  double slope_;  ///< of the normals of the planes through the level edges
  double turn_;   ///< the constant k of the paper
  double solidAngle_;
};

}  // namespace lorica::shotline
