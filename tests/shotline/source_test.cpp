#include "lorica/shotline/shot_generator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lorica/geometry/primitives.h"
#include "lorica/stats/intervals.h"

namespace lorica::shotline {
namespace {

using geometry::Vec3d;
using geometry::Vec3f;

PointSource pointAt(double halfAngle) {
  PointSource source;
  source.position = {1, 2, 3};
  source.target = {-1, 1, 0.5};
  source.halfAngle = halfAngle;
  return source;
}

Source coneAt(double halfAngle) {
  return {"front", pointAt(halfAngle)};
}

TEST(BoundingCone, OfASphereHasTheTangentsAngle) {
  const auto sphere = geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 6);
  const std::span<const Vec3f> points(sphere.positions);
  const double angle = boundingHalfAngle({0, 0, 5}, {0, 0, 0}, std::span(&points, 1));
  EXPECT_NEAR(angle, std::asin(1.0 / 5.0), 1e-4);
  EXPECT_LE(angle, std::asin(1.0 / 5.0) * (1 + 2e-6)) << "vertices lie on the sphere";
}

TEST(BoundingCone, FromWithinTheBodyIsEveryDirection) {
  const auto sphere = geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 2);
  const std::span<const Vec3f> points(sphere.positions);
  EXPECT_EQ(boundingHalfAngle({0, 0, 0.5}, {0, 0, 0}, std::span(&points, 1)), std::numbers::pi);
}

TEST(BoundingCone, HoldsEveryPoseCompared) {
  const auto near = geometry::ellipsoid({0, 0, 0}, {0.5, 0.5, 0.5}, 2);
  const auto far = geometry::ellipsoid({2, 0, 0}, {0.5, 0.5, 0.5}, 2);
  const std::span<const Vec3f> both[] = {near.positions, far.positions};
  const double angle = boundingHalfAngle({0, 0, 5}, {0, 0, 0}, both);
  for (const Vec3f& p : far.positions) {
    const Vec3d towards = p.cast<double>() - Vec3d(0, 0, 5);
    EXPECT_LE(std::acos(towards.normalized().dot(Vec3d(0, 0, -1))), angle);
  }
}

TEST(SolidAngle, OfTheWholeSphereAndOfAHemisphere) {
  EXPECT_NEAR(solidAngle(std::numbers::pi), 4 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(solidAngle(std::numbers::pi / 2), 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(solidAngle(1e-4), std::numbers::pi * 1e-8, 1e-16);
}

TEST(ConeSampler, StaysInTheConeAndFillsItEvenly) {
  for (const double angle : {0.05, 0.5, 1.4, std::numbers::pi}) {
    const PointSource source = pointAt(angle);
    const ShotGenerator shots({"front", source}, 7, 0);
    const Vec3d axis = (source.target - source.position).normalized();
    constexpr int count = 40000;
    int inner = 0;
    Vec3d sum = Vec3d::Zero();
    for (int i = 0; i < count; ++i) {
      const Vec3d direction = shots.shot(static_cast<std::uint64_t>(i)).direction.cast<double>();
      ASSERT_NEAR(direction.norm(), 1.0, 1e-6);
      const double off = std::acos(std::clamp(direction.normalized().dot(axis), -1.0, 1.0));
      ASSERT_LE(off, angle + 1e-3 * angle);
      inner += off < angle / 2 ? 1 : 0;
      sum += direction;
    }
    // Shots within half the angle: their share of the solid angle, within five standard deviations.
    const double share = solidAngle(angle / 2) / solidAngle(angle);
    EXPECT_NEAR(inner / static_cast<double>(count), share, 5 * std::sqrt(share * (1 - share) / count));
    const Vec3d mean = sum / count;
    EXPECT_LT((mean - mean.dot(axis) * axis).norm(), 5.0 / std::sqrt(count)) << "no side is favoured";
  }
}

TEST(ShotGenerator, AShotDependsOnSeedSourceTrialAndNumberOnly) {
  const Source source = coneAt(0.3);
  const auto direction = [](const Source& s, std::uint64_t seed, std::uint32_t trial, std::uint64_t number) {
    return ShotGenerator(s, seed, trial).shot(number).direction;
  };
  Source renamed = source;
  renamed.name = "side";
  EXPECT_EQ(direction(source, 1, 0, 5), direction(source, 1, 0, 5));
  EXPECT_NE(direction(source, 1, 0, 5), direction(source, 2, 0, 5));
  EXPECT_NE(direction(source, 1, 0, 5), direction(source, 1, 1, 5));
  EXPECT_NE(direction(source, 1, 0, 5), direction(source, 1, 0, 6));
  EXPECT_NE(direction(source, 1, 0, 5), direction(renamed, 1, 0, 5));
}

TEST(ThesisSampler, SendsHalfOfItsShotsBackwards) {
  PointSource source = pointAt(0.0);
  source.sampler = Sampler::thesis;
  source.position = {0, 0, 5};
  source.target = {0, 0, 0};
  const ShotGenerator shots({"front", source}, 1, 0);
  int backwards = 0;
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const Vec3f direction = shots.shot(i).direction;
    EXPECT_EQ(direction.x(), 0.0F) << "the component-wise product keeps a level shot in its plane";
    backwards += direction.z() > 0 ? 1 : 0;
  }
  EXPECT_NEAR(backwards, 5000, 250);
}

}  // namespace
}  // namespace lorica::shotline
