#pragma once

/// \file
/// Meshes and motions for the tests of geometry.

#include <rapidcheck.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "lorica/geometry/primitives.h"
#include "lorica/geometry/transform.h"

namespace lorica::geometry::test {

inline TriangleMesh insideOut(TriangleMesh mesh) {
  for (Triangle& triangle : mesh.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

inline TriangleMesh moved(const TriangleMesh& mesh, const RigidTransform& transform) {
  return {transformed(mesh.positions, transform), mesh.triangles};
}

/// A whole number of thousandths from `low` to `high`: floats hold such numbers well enough, and they shrink well.
inline double drawn(double low, double high) {
  return *rc::gen::inRange(static_cast<int>(low * 1000), static_cast<int>(high * 1000) + 1) / 1000.0;
}

inline Vec3d drawnPoint(double low, double high) {
  const double x = drawn(low, high);
  const double y = drawn(low, high);
  return {x, y, drawn(low, high)};
}

/// Any rotation, and a translation of at most `reach` along each axis.
inline RigidTransform drawnMotion(double reach) {
  const Vec3d axis = drawnPoint(-1.0, 1.0);
  const double angle = drawn(-std::numbers::pi, std::numbers::pi);
  const Vec3d turned = axis.norm() > 0.0 ? Vec3d(axis.normalized()) : Vec3d(Vec3d::UnitY());
  return {Quatd(Eigen::AngleAxisd(angle, turned)), drawnPoint(-reach, reach)};
}

/// A box or an ellipsoid around `centre`, its half sizes from `smallest` to `largest`.
inline TriangleMesh drawnSolid(const Vec3d& centre, double smallest, double largest) {
  const Vec3d half = drawnPoint(smallest, largest);
  return *rc::gen::arbitrary<bool>() ? box(centre - half, centre + half) : ellipsoid(centre, half, 1);
}

/// Vertices - edges + triangles of a closed mesh, all of whose vertices are used and all of whose edges join two
/// triangles: 2 for a sphere, 0 for a torus.
inline long eulerCharacteristic(const TriangleMesh& mesh) {
  const auto triangles = static_cast<long>(mesh.triangles.size());
  return static_cast<long>(mesh.positions.size()) - triangles * 3 / 2 + triangles;
}

}  // namespace lorica::geometry::test
