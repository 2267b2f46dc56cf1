#include "lorica/geometry/weld.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "shapes.h"

namespace lorica::geometry {
namespace {

/// The triangles of `mesh` in any order and from any corner on, each with three vertices of its own.
TriangleMesh drawnSoup(const TriangleMesh& mesh) {
  std::vector<Triangle> order = mesh.triangles;
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[*rc::gen::inRange<std::size_t>(0, i)]);
  }
  TriangleMesh soup;
  for (Triangle triangle : order) {
    std::rotate(triangle.begin(), triangle.begin() + *rc::gen::inRange(0, 3), triangle.end());
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    soup.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t vertex : triangle) {
      soup.positions.push_back(mesh.positions[vertex]);
    }
  }
  return soup;
}

RC_GTEST_PROP(Weld, RestoresTheMeshBehindATriangleSoup, ()) {
  const TriangleMesh mesh = test::drawnSolid(test::drawnPoint(-2, 2), 0.01, 1.0);
  const TriangleMesh soup = drawnSoup(mesh);
  RC_ASSERT(!audit(soup).closed());
  const Welded welded = weld(soup);
  RC_ASSERT(welded.mesh.positions.size() == mesh.positions.size());
  RC_ASSERT(welded.mesh.triangles.size() == mesh.triangles.size());
  RC_ASSERT(welded.droppedTriangles == 0U);
  RC_ASSERT(audit(welded.mesh).closed());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      RC_ASSERT(welded.mesh.corner(t, k) == soup.corner(t, k));
    }
  }
}

RC_GTEST_PROP(Weld, KeepsTheFirstOfEachPositionAndGroup, ()) {
  constexpr float values[] = {-0.0F, 0.0F, 1.0F, -1.0F, 1e-45F, 1e30F};
  const auto value = [&] { return values[*rc::gen::inRange(0, 6)]; };
  TriangleMesh mesh;
  std::vector<std::uint32_t> group;
  const auto count = *rc::gen::inRange<std::size_t>(0, 300);
  std::set<std::tuple<float, float, float, std::uint32_t>> seen;  // compares by value, so 0 is -0 here too
  std::vector<std::uint32_t> firsts;
  for (std::size_t v = 0; v < count; ++v) {
    const float x = value();
    const float y = value();
    const float z = value();
    mesh.positions.emplace_back(x, y, z);
    group.push_back(*rc::gen::element(0U, 1U, 4294967295U));
    if (seen.insert({x, y, z, group.back()}).second) {
      firsts.push_back(static_cast<std::uint32_t>(v));
    }
  }
  const Welded welded = weld(mesh, group);
  RC_ASSERT(welded.sourceOf == firsts);
  RC_ASSERT(welded.mesh.positions.size() == firsts.size());
  for (std::size_t v = 0; v < firsts.size(); ++v) {
    RC_ASSERT(welded.mesh.positions[v] == mesh.positions[firsts[v]]);
  }
}

TEST(Weld, KeepsGroupsApart) {
  const TriangleMesh cube = box(Vec3d::Zero(), Vec3d(1, 1, 1));
  TriangleMesh twice = cube;
  append(twice, cube);
  EXPECT_EQ(weld(twice).mesh.positions.size(), 8U);
  std::vector<std::uint32_t> group(8, 0);
  group.resize(16, 7);
  const Welded apart = weld(twice, group);
  EXPECT_EQ(apart.mesh.positions.size(), 16U);
  EXPECT_EQ(audit(apart.mesh).components.size(), 2U);
  EXPECT_TRUE(audit(apart.mesh).closed());
}

TEST(Weld, TakesMinusZeroForZero) {
  TriangleMesh mesh;
  mesh.positions = {{0.0F, -0.0F, 0.0F}, {1, 0, 0}, {0, 1, 0}, {-0.0F, 0.0F, -0.0F}, {0, 1, -0.0F}, {-1, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const Welded welded = weld(mesh);
  EXPECT_EQ(welded.mesh.positions.size(), 4U);
  EXPECT_EQ(welded.mesh.triangles[1], (Triangle{0, 2, 3}));
  EXPECT_EQ(audit(welded.mesh).boundaryEdges, 4U);
}

TEST(Weld, LeavesNeighboursApartThatDifferByOneFloatStep) {
  TriangleMesh mesh;
  mesh.positions = {{1, 0, 0}, {std::nextafter(1.0F, 2.0F), 0, 0}, {1, std::numeric_limits<float>::denorm_min(), 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(weld(mesh).mesh.positions.size(), 3U);
}

TEST(Weld, DropsTrianglesThatUseOneVertexTwice) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {3, 2, 0}};
  const Welded welded = weld(mesh);
  EXPECT_EQ(welded.droppedTriangles, 1U);
  EXPECT_EQ(welded.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 2, 0}}));
}

TEST(Weld, OfAWeldedMeshChangesNothing) {
  const TriangleMesh mesh = ellipsoid(Vec3d::Zero(), Vec3d(1, 2, 3), 3);
  const Welded again = weld(mesh);
  EXPECT_EQ(again.mesh.positions, mesh.positions);
  EXPECT_EQ(again.mesh.triangles, mesh.triangles);
}

TEST(Weld, OfNothingIsNothing) {
  EXPECT_TRUE(weld({}).mesh.positions.empty());
}

TEST(Weld, RefusesGroupsThatDoNotFitTheVertices) {
  const std::vector<std::uint32_t> group(7, 0);
  EXPECT_THROW(weld(box(Vec3d::Zero(), Vec3d(1, 1, 1)), group), base::CallerError);
}

}  // namespace
}  // namespace lorica::geometry
