#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/geometry/winding.h"
#include "shapes.h"

namespace lorica::geometry {
namespace {

TriangleMesh cube(double half) {
  return box(Vec3d::Constant(-half), Vec3d::Constant(half));
}

bool inStep(const TriangleMesh& mesh, const MeshAudit& kept) {
  const MeshAudit fresh = audit(mesh);
  bool same = kept.componentOf == fresh.componentOf && kept.openEdge == fresh.openEdge &&
              kept.boundaryEdges == fresh.boundaryEdges && kept.oddEdges == fresh.oddEdges &&
              kept.degenerateTriangles == fresh.degenerateTriangles &&
              kept.components.size() == fresh.components.size();
  for (std::size_t c = 0; same && c < fresh.components.size(); ++c) {
    const Component& a = kept.components[c];
    const Component& b = fresh.components[c];
    same = a.triangles == b.triangles && a.closed == b.closed && std::abs(a.signedVolume - b.signedVolume) < 1e-12;
  }
  return same;
}

TriangleMesh component(const TriangleMesh& mesh, const MeshAudit& found, std::size_t wanted) {
  TriangleMesh piece{mesh.positions, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (found.componentOf[t] == wanted) {
      piece.triangles.push_back(mesh.triangles[t]);
    }
  }
  return piece;
}

/// Does another component, closed and facing outwards, wind around the first corner of component `c`?
bool liesInside(const TriangleMesh& mesh, const MeshAudit& found, std::size_t c) {
  const Vec3d probe = component(mesh, found, c).corner(0, 0);
  for (std::size_t other = 0; other < found.components.size(); ++other) {
    if (other != c && found.components[other].closed && found.components[other].signedVolume > 0.0 &&
        windingNumber(component(mesh, found, other), probe) > 0.5) {
      return true;
    }
  }
  return false;
}

TEST(TurnInsideOut, TurnsALoneBox) {
  TriangleMesh mesh = test::insideOut(cube(1));
  MeshAudit found = audit(mesh);
  EXPECT_EQ(turnInsideOutComponents(mesh, found), 1U);
  EXPECT_DOUBLE_EQ(signedVolume(mesh), 8.0);
  EXPECT_TRUE(inStep(mesh, found));
}

TEST(TurnInsideOut, LeavesOutwardComponentsAlone) {
  TriangleMesh mesh = cube(2);
  append(mesh, cube(1));
  const std::vector<Triangle> before = mesh.triangles;
  MeshAudit found = audit(mesh);
  EXPECT_EQ(turnInsideOutComponents(mesh, found), 0U);
  EXPECT_EQ(mesh.triangles, before);
}

TEST(TurnInsideOut, KeepsAnInnerBoxAsACavity) {
  TriangleMesh mesh = test::insideOut(cube(1));
  append(mesh, cube(2));
  MeshAudit found = audit(mesh);
  EXPECT_EQ(turnInsideOutComponents(mesh, found), 0U);
  EXPECT_DOUBLE_EQ(signedVolume(mesh), 64.0 - 8.0);
  EXPECT_TRUE(inStep(mesh, found));
}

TEST(TurnInsideOut, TellsABoxBesideFromABoxInside) {
  TriangleMesh mesh = cube(2);
  append(mesh, test::insideOut(cube(1)));
  append(mesh, test::insideOut(box(Vec3d(3, 0, 0), Vec3d(4, 1, 1))));
  MeshAudit found = audit(mesh);
  EXPECT_EQ(turnInsideOutComponents(mesh, found), 1U);
  EXPECT_DOUBLE_EQ(found.components.at(1).signedVolume, -8.0);
  EXPECT_DOUBLE_EQ(found.components.at(2).signedVolume, 1.0);
  EXPECT_TRUE(inStep(mesh, found));
}

TEST(TurnInsideOut, IsNotFooledByABoundingBox) {
  // The small cube sits in a corner of the ball's bounding box, outside the ball.
  TriangleMesh mesh = ellipsoid(Vec3d::Zero(), Vec3d(1, 1, 1), 3);
  append(mesh, test::insideOut(box(Vec3d(0.8, 0.8, 0.8), Vec3d(0.9, 0.9, 0.9))));
  MeshAudit found = audit(mesh);
  EXPECT_EQ(turnInsideOutComponents(mesh, found), 1U);
  EXPECT_GT(found.components.at(1).signedVolume, 0.0);
}

TEST(TurnInsideOut, LeavesOpenComponentsAlone) {
  TriangleMesh mesh = test::insideOut(cube(1));
  mesh.triangles.pop_back();
  const std::vector<Triangle> before = mesh.triangles;
  append(mesh, test::insideOut(box(Vec3d(3, 0, 0), Vec3d(4, 1, 1))));
  MeshAudit found = audit(mesh);
  EXPECT_EQ(turnInsideOutComponents(mesh, found), 1U);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), mesh.triangles.begin()));
  EXPECT_TRUE(inStep(mesh, found));
}

