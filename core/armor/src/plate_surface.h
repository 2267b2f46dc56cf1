#pragma once

/// \file
/// The faces of a plate as functions.

#include <algorithm>
#include <cmath>

#include "lorica/armor/plates.h"

namespace lorica::armor {

/// Half the plate's chord at a height above its lower edge.
inline double halfWidthAt(const PlateSpec& spec, double height) {
  const double cut = std::clamp((height - (spec.height - spec.cornerHeight)) / spec.cornerHeight, 0.0, 1.0);
  return 0.5 * (spec.width + cut * (spec.topWidth - spec.width));
}

/// A point of the plate in its own frame.
/// \param across -1 at the edge towards -x, 1 at the edge towards +x
/// \param height above the lower edge
/// \param depth 0 on the front face, 1 on the back face
inline geometry::Vec3d platePoint(const PlateSpec& spec, double across, double height, double depth) {
  const double widest = std::asin(0.5 * spec.width / spec.curvatureRadius);
  const double angle = across * std::asin(halfWidthAt(spec, height) / spec.curvatureRadius);
  const double radius = spec.curvatureRadius - depth * spec.thickness;
  const double hindmost = (spec.curvatureRadius - spec.thickness) * std::cos(widest);
  const double middle = 0.5 * (spec.curvatureRadius + hindmost);
  return {radius * std::sin(angle), height - 0.5 * spec.height, radius * std::cos(angle) - middle};
}

}  // namespace lorica::armor
