#include "lorica/geometry/mesh_audit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <numeric>
#include <set>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/weld.h"
#include "shapes.h"

namespace lorica::geometry {
namespace {

TriangleMesh unitBox() {
  return box(Vec3d::Zero(), Vec3d(1, 1, 1));
}

std::size_t openEdges(const MeshAudit& found) {
  return static_cast<std::size_t>(std::count(found.openEdge.begin(), found.openEdge.end(), true));
}

/// The audit by the book: every edge in a map, components by spreading labels until nothing changes.
MeshAudit slowAudit(const TriangleMesh& mesh) {
  MeshAudit result;
  std::vector<std::uint32_t> label(mesh.positions.size());
  std::iota(label.begin(), label.end(), 0U);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Triangle& t : mesh.triangles) {
      const std::uint32_t least = std::min({label[t[0]], label[t[1]], label[t[2]]});
      for (const std::uint32_t vertex : t) {
        changed = changed || label[vertex] != least;
        label[vertex] = least;
      }
    }
  }
  std::map<std::uint32_t, std::uint32_t> componentOfLabel;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<int, int>> ways;  // uses up and down
  for (const Triangle& t : mesh.triangles) {
    const auto fresh = static_cast<std::uint32_t>(componentOfLabel.size());
    result.componentOf.push_back(componentOfLabel.try_emplace(label[t[0]], fresh).first->second);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k];
      const std::uint32_t to = t[(k + 1) % 3];
      auto& [up, down] = ways[std::minmax(from, to)];
      ++(from < to ? up : down);
    }
  }
  result.components.assign(componentOfLabel.size(), {0, true, 0.0});
  for (const auto& [edge, uses] : ways) {
    const auto [up, down] = uses;
    result.boundaryEdges += up + down == 1 ? 1 : 0;
    result.oddEdges += up + down > 2 || up == 2 || down == 2 ? 1 : 0;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Component& component = result.components[result.componentOf[t]];
    ++component.triangles;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [up, down] = ways[std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])];
      result.openEdge.push_back(up != down);
      component.closed = component.closed && up == down;
    }
  }
  return result;
}

RC_GTEST_PROP(Audit, AgreesWithTheOneByTheBook, ()) {
  TriangleMesh mesh;
  const auto vertices = *rc::gen::inRange<std::uint32_t>(3, 20);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    mesh.positions.emplace_back(test::drawnPoint(-1, 1).cast<float>());
  }
  const auto triangles = *rc::gen::inRange(0, 40);
  for (int t = 0; t < triangles; ++t) {
    const auto a = *rc::gen::inRange<std::uint32_t>(0, vertices);
    const auto b = (a + *rc::gen::inRange<std::uint32_t>(1, vertices)) % vertices;
    const auto c = *rc::gen::distinctFrom(rc::gen::inRange<std::uint32_t>(0, vertices), a);
    if (b != c) {
      mesh.triangles.push_back({a, b, c});
    }
  }
  const MeshAudit found = audit(mesh);
  const MeshAudit expected = slowAudit(mesh);
  RC_ASSERT(found.componentOf == expected.componentOf);
  RC_ASSERT(found.openEdge == expected.openEdge);
  RC_ASSERT(found.boundaryEdges == expected.boundaryEdges);
  RC_ASSERT(found.oddEdges == expected.oddEdges);
  RC_ASSERT(found.components.size() == expected.components.size());
  for (std::size_t c = 0; c < found.components.size(); ++c) {
    RC_ASSERT(found.components[c].triangles == expected.components[c].triangles);
    RC_ASSERT(found.components[c].closed == expected.components[c].closed);
  }
}

TEST(Audit, OfABoxIsClosed) {
  const MeshAudit found = audit(unitBox());
  EXPECT_TRUE(found.closed());
  ASSERT_EQ(found.components.size(), 1U);
  EXPECT_EQ(found.components[0].triangles, 12U);
  EXPECT_DOUBLE_EQ(found.components[0].signedVolume, 1.0);
  EXPECT_EQ(found.boundaryEdges, 0U);
  EXPECT_EQ(found.oddEdges, 0U);
  EXPECT_EQ(found.degenerateTriangles, 0U);
  EXPECT_EQ(openEdges(found), 0U);
}

