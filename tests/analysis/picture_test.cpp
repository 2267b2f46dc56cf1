#include "lorica/analysis/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lorica/base/error.h"
#include "lorica/geometry/primitives.h"

namespace lorica::analysis {
namespace {

using geometry::Vec3d;

/// Balls in front of each other along z, seen from +z.
class Balls {
 public:
  void add(const Vec3d& centre, double radius) {
    meshes_.push_back(
        std::make_unique<geometry::TriangleMesh>(geometry::ellipsoid(centre, Vec3d::Constant(radius), 4)));
    scene_.add(meshes_.back()->positions, raycast::makeTopology(*meshes_.back()));
  }
  Picture draw(const std::vector<MeshLook>& looks, int threads = 0) {
    if (!built_) {
      scene_.build();
      built_ = true;
    }
    return drawScene(scene_, looks, frame, {threads});
  }

  PictureFrame frame{Vec3d::Zero(), -Vec3d::UnitZ(), Vec3d::UnitY(), 0.01, 240, 200};

 private:
  std::vector<std::unique_ptr<geometry::TriangleMesh>> meshes_;
  raycast::Scene scene_{raycast::SceneUse::manyRays};
  bool built_ = false;
};

std::array<int, 3> pixel(const Picture& picture, std::size_t column, std::size_t row) {
  const std::size_t at = 3 * (row * picture.columns + column);
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

constexpr MeshLook red{{200, 0, 0}, 1.0};
constexpr MeshLook green{{0, 200, 0}, 1.0};

TEST(Picture, ABallCoversTheAreaOfItsDisk) {
  Balls balls;
  balls.add({0.1, -0.05, 0.3}, 0.7);
  const Picture picture = balls.draw({red});
  ASSERT_EQ(picture.rgb.size(), 3U * 240U * 200U);
  // Blue is 255 on white and 0 on the ball, and between at the edge: its lack is the share that is covered.
  double covered = 0.0;
  for (std::size_t i = 2; i < picture.rgb.size(); i += 3) {
    covered += 1.0 - picture.rgb[i] / 255.0;
  }
  const double disk = std::numbers::pi * 0.7 * 0.7 / (0.01 * 0.01);
  EXPECT_NEAR(covered / disk, 1.0, 0.005) << "the mesh's outline lies within 0.3 % of the circle's area";
}

TEST(Picture, TheBallStandsWhereTheFrameSaysInEveryView) {
  Balls balls;
  balls.add({0.5, 0.3, 0.0}, 0.2);
  const auto centroid = [&](const Vec3d& towards) {
    balls.frame.towards = towards;
    const Picture picture = balls.draw({red});
    double sum = 0.0;
    double x = 0.0;
    double y = 0.0;
    for (std::size_t row = 0; row < picture.rows; ++row) {
      for (std::size_t column = 0; column < picture.columns; ++column) {
        const double here = 255 - pixel(picture, column, row)[2];
        sum += here;
        x += here * (static_cast<double>(column) + 0.5);
        y += here * (static_cast<double>(row) + 0.5);
      }
    }
    return Vec3d(0.01 * (x / sum - 120.0), 0.01 * (100.0 - y / sum), 0.0);
  };
  // From the front +x is at the right, from behind at the left; from the person's left it is the depth.
  EXPECT_LT((centroid(-Vec3d::UnitZ()) - Vec3d(0.5, 0.3, 0.0)).norm(), 0.003);
  EXPECT_LT((centroid(Vec3d::UnitZ()) - Vec3d(-0.5, 0.3, 0.0)).norm(), 0.003);
  EXPECT_LT((centroid(-Vec3d::UnitX()) - Vec3d(0.0, 0.3, 0.0)).norm(), 0.003);
}

TEST(Picture, WhatStandsInFrontHidesWhatIsBehind) {
  Balls balls;
  balls.add({0.0, 0.0, 0.5}, 0.3);
  balls.add({0.0, 0.0, -0.5}, 0.3);
  const auto middle = [&] { return pixel(balls.draw({red, green}), 120, 100); };
  EXPECT_GT(middle()[0], 100);
  EXPECT_EQ(middle()[1], 0);
  balls.frame.towards = Vec3d::UnitZ();
  EXPECT_EQ(middle()[0], 0);
  EXPECT_GT(middle()[1], 100);
}

TEST(Picture, ATranslucentSurfaceMixesWithWhatIsBehindByItsOpacity) {
  Balls balls;
  balls.add({0.0, 0.0, 0.5}, 0.3);
  balls.add({0.0, 0.0, -0.5}, 0.3);
  const auto alone = pixel(balls.draw({{{200, 0, 0}, 0.0}, green}), 120, 100);
  EXPECT_EQ(alone[0], 0) << "opacity 0 is not drawn";
  const auto opaque = pixel(balls.draw({red, green}), 120, 100);
  const auto mixed = pixel(balls.draw({{{200, 0, 0}, 0.25}, green}), 120, 100);
  EXPECT_NEAR(mixed[0], 0.25 * opaque[0], 2.0);
  EXPECT_NEAR(mixed[1], 0.75 * alone[1], 2.0);
  const auto onWhite = pixel(balls.draw({{{200, 0, 0}, 0.25}, {{0, 0, 0}, 0.0}}), 120, 100);
  EXPECT_NEAR(onWhite[2], 0.75 * 255.0, 2.0);
}

TEST(Picture, LightComesFromAboveOnTheViewersLeft) {
  Balls balls;
  balls.add(Vec3d::Zero(), 0.8);
  const Picture picture = balls.draw({red});
  EXPECT_GT(pixel(picture, 120 - 35, 100 - 35)[0], pixel(picture, 120 + 35, 100 + 35)[0] + 40);
}

TEST(Picture, IsTheSameAtAnyNumberOfThreads) {
  Balls balls;
  balls.add({0.1, 0.0, 0.5}, 0.3);
  balls.add({0.0, 0.1, -0.5}, 0.5);
  const std::vector<MeshLook> looks{{{200, 0, 0}, 0.3}, green};
  EXPECT_EQ(balls.draw(looks, 1).rgb, balls.draw(looks, 3).rgb);
}

TEST(Picture, NeedsALookForEveryMeshAndStopsWhenAsked) {
  Balls balls;
  balls.add(Vec3d::Zero(), 0.3);
  EXPECT_THROW(balls.draw({}), base::CallerError);
  raycast::Scene scene(raycast::SceneUse::manyRays);
  scene.build();
  base::Task task;
  task.cancel();
  EXPECT_THROW(drawScene(scene, {}, balls.frame, {}, base::Progress(task)), base::Cancelled);
}

}  // namespace
}  // namespace lorica::analysis
