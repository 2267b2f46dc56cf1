#include "coarse_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"

namespace lorica::viewport {
namespace {

using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3d;

TriangleMesh coarse(const TriangleMesh& mesh, const CoarseOptions& options = {}) {
  return {mesh.positions, coarseTriangles(mesh.positions, mesh.triangles, options)};
}

/// The box of the vertices that triangles use.
geometry::Box3d boxOf(const TriangleMesh& mesh) {
  geometry::Box3d box;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      box.extend(mesh.corner(t, k));
    }
  }
  return box;
}

const TriangleMesh& ball() {
  static const TriangleMesh mesh = geometry::ellipsoid(Vec3d(0.1, 1.2, 0.0), Vec3d(0.2, 0.3, 0.1), 5);
  return mesh;
}

TEST(CoarseTriangles, AreFewerOverTheSameVertices) {
  const TriangleMesh few = coarse(ball());
  ASSERT_FALSE(few.triangles.empty());
  EXPECT_LT(few.triangles.size(), ball().triangles.size() / 4);
  for (const Triangle& triangle : few.triangles) {
    EXPECT_LT(*std::max_element(triangle.begin(), triangle.end()), ball().positions.size());
    EXPECT_EQ(std::set<std::uint32_t>(triangle.begin(), triangle.end()).size(), 3U) << "a triangle has three corners";
  }
}

TEST(CoarseTriangles, KeepTheBoxAndTheVolumeWithinTheTolerance) {
  const CoarseOptions options;
  const TriangleMesh few = coarse(ball(), options);
  const geometry::Box3d whole = boxOf(ball());
  const geometry::Box3d box = boxOf(few);
  EXPECT_LT((box.min() - whole.min()).cwiseAbs().maxCoeff(), 2.0 * options.tolerance);
  EXPECT_LT((box.max() - whole.max()).cwiseAbs().maxCoeff(), 2.0 * options.tolerance);
  EXPECT_NEAR(geometry::signedVolume(few), geometry::signedVolume(ball()), options.tolerance * geometry::area(ball()));
}

TEST(CoarseTriangles, KeepAClosedSurfaceClosed) {
  const TriangleMesh few = coarse(ball());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& triangle : few.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{triangle.at(k), triangle.at((k + 1) % 3)}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first})) << "the neighbour's side of the edge";
  }
}

TEST(CoarseTriangles, MoreToleranceLeavesFewer) {
  const std::size_t fine = coarse(ball(), {0.0, 0, 0.0005}).triangles.size();
  const std::size_t rough = coarse(ball(), {0.0, 0, 0.01}).triangles.size();
  EXPECT_LT(rough, fine);
}

TEST(CoarseTriangles, AreNoFewerThanTheShareThatIsAskedFor) {
  const std::size_t kept = coarse(ball(), {0.5, 0, 1.0}).triangles.size();
  EXPECT_GE(kept, ball().triangles.size() / 2 - 2);
  EXPECT_LT(kept, ball().triangles.size());
}

TEST(CoarseTriangles, OfASmallMeshAreTheMesh) {
  const TriangleMesh small = geometry::ellipsoid(Vec3d::Zero(), Vec3d::Ones(), 2);
  EXPECT_EQ(coarse(small).triangles, small.triangles);
}

TEST(CoarseTriangles, AreTheSameEveryTime) {
  EXPECT_EQ(coarse(ball()).triangles, coarse(ball()).triangles);
}

TEST(CoarseTriangles, OfNothingAreNothing) {
  EXPECT_TRUE(coarseTriangles({}, {}).empty());
}

TEST(CoarseTriangles, OfAMeshWithoutExtentAreTheMesh) {
  const geometry::Positions point(3, geometry::Vec3f(1.0F, 2.0F, 3.0F));
  const std::vector<Triangle> one{{0, 1, 2}};
  EXPECT_EQ(coarseTriangles(point, one, {0.0, 0, 0.001}), one);
}

}  // namespace
}  // namespace lorica::viewport
