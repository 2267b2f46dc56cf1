#pragma once

/// \file
/// Scalar fields for isosurfaces: negative inside, near the surface about the distance to it in metres.

#include <algorithm>
#include <cmath>
#include <span>

#include "lorica/geometry/vectors.h"

namespace lorica::manikin {

using geometry::Vec3d;

/// 0 below `low`, 1 above `high`, with level ends.
inline double smoothStep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Union of two fields, filleted where they are within `fillet` metres of each other.
inline double smoothUnion(double a, double b, double fillet) {
  const double overlap = std::max(fillet - std::abs(a - b), 0.0) / fillet;
  return std::min(a, b) - 0.25 * fillet * overlap * overlap;
}

/// The left counterpart of a point.
inline Vec3d mirroredToLeft(const Vec3d& p) {
  return {std::abs(p.x()), p.y(), p.z()};
}

inline double smoothIntersection(double a, double b, double fillet) {
  return -smoothUnion(-a, -b, fillet);
}

inline double ellipsoidField(const Vec3d& p, const Vec3d& centre, const Vec3d& semiAxes) {
  const Vec3d scaled = (p - centre).cwiseQuotient(semiAxes);
  const double radius = scaled.norm();
  const double slope = scaled.cwiseQuotient(semiAxes).norm();
  return slope < 1e-9 ? -semiAxes.minCoeff() : radius * (radius - 1.0) / slope;
}

/// A capsule whose radius runs evenly from one end to the other.
inline double taperedCapsule(const Vec3d& p, const Vec3d& from, const Vec3d& to, double fromRadius, double toRadius) {
  const Vec3d axis = to - from;
  const double along = std::clamp((p - from).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - from - along * axis).norm() - (fromRadius + along * (toRadius - fromRadius));
}

/// A point of a limb's axis and the limb's radius there.
struct Station {
  Vec3d place;
  double radius;
};

/// A round limb along a polyline, its radius running evenly between the stations. \pre two stations at least
inline double limbField(const Vec3d& p, std::span<const Station> limb) {
  double nearest = taperedCapsule(p, limb[0].place, limb[1].place, limb[0].radius, limb[1].radius);
  for (std::size_t i = 1; i + 1 < limb.size(); ++i) {
    nearest =
        std::min(nearest, taperedCapsule(p, limb[i].place, limb[i + 1].place, limb[i].radius, limb[i + 1].radius));
  }
  return nearest;
}

}  // namespace lorica::manikin
