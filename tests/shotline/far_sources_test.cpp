#include "far_sources.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lorica/base/units.h"
#include "lorica/shotline/shot_generator.h"

namespace lorica::shotline {
namespace {

using base::radians;
using geometry::Vec3d;
using geometry::Vec3f;
using raycast::Ray;

/// Where a ray stands across its direction, seen from the origin.
Vec3d across(const Ray& ray) {
  const Vec3d origin = ray.origin.cast<double>();
  const Vec3d direction = ray.direction.cast<double>().normalized();
  return origin - direction * origin.dot(direction);
}

std::vector<Ray> shotsOf(const Source& source, std::size_t count, std::uint32_t trial = 0) {
  std::vector<Ray> rays(count);
  ShotGenerator(source, 5, trial).shots(0, rays);
  return rays;
}

TEST(Towards, FollowsTheConventionOfTheGuide) {
  EXPECT_NEAR((towards(0, 0) - Vec3d(0, 0, 1)).norm(), 0, 1e-15) << "ahead of the person";
  EXPECT_NEAR((towards(radians(90), 0) - Vec3d(1, 0, 0)).norm(), 0, 1e-15) << "on the person's left";
  EXPECT_NEAR((towards(radians(180), 0) - Vec3d(0, 0, -1)).norm(), 0, 1e-15);
  EXPECT_NEAR((towards(radians(-90), 0) - Vec3d(-1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((towards(radians(77), radians(90)) - Vec3d(0, 1, 0)).norm(), 0, 1e-15) << "from above";
}

TEST(Beam, ComesFromItsDirectionAndFillsItsDiskEvenly) {
  const Source source = beamFrom(radians(30), radians(20), 0.8);
  const auto shots = shotsOf(source, 40000);
  const Vec3d from = towards(radians(30), radians(20));
  int inner = 0;
  Vec3d sum = Vec3d::Zero();
  for (const Ray& ray : shots) {
    ASSERT_LT((ray.direction.cast<double>() + from).norm(), 1e-7);
    ASSERT_LE(across(ray).norm(), 0.8 * (1 + 1e-6));
    ASSERT_GT(ray.origin.cast<double>().dot(from), 1.0) << "starts off the body";
    inner += across(ray).norm() < 0.4 ? 1 : 0;
    sum += across(ray);
  }
  EXPECT_NEAR(inner / 40000.0, 0.25, 5 * std::sqrt(0.25 * 0.75 / 40000));
  EXPECT_LT((sum / 40000).norm(), 5 * 0.8 / std::sqrt(40000.0));
}

TEST(GriddedBeam, HasOneShotInEveryCellAndAnotherShiftInEveryTrial) {
  const Source source = beamFrom(0, 0, 1.0, Sequence::grid, 20);
  const auto shots = shotsOf(source, 400);
  std::vector<int> cells(400, 0);
  for (const Ray& ray : shots) {
    const auto cell = [](float x) { return static_cast<std::size_t>(std::floor((x + 1.0F) * 10.0F)); };
    ASSERT_LT(std::abs(ray.origin.x()), 1.0F);
    ASSERT_LT(std::abs(ray.origin.y()), 1.0F);
    ++cells[20 * cell(ray.origin.y()) + cell(ray.origin.x())];
  }
  EXPECT_EQ(std::count(cells.begin(), cells.end(), 1), 400);
  EXPECT_NE(shots[0].origin, shotsOf(source, 1, 1)[0].origin);
}

TEST(Band, HoldsItsDirectionsAndSpreadsThemEvenlyInSolidAngle) {
  const Source source = bandOf({radians(-40), radians(100)}, {radians(-15), radians(60)}, 1.2);
  const auto shots = shotsOf(source, 40000);
  int below = 0;
  int left = 0;
  for (const Ray& ray : shots) {
    const Vec3d from = -ray.direction.cast<double>();
    const double elevation = std::asin(from.y());
    const double azimuth = std::atan2(from.x(), from.z());
    ASSERT_GE(elevation, radians(-15) - 1e-6);
    ASSERT_LE(elevation, radians(60) + 1e-6);
    ASSERT_GE(azimuth, radians(-40) - 1e-6);
    ASSERT_LE(azimuth, radians(100) + 1e-6);
    ASSERT_LE(across(ray).norm(), 1.2 * (1 + 1e-6));
    below += elevation < radians(10) ? 1 : 0;
    left += azimuth > radians(65) ? 1 : 0;
  }
  const double lower =
      (std::sin(radians(10)) - std::sin(radians(-15))) / (std::sin(radians(60)) - std::sin(radians(-15)));
  EXPECT_NEAR(below / 40000.0, lower, 5 * std::sqrt(lower * (1 - lower) / 40000));
  EXPECT_NEAR(left / 40000.0, 0.25, 5 * std::sqrt(0.25 * 0.75 / 40000));
}

TEST(Rectangle, HasTheSolidAngleOfTheFormulaAndItsOctantOfACube) {
  EXPECT_NEAR(solidAngle(2, 2, 1), 4 * std::numbers::pi / 6, 1e-12) << "one face of a cube seen from its middle";
  const double a = 0.3;
  const double b = 0.7;
  const double d = 2.5;
  const double formula = 4 * std::atan(a * b / (2 * d * std::sqrt(4 * d * d + a * a + b * b)));
  EXPECT_NEAR(solidAngle(a, b, d), formula, 1e-14);
  EXPECT_NEAR(solidAngle(1e-3, 1e-3, 10), 1e-8, 1e-15) << "area over squared distance when far";
}

TEST(Rectangle, IsFilledEvenlyInSolidAngle) {
  PointSource point;
  point.position = {0, 0, 1};
  point.sampler = Sampler::rectangle;
  point.width = 4;
  point.height = 2;
  const auto shots = shotsOf({"window", point}, 40000);
  int middle = 0;
  int right = 0;
  for (const Ray& ray : shots) {
    const Vec3f at = ray.direction / -ray.direction.z();
    ASSERT_LE(std::abs(at.x()), 2.0F * (1 + 1e-5F));
    ASSERT_LE(std::abs(at.y()), 1.0F * (1 + 1e-5F));
    middle += std::abs(at.x()) < 0.5F && std::abs(at.y()) < 0.5F ? 1 : 0;
    right += at.x() > 1.0F ? 1 : 0;
  }
  const double inner = solidAngle(1, 1, 1) / solidAngle(4, 2, 1);
  const double outer = 0.5 * (1 - solidAngle(2, 2, 1) / solidAngle(4, 2, 1));
  EXPECT_NEAR(middle / 40000.0, inner, 5 * std::sqrt(inner * (1 - inner) / 40000));
  EXPECT_NEAR(right / 40000.0, outer, 5 * std::sqrt(outer * (1 - outer) / 40000));
}

TEST(Measures, SayWhatAllShotsTogetherMake) {
  EXPECT_EQ(measureOf(beamFrom(0, 0, 2.0)).basis, Basis::area);
  EXPECT_NEAR(measureOf(beamFrom(0, 0, 2.0)).total, 4 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(measureOf(beamFrom(0, 0, 2.0, Sequence::grid, 7)).total, 16.0, 1e-12);
  EXPECT_NEAR(measureOf(everyDirection(2.0)).total, 4 * std::numbers::pi, 1e-12);
  PointSource point;
  point.position = {0, 0, 1};
  point.halfAngle = 0.5;
  EXPECT_EQ(measureOf({"p", point}).basis, Basis::solidAngle);
  EXPECT_NEAR(ShotGenerator({"p", point}, 1, 0).weight(1000), solidAngle(0.5) / 1000, 1e-15);
  point.sampler = Sampler::thesis;
  EXPECT_EQ(measureOf({"p", point}).basis, Basis::shots) << "Eq 15 has no weights";
}

TEST(Generators, GiveTheSameShotsOneByOneAndInBlocks) {
  for (const Source& source : {everyDirection(1.0, Sequence::sobol), everyDirection(1.0),
                               beamFrom(1, 0.2, 1.0, Sequence::sobol), beamFrom(1, 0.2, 1.0, Sequence::grid, 50)}) {
    const ShotGenerator shots(source, 9, 3);
    std::vector<Ray> block(40);
    shots.shots(1000, block);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Ray single = shots.shot(1000 + i);
      EXPECT_EQ(single.origin, block[i].origin);
      EXPECT_EQ(single.direction, block[i].direction);
    }
  }
}

}  // namespace
}  // namespace lorica::shotline
