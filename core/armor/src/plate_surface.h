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

/// A point over the front face, whose middle is at the origin: a circle of the horizontal radius swept about a
/// horizontal axis behind it, so that what is equally far off the face is parallel to it.
/// \param angle about the vertical axis of the circle
/// \param above the middle of the plate, along the chord of its middle line
/// \param off the face, outward
inline geometry::Vec3d bentPoint(const PlateSpec& spec, double angle, double above, double off) {
  const double radius = spec.curvatureRadius + off;
  const double behind = radius * std::cos(angle) - spec.curvatureRadius;
  const double across = radius * std::sin(angle);
  if (spec.verticalCurvature == 0.0) {
    return {across, above, behind};
  }
  const double sine = above * spec.verticalCurvature;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double axis = 1.0 / spec.verticalCurvature;
  return {across, (axis + behind) * sine, (axis + behind) * cosine - axis};
}

/// z of the middle of the plate's box in the frame of bentPoint().
inline double boxMiddle(const PlateSpec& spec) {
  const double widest = std::asin(0.5 * spec.width / spec.curvatureRadius);
  return 0.5 * bentPoint(spec, widest, -0.5 * spec.height, -spec.thickness).z();
}

/// A point of the plate in its own frame.
/// \param across -1 at the edge towards -x, 1 at the edge towards +x
/// \param height above the lower edge
/// \param depth 0 on the front face, 1 on the back face
inline geometry::Vec3d platePoint(const PlateSpec& spec, double across, double height, double depth) {
  const double angle = across * std::asin(halfWidthAt(spec, height) / spec.curvatureRadius);
  geometry::Vec3d p = bentPoint(spec, angle, height - 0.5 * spec.height, -depth * spec.thickness);
  p.z() -= boxMiddle(spec);
  return p;
}

}  // namespace lorica::armor