TEST(Audit, OfABoxWithoutAFaceFindsItsRim) {
  TriangleMesh mesh = unitBox();
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);  // the face z = 0
  const MeshAudit found = audit(mesh);
  EXPECT_FALSE(found.closed());
  EXPECT_FALSE(found.components.at(0).closed);
  EXPECT_EQ(found.boundaryEdges, 4U);
  EXPECT_EQ(found.oddEdges, 0U);
  EXPECT_EQ(openEdges(found), 4U);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const bool onRim = mesh.corner(t, k).z() == 0.0 && mesh.corner(t, (k + 1) % 3).z() == 0.0;
      EXPECT_EQ(found.openEdge[3 * t + static_cast<std::size_t>(k)], onRim) << "triangle " << t << " side " << k;
    }
  }
}

TEST(Audit, FindsTwoComponentsInTheOrderOfTheirTriangles) {
  TriangleMesh mesh = box(Vec3d(5, 0, 0), Vec3d(6, 2, 3));
  append(mesh, ellipsoid(Vec3d::Zero(), Vec3d(1, 1, 1), 1));
  mesh.triangles.pop_back();
  const MeshAudit found = audit(mesh);
  ASSERT_EQ(found.components.size(), 2U);
  EXPECT_EQ(found.components[0].triangles, 12U);
  EXPECT_TRUE(found.components[0].closed);
  EXPECT_DOUBLE_EQ(found.components[0].signedVolume, 6.0);
  EXPECT_EQ(found.components[1].triangles, 79U);
  EXPECT_FALSE(found.components[1].closed);
  EXPECT_FALSE(found.closed());
  EXPECT_EQ(found.boundaryEdges, 3U);
}

TEST(Audit, OfADuplicateTriangleFindsOddEdges) {
  TriangleMesh mesh = unitBox();
  mesh.triangles.push_back(mesh.triangles.front());
  const MeshAudit found = audit(mesh);
  EXPECT_EQ(found.oddEdges, 3U);
  EXPECT_EQ(found.boundaryEdges, 0U);
  EXPECT_EQ(openEdges(found), 9U) << "three edges of three uses each";
  EXPECT_FALSE(found.closed());
}

TEST(Audit, OfAFlippedTriangleFindsEdgesUsedTwiceInOneDirection) {
  TriangleMesh mesh = unitBox();
  std::swap(mesh.triangles[4][1], mesh.triangles[4][2]);
  const MeshAudit found = audit(mesh);
  EXPECT_EQ(found.oddEdges, 3U);
  EXPECT_EQ(found.boundaryEdges, 0U);
  EXPECT_FALSE(found.closed());
}

TEST(Audit, OfBoxesThatShareAnEdgeIsClosedThoughTheEdgeIsOdd) {
  TriangleMesh mesh = unitBox();
  append(mesh, box(Vec3d(1, 1, 0), Vec3d(2, 2, 1)));
  const MeshAudit found = audit(weld(mesh).mesh);
  EXPECT_EQ(found.components.size(), 1U);
  EXPECT_EQ(found.oddEdges, 1U);
  EXPECT_TRUE(found.closed());
  EXPECT_DOUBLE_EQ(found.components[0].signedVolume, 2.0);
}

TEST(Audit, CountsTrianglesWithoutArea) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_EQ(audit(mesh).degenerateTriangles, 1U);
}

TEST(Audit, OfNothingIsNotClosed) {
  EXPECT_FALSE(audit({}).closed());
}

TEST(Audit, OfAnInsideOutBoxHasANegativeVolume) {
  const MeshAudit found = audit(test::insideOut(unitBox()));
  EXPECT_TRUE(found.closed());
  EXPECT_DOUBLE_EQ(found.components.at(0).signedVolume, -1.0);
}

}  // namespace
}  // namespace lorica::geometry