TEST(TurnInsideOut, TurnsTheOuterOfTwoNestedBoxes) {
  TriangleMesh mesh = test::insideOut(cube(2));
  append(mesh, cube(1));
  MeshAudit found = audit(mesh);
  EXPECT_EQ(turnInsideOutComponents(mesh, found), 1U);
  EXPECT_DOUBLE_EQ(found.components.at(0).signedVolume, 64.0);
  EXPECT_DOUBLE_EQ(found.components.at(1).signedVolume, 8.0);
  EXPECT_TRUE(inStep(mesh, found));
}

RC_GTEST_PROP(TurnInsideOut, TurnsSolidsThatStandApart, ()) {
  TriangleMesh mesh;
  std::size_t flipped = 0;
  const int solids = *rc::gen::inRange(1, 6);
  for (int i = 0; i < solids; ++i) {
    const TriangleMesh solid = test::drawnSolid(Vec3d(3.0 * i, 0, 0), 0.1, 1.0);
    const bool flip = *rc::gen::arbitrary<bool>();
    flipped += flip ? 1 : 0;
    append(mesh, flip ? test::insideOut(solid) : solid);
  }
  MeshAudit found = audit(mesh);
  RC_ASSERT(turnInsideOutComponents(mesh, found) == flipped);
  RC_ASSERT(inStep(mesh, found));
  for (const Component& c : found.components) {
    RC_ASSERT(c.signedVolume > 0.0);
  }
}

RC_GTEST_PROP(TurnInsideOut, LeavesOnlyCavitiesOfSolidsThatOverlapAtRandom, ()) {
  TriangleMesh mesh;
  const int solids = *rc::gen::inRange(1, 7);
  for (int i = 0; i < solids; ++i) {
    const TriangleMesh solid = test::drawnSolid(test::drawnPoint(-1, 1), 0.1, 1.0);
    append(mesh, *rc::gen::arbitrary<bool>() ? test::insideOut(solid) : solid);
  }
  const TriangleMesh before = mesh;
  const MeshAudit auditBefore = audit(before);
  MeshAudit found = auditBefore;
  const std::size_t turned = turnInsideOutComponents(mesh, found);
  RC_ASSERT(inStep(mesh, found));
  RC_ASSERT(mesh.positions == before.positions);
  std::size_t changed = 0;
  for (std::size_t c = 0; c < found.components.size(); ++c) {
    const double was = auditBefore.components[c].signedVolume;
    const double is = found.components[c].signedVolume;
    RC_ASSERT(std::abs(std::abs(is) - std::abs(was)) < 1e-12);
    RC_ASSERT(was < 0.0 || is > 0.0);
    RC_ASSERT(is > 0.0 || liesInside(mesh, found, c));
    RC_ASSERT(!(was < 0.0 && is > 0.0 && liesInside(before, auditBefore, c)));
    changed += (was < 0.0) != (is < 0.0) ? 1 : 0;
  }
  RC_ASSERT(turned == changed);
  RC_ASSERT(turnInsideOutComponents(mesh, found) == 0U);
}

}  // namespace
}  // namespace lorica::geometry
