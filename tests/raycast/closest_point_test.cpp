#include <gtest/gtest.h>

#include <random>

#include "lorica/geometry/primitives.h"
#include "lorica/raycast/scene.h"

namespace lorica::raycast {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;

/// Nearest of many points spread over every triangle: an upper bound that closes in on the answer.
double nearestSample(const TriangleMesh& mesh, const Vec3d& query) {
  double best = 1e9;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; i + j <= 8; ++j) {
        const double u = i / 8.0;
        const double v = j / 8.0;
        const Vec3d point = (1 - u - v) * mesh.corner(t, 0) + u * mesh.corner(t, 1) + v * mesh.corner(t, 2);
        best = std::min(best, (point - query).norm());
      }
    }
  }
  return best;
}

TEST(ClosestPoint, OnABoxIsTheClampedPoint) {
  const TriangleMesh cube = geometry::box({-1, -2, -3}, {1, 2, 3});
  Scene scene(SceneUse::manyRays);
  scene.add(cube.positions, makeTopology(cube));
  scene.build();
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> spread(-5, 5);
  for (int i = 0; i < 300; ++i) {
    const Vec3d query(spread(engine), spread(engine), spread(engine));
    const Vec3d clamped = query.cwiseMax(Vec3d(-1, -2, -3)).cwiseMin(Vec3d(1, 2, 3));
    if ((clamped - query).norm() < 1e-6) {
      continue;
    }
    const auto found = closestPoint(scene, query);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance, (clamped - query).norm(), 1e-9);
    EXPECT_LT((found->point - clamped).norm(), 1e-9);
    EXPECT_NEAR(found->barycentric.sum(), 1.0, 1e-12);
  }
}

TEST(ClosestPoint, IsNeverFartherThanAnySampleOfTheSurface) {
  const TriangleMesh blob = geometry::ellipsoid({0.1, 0, 0}, {0.5, 1, 0.3}, 2);
  Scene scene(SceneUse::manyRays);
  scene.add(blob.positions, makeTopology(blob));
  scene.build();
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> spread(-1.5, 1.5);
  for (int i = 0; i < 100; ++i) {
    const Vec3d query(spread(engine), spread(engine), spread(engine));
    const double sampled = nearestSample(blob, query);
    const auto found = closestPoint(scene, query);
    ASSERT_TRUE(found);
    EXPECT_LE(found->distance, sampled + 1e-12);
    EXPECT_GE(found->distance, sampled - 0.05);
  }
}

TEST(ClosestPoint, FindsNothingBeyondItsRadius) {
  const TriangleMesh cube = geometry::box({-1, -1, -1}, {1, 1, 1});
  Scene scene(SceneUse::manyRays);
  scene.add(cube.positions, makeTopology(cube));
  scene.build();
  EXPECT_FALSE(closestPoint(scene, {5, 0, 0}, 3.9));
  EXPECT_TRUE(closestPoint(scene, {5, 0, 0}, 4.1));
}

}  // namespace
}  // namespace lorica::raycast
