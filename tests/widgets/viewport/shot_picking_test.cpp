#include "shot_picking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lorica::viewport {
namespace {

using Eigen::Vector2d;
using geometry::Vec3d;

/// A camera at `eye` that looks along -z: 90 degrees high, square, 1000 pixels.
ScreenView lookingFrom(const Vec3d& eye) {
  constexpr double near = 0.1;
  constexpr double far = 100.0;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = 1.0;
  projection(1, 1) = 1.0;
  projection(2, 2) = -(far + near) / (far - near);
  projection(2, 3) = -2.0 * far * near / (far - near);
  projection(3, 2) = -1.0;
  Eigen::Matrix4d toEye = Eigen::Matrix4d::Identity();
  toEye.topRightCorner<3, 1>() = -eye;
  return {projection * toEye, {1000.0, 1000.0}};
}

/// A fan of shots from one place to points of a square at z = 0, far enough from each other on the screen.
std::vector<DrawnShot> fan(const Vec3d& from) {
  std::vector<DrawnShot> shots;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      const auto number = static_cast<std::uint64_t>(3 * shots.size());
      shots.push_back({number, from, Vec3d(0.2 * x, 0.2 * y + 0.01 * x, 0.0)});
    }
  }
  return shots;
}

/// Pixels from a place to the nearest of many points of a shot that lie before the camera.
double pixelsAway(const DrawnShot& shot, const ScreenView& view, const Vector2d& place, const Vec3d& eye) {
  double nearest = 1e9;
  for (int i = 0; i <= 4000; ++i) {
    const Vec3d point = shot.from + i / 4000.0 * (shot.to - shot.from);
    if (point.z() < eye.z() - 0.2) {
      nearest = std::min(nearest, (view.pixel(point) - place).norm());
    }
  }
  return nearest;
}

/// Clicks near the end of every shot that no other passes there, and expects that shot.
void expectEachIsFound(const std::vector<DrawnShot>& shots, const Vec3d& eye) {
  const ScreenView view = lookingFrom(eye);
  int alone = 0;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const Vector2d place = view.pixel(0.05 * shots[i].from + 0.95 * shots[i].to);
    bool single = true;
    for (std::size_t other = 0; other < shots.size(); ++other) {
      single = single && (other == i || pixelsAway(shots[other], view, place, eye) > 5.0);
    }
    const auto found = shotAt(shots, view, place, 3.0);
    ASSERT_TRUE(found) << i;
    if (single) {
      ++alone;
      EXPECT_EQ(*found, i);
    }
  }
  EXPECT_GT(alone, 10) << "few shots are alone at their ends";
}

TEST(ScreenView, TheAxisOfTheCameraIsTheMiddleOfTheScreen) {
  const ScreenView view = lookingFrom({0, 0, 5});
  EXPECT_LT((view.pixel({0, 0, 0}) - Vector2d(500, 500)).norm(), 1e-9);
  EXPECT_LT((view.pixel({5, 0, 0}) - Vector2d(1000, 500)).norm(), 1e-9) << "45 degrees to the right is the edge";
}

TEST(ShotAt, AClickOnAShotFindsIt) {
  expectEachIsFound(fan({2.5, 0.3, 1.0}), {0, 0, 4});
}

TEST(ShotAt, AShotFromBehindTheCameraIsFoundWhereItIsSeen) {
  expectEachIsFound(fan({0.0, 0.05, 6.0}), {0, 0, 4});
  const ScreenView view = lookingFrom({0, 0, 4});
  const std::vector<DrawnShot> behind{{0, {0, 0, 5}, {0, 0, 9}}};
  EXPECT_FALSE(shotAt(behind, view, {500, 500}, 1000.0)) << "nothing of it is before the camera";
}

TEST(ShotAt, IsNoneWhereNoShotPasses) {
  const ScreenView view = lookingFrom({0, 0, 4});
  const std::vector<DrawnShot> shots{{0, {-1, 0, 0}, {1, 0, 0}}};
  EXPECT_TRUE(shotAt(shots, view, {500, 502.9}, 3.0));
  EXPECT_FALSE(shotAt(shots, view, {500, 503.1}, 3.0));
  EXPECT_FALSE(shotAt(shots, view, {500.0 + 125.0 + 3.1, 500}, 3.0)) << "beyond its end";
  EXPECT_FALSE(shotAt({}, view, {500, 500}, 3.0));
}

TEST(ShotAt, OfTwoThatCrossOnTheScreenTheOneInFrontIsTaken) {
  const ScreenView view = lookingFrom({0, 0, 4});
  const DrawnShot back{1, {-1, 0, -1}, {1, 0, -1}};
  const DrawnShot front{2, {0, -1, 1}, {0, 1, 1}};
  EXPECT_EQ(shotAt(std::vector{back, front}, view, {500, 500}, 3.0), 1U);
  EXPECT_EQ(shotAt(std::vector{front, back}, view, {500, 500}, 3.0), 0U);
}

}  // namespace
}  // namespace lorica::viewport
