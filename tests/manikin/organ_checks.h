#pragma once

/// \file
/// What every body's organs are held to.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lorica/geometry/closest_point.h"
#include "lorica/geometry/intersections.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/geometry/winding.h"
#include "lorica/manikin/organs.h"

namespace lorica::manikin::test {

using geometry::TriangleMesh;
using geometry::Vec3d;

inline double smallestAngleOf(const TriangleMesh& mesh, std::size_t t) {
  double smallest = std::numbers::pi;
  for (int k = 0; k < 3; ++k) {
    const Vec3d u = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
    const Vec3d v = mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k);
    smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
  }
  return smallest;
}

inline void expectSound(const Organ& organ) {
  const geometry::MeshAudit audit = geometry::audit(organ.mesh);
  EXPECT_TRUE(audit.closed());
  EXPECT_EQ(audit.boundaryEdges, 0U);
  EXPECT_EQ(audit.oddEdges, 0U);
  EXPECT_EQ(audit.degenerateTriangles, 0U);
  EXPECT_EQ(audit.components.size(), organ.name == "eyes" || organ.name == "veins" ? 2U : 1U);
  for (const geometry::Component& component : audit.components) {
    EXPECT_GT(component.signedVolume, 0.0);
  }
  EXPECT_TRUE(geometry::selfIntersections(organ.mesh, {}).empty());
  std::size_t thin = 0;
  for (std::size_t t = 0; t < organ.mesh.triangles.size(); ++t) {
    thin += smallestAngleOf(organ.mesh, t) < 5.0 * std::numbers::pi / 180.0 ? 1 : 0;
  }
  EXPECT_LE(static_cast<double>(thin), 0.01 * static_cast<double>(organ.mesh.triangles.size()));
}

/// Least depth of vertices and triangle middles under the skin, m.
inline double depthUnder(const geometry::ClosestPointTree& skin, const TriangleMesh& mesh) {
  double least = 1.0;
  for (const geometry::Vec3f& p : mesh.positions) {
    least = std::min(least, -skin.signedDistance(p.cast<double>()));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    least = std::min(least, -skin.signedDistance((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0));
  }
  return least;
}

inline void expectApart(const Organ& a, const Organ& b) {
  EXPECT_TRUE(geometry::intersections(a.mesh, b.mesh, {}).empty()) << a.name << " meets " << b.name;
  // Nor does one lie within the other.
  EXPECT_LT(geometry::windingNumber(a.mesh, b.mesh.positions.front().cast<double>()), 0.5)
      << b.name << " in " << a.name;
  EXPECT_LT(geometry::windingNumber(b.mesh, a.mesh.positions.front().cast<double>()), 0.5)
      << a.name << " in " << b.name;
}

/// All that is asked of organs in a body.
inline void expectSoundOrgans(const Body& body, const std::vector<Organ>& organs) {
  const geometry::ClosestPointTree skin(body.skin);
  ASSERT_EQ(organs.size(), organNames().size());
  for (std::size_t i = 0; i < organs.size(); ++i) {
    const Organ& organ = organs[i];
    SCOPED_TRACE(organ.name);
    EXPECT_EQ(organ.name, organNames()[i]);
    ASSERT_FALSE(organ.mesh.triangles.empty());
    expectSound(organ);
    if (organ.targetVolume > 0.0) {
      EXPECT_NEAR(geometry::signedVolume(organ.mesh) / organ.targetVolume, 1.0, 0.01);
    }
    const bool deep = organ.name == "liver" || organ.name == "heart";
    const bool vessel = organ.name == "arteries" || organ.name == "veins";
    EXPECT_GE(depthUnder(skin, organ.mesh), deep ? 0.015 : vessel ? 0.0015 : 0.002);
    EXPECT_TRUE(geometry::intersections(organ.mesh, body.skin, {}).empty());
    for (std::size_t j = i + 1; j < organs.size(); ++j) {
      expectApart(organ, organs[j]);
    }
  }
}

}  // namespace lorica::manikin::test
