#include "source_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lorica::viewport {
namespace {

using geometry::Vec3d;
using study::Sampler;
using study::SourceType;

const Vec3d aim(0.1, 1.0, -0.2);
constexpr double radius = 0.9;

study::Source pointAt(const Vec3d& position, Sampler sampler) {
  study::Source source;
  source.position = position;
  source.sampler = sampler;
  source.width = 0.4;
  source.height = 0.8;
  source.radius = 0.3;
  return source;
}

std::pair<double, double> anglesOf(const Vec3d& offset) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  return {std::atan2(offset.x(), offset.z()) * degrees,
          std::atan2(offset.y(), std::hypot(offset.x(), offset.z())) * degrees};
}

/// Whether some line of a shape ends at a place.
bool reaches(const SourceShape& shape, const Vec3d& place) {
  return std::any_of(shape.lines.begin(), shape.lines.end(),
                     [&](const Polyline& line) { return (line.back() - place).norm() < 1e-12; });
}

TEST(SourceShape, OfAPointIsABallWithALineToItsTarget) {
  for (const Sampler sampler : {Sampler::cone, Sampler::disk, Sampler::rectangle, Sampler::thesis}) {
    const study::Source source = pointAt({1, 2, 5}, sampler);
    const SourceShape shape = shapeOf(source, aim, radius);
    ASSERT_EQ(shape.balls.size(), 1U);
    EXPECT_EQ(shape.balls[0], source.position);
    EXPECT_TRUE(reaches(shape, aim));
    EXPECT_EQ(shape.lines.size() == 1U, sampler == Sampler::thesis) << "Eq 15 has no window";
  }
}

TEST(SourceShape, TheRectangleStandsLevelAcrossTheLineOfAimInItsOwnSize) {
  const study::Source source = pointAt({3, 2, 4}, Sampler::rectangle);
  const SourceShape shape = shapeOf(source, aim, radius);
  const Polyline& window = shape.lines.back();
  ASSERT_EQ(window.size(), 5U);
  const Vec3d across = window[1] - window[0];
  const Vec3d up = window[2] - window[1];
  EXPECT_NEAR(across.norm(), source.width, 1e-12);
  EXPECT_NEAR(across.y(), 0.0, 1e-12) << "its width is level";
  EXPECT_NEAR(up.norm(), source.height, 1e-12);
  EXPECT_GT(up.y(), 0.0);
  EXPECT_NEAR(across.dot(aim - source.position), 0.0, 1e-12);
  EXPECT_NEAR(up.dot(aim - source.position), 0.0, 1e-12);
  EXPECT_LT((0.5 * (window[0] + window[2]) - aim).norm(), 1e-12);
}

TEST(SourceShape, TheDiskHasItsRadius) {
  const SourceShape shape = shapeOf(pointAt({3, 2, 4}, Sampler::disk), aim, radius);
  for (const Vec3d& point : shape.lines.back()) {
    EXPECT_NEAR((point - aim).norm(), 0.3, 1e-12);
  }
}

TEST(SourceShape, ArrowsOfABeamGoFromItsDirectionTowardsTheBody) {
  study::Source source;
  source.type = SourceType::parallel;
  source.azimuth.from = 90.0;  // the person's left
  int arrows = 0;
  for (const Polyline& line : shapeOf(source, aim, radius).lines) {
    if (line.size() == 2) {
      ++arrows;
      EXPECT_GT(line[0].x(), aim.x() + radius);
      EXPECT_LT(line[1].x(), line[0].x());
      EXPECT_NEAR(line[1].y(), line[0].y(), 1e-12);
    }
  }
  EXPECT_EQ(arrows, 9);
}

TEST(SourceShape, ABandLiesBetweenItsAngles) {
  study::Source source;
  source.type = SourceType::band;
  source.azimuth = {20.0, 100.0};
  source.elevation = {-15.0, 40.0};
  double lowest = 90.0;
  double highest = -90.0;
  for (const Polyline& line : shapeOf(source, aim, radius).lines) {
    for (const Vec3d& point : line) {
      const auto [azimuth, elevation] = anglesOf(point - aim);
      EXPECT_GE(azimuth, 20.0 - 1e-9);
      EXPECT_LE(azimuth, 100.0 + 1e-9);
      EXPECT_GT((point - aim).norm(), radius) << "around the body";
      lowest = std::min(lowest, elevation);
      highest = std::max(highest, elevation);
    }
  }
  EXPECT_NEAR(lowest, -15.0, 1e-9);
  EXPECT_NEAR(highest, 40.0, 1e-9);
}

TEST(SourceShape, AListIsASampleOfItsShots) {
  std::vector<raycast::Ray> rays;
  for (int i = 0; i < 1000; ++i) {
    rays.push_back({{0, 1, 5}, {0, 0, -2}});
  }
  study::Source source;
  source.type = SourceType::list;
  const SourceShape shape = shapeOf(source, aim, radius, rays);
  EXPECT_GT(shape.lines.size(), 30U);
  EXPECT_LT(shape.lines.size(), 100U);
  EXPECT_LT(shape.lines[0][1].z(), aim.z()) << "through the body";
  EXPECT_FALSE(compassOf(source, aim, radius, 0.0)) << "it has no direction of its own";
}

TEST(Compass, LabelsStandWhereTheConventionPutsThem) {
  const auto compass = compassOf(pointAt({1, 2, 5}, Sampler::cone), aim, radius, 0.0);
  ASSERT_TRUE(compass);
  const auto along = [&](const char* start) {
    for (const CompassLabel& label : compass->labels) {
      if (label.text.startsWith(QString::fromUtf8(start)) && !label.ofSource) {
        const Vec3d centre = label.strong && label.text.startsWith("elev") ? aim : Vec3d(aim.x(), 0.0, aim.z());
        return Vec3d((label.place - centre).normalized());
      }
    }
    ADD_FAILURE() << start;
    return Vec3d(0, 0, 0);
  };
  EXPECT_LT((along("azimuth 0°, front") - Vec3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((along("90°, left") - Vec3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((along("180°, back") + Vec3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((along("270°, right") + Vec3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((along("elevation 90°") - Vec3d::UnitY()).norm(), 1e-9);
}

TEST(Compass, PointsAtTheSourceAndSaysItsAngles) {
  study::Source source = pointAt(aim + Vec3d(2.0, 0.0, 2.0), Sampler::cone);
  auto compass = compassOf(source, aim, radius, 0.0);
  ASSERT_TRUE(compass);
  const Vec3d seen = compass->strong.back().back() - aim;
  EXPECT_LT((seen.normalized() - Vec3d(1, 0, 1).normalized()).norm(), 1e-9);
  EXPECT_TRUE(compass->labels.back().ofSource);
  EXPECT_EQ(compass->labels.back().text, QString::fromUtf8("azimuth 45°, elevation 0°"));
  source.type = SourceType::parallel;
  source.azimuth.from = -30.0;
  source.elevation.from = 12.5;
  compass = compassOf(source, aim, radius, 0.0);
  EXPECT_EQ(compass->labels.back().text, QString::fromUtf8("azimuth -30°, elevation 12.5°"));
}

}  // namespace
}  // namespace lorica::viewport
