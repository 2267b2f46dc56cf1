#pragma once

#include "lorica/geometry/vectors.h"

namespace lorica::geometry {

/// Rotation about the origin, then translation (metres).
struct RigidTransform {
  Quatd rotation = Quatd::Identity();
  Vec3d translation = Vec3d::Zero();

  Vec3d operator*(const Vec3d& point) const { return rotation * point + translation; }
  RigidTransform operator*(const RigidTransform& first) const {
    return {(rotation * first.rotation).normalized(), rotation * first.translation + translation};
  }
  RigidTransform inverse() const {
    const Quatd back = rotation.conjugate();
    return {back, -(back * translation)};
  }
  /// True only for the exact identity, which leaves every vertex bit for bit as it is.
  bool isIdentity() const { return rotation.coeffs() == Quatd::Identity().coeffs() && translation == Vec3d::Zero(); }
};

/// Moves points by `transform`, computed in double precision. The exact identity returns the same bits.
Positions transformed(const Positions& points, const RigidTransform& transform);

/// Right-handed orthonormal basis change for files whose z axis points up: (x, y, z) becomes (x, z, -y).
Mat3d zUpToYUp();

}  // namespace lorica::geometry
