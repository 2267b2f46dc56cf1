#pragma once

/// \file
/// What must hold for a plate on any standing body.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lorica/armor/plates.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/winding.h"

namespace lorica::armor {

using geometry::Vec3d;

inline double distanceToSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

inline double distanceToTriangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d normal = (b - a).cross(c - a);
  const bool above = normal.dot((b - a).cross(p - a)) >= 0.0 && normal.dot((c - b).cross(p - b)) >= 0.0 &&
                     normal.dot((a - c).cross(p - c)) >= 0.0;
  if (above && normal.squaredNorm() > 0.0) {
    return std::abs(normal.dot(p - a)) / normal.norm();
  }
  return std::min({distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
}

/// The triangles of a mesh that reach into a box.
inline geometry::TriangleMesh partIn(const geometry::TriangleMesh& mesh, const geometry::Box3d& box) {
  geometry::TriangleMesh part{mesh.positions, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    geometry::Box3d own(mesh.corner(t, 0));
    own.extend(mesh.corner(t, 1));
    own.extend(mesh.corner(t, 2));
    if (own.intersects(box)) {
      part.triangles.push_back(mesh.triangles[t]);
    }
  }
  return part;
}

inline double distanceTo(const geometry::TriangleMesh& mesh, const Vec3d& p) {
  double nearest = 1e9;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    nearest = std::min(nearest, distanceToTriangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
  }
  return nearest;
}

/// Neither is any vertex of the plate inside the skin nor one of the skin inside the plate.
inline void expectOutside(const geometry::TriangleMesh& plate, const geometry::TriangleMesh& skin) {
  for (std::size_t v = 0; v < plate.positions.size(); v += 3) {
    ASSERT_NEAR(geometry::windingNumber(skin, plate.positions[v].cast<double>()), 0.0, 0.01) << "plate vertex " << v;
  }
  const geometry::Box3d box = geometry::bounds(plate.positions);
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    const Vec3d p = skin.positions[v].cast<double>();
    if (box.contains(p)) {
      ASSERT_NEAR(geometry::windingNumber(plate, p), 0.0, 0.01) << "skin vertex " << v;
    }
  }
}

struct Gaps {
  double smallest = 1e9;
  double largest = 0.0;
};

/// Distances of the plate's vertices on the body's side (those that face it) to the skin.
inline Gaps gapsBehind(const geometry::TriangleMesh& plate, const geometry::TriangleMesh& skin, PlateSide side) {
  geometry::Box3d around = geometry::bounds(plate.positions);
  around.min().array() -= 0.1;
  around.max().array() += 0.1;
  const geometry::TriangleMesh near = partIn(skin, around);
  const auto normals = geometry::vertexNormals(plate.positions, plate.triangles);
  const double inward = side == PlateSide::front ? -1.0 : 1.0;
  Gaps gaps;
  for (std::size_t v = 0; v < plate.positions.size(); ++v) {
    const double gap = distanceTo(near, plate.positions[v].cast<double>());
    gaps.smallest = std::min(gaps.smallest, gap);
    if (inward * static_cast<double>(normals[v].z()) > 0.5) {
      gaps.largest = std::max(gaps.largest, gap);
    }
  }
  return gaps;
}

/// z of the area-weighted mean normal of the convex face: the triangles that face away from the body.
inline double meanOutwardZ(const geometry::TriangleMesh& plate, PlateSide side) {
  const double outward = side == PlateSide::front ? 1.0 : -1.0;
  Vec3d sum = Vec3d::Zero();
  for (std::size_t t = 0; t < plate.triangles.size(); ++t) {
    const Vec3d normal = (plate.corner(t, 1) - plate.corner(t, 0)).cross(plate.corner(t, 2) - plate.corner(t, 0));
    if (outward * normal.z() > 0.0) {
      sum += normal;
    }
  }
  return sum.normalized().z();
}

inline double middleX(const geometry::TriangleMesh& mesh) {
  return geometry::bounds(mesh.positions).center().x();
}
inline double topY(const geometry::TriangleMesh& mesh) {
  return geometry::bounds(mesh.positions).max().y();
}

}  // namespace lorica::armor
