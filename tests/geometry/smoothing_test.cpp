#include "lorica/geometry/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"

namespace lorica::geometry {
namespace {

/// Mean square distance from the ball of radius 1.
double roughness(const Positions& positions) {
  double sum = 0.0;
  for (const Vec3f& place : positions) {
    sum += std::pow(place.cast<double>().norm() - 1.0, 2);
  }
  return sum / static_cast<double>(positions.size());
}

TEST(TaubinSmoothing, TakesTheRoughnessOfABallAndLeavesItsVolume) {
  TriangleMesh ball = ellipsoid(Vec3d::Zero(), Vec3d::Ones(), 4);
  const double volume = signedVolume(ball);
  // Neighbours out and in by turns, as noise is.
  for (std::size_t v = 0; v < ball.positions.size(); ++v) {
    ball.positions[v] *= (v * 2654435761U >> 7U & 1U) != 0 ? 1.01F : 0.99F;
  }
  const double before = roughness(ball.positions);
  ball.positions = taubinSmoothed(ball, {50, 0.33, 0.34});
  EXPECT_LT(roughness(ball.positions), 0.2 * before);
  EXPECT_NEAR(signedVolume(ball) / volume, 1.0, 0.005);
}

TEST(TaubinSmoothing, LeavesLongWavesAsTheyAre) {
  TriangleMesh egg = ellipsoid(Vec3d(0.3, 0.2, -1.0), Vec3d(0.1, 0.2, 0.15), 4);
  const Vec3d size = bounds(egg.positions).sizes();
  const double volume = signedVolume(egg);
  egg.positions = taubinSmoothed(egg, {50, 0.33, 0.34});
  EXPECT_LT((bounds(egg.positions).sizes() - size).norm(), 0.01 * size.norm());
  EXPECT_NEAR(signedVolume(egg) / volume, 1.0, 0.01);
}

TEST(TaubinSmoothing, WithoutRoundsGivesTheSameBits) {
  const TriangleMesh ball = ellipsoid(Vec3d(0.1, 0.2, 0.3), Vec3d::Ones(), 2);
  EXPECT_EQ(taubinSmoothed(ball, {0, 0.33, 0.34}), ball.positions);
}

}  // namespace
}  // namespace lorica::geometry
