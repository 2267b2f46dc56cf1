#include "lorica/jobs/organ_colours.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>

#include "lorica/geometry/primitives.h"
#include "lorica/study/study_file.h"

namespace lorica::jobs {
namespace {

using document::Colouring;
using geometry::Vec3d;
using geometry::Vec3f;
using viscera::OrganModel;

TEST(EdgeStrain, OfAMeshThatGrowsIsTheSameEverywhere) {
  const geometry::TriangleMesh ball = geometry::ellipsoid(Vec3d::Zero(), Vec3d::Constant(0.05), 2);
  geometry::Positions larger = ball.positions;
  for (Vec3f& vertex : larger) {
    vertex *= 1.25F;
  }
  for (const float strain : edgeStrain(ball, larger)) {
    EXPECT_NEAR(strain, 0.25F, 1e-4F);
  }
  for (const float strain : edgeStrain(ball, ball.positions)) {
    EXPECT_EQ(strain, 0.0F);
  }
}

TEST(EdgeStrain, IsThatOfTheEdgesAtAVertexTogether) {
  geometry::TriangleMesh one;
  one.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {9, 9, 9}};
  one.triangles = {{0, 1, 2}};
  // Edges of 3, 4 and 5 become 6, 8 and 10, then only the first one changes.
  std::vector<float> strain = edgeStrain(one, geometry::Positions{{0, 0, 0}, {6, 0, 0}, {0, 8, 0}, {0, 0, 0}});
  EXPECT_NEAR(strain[0], 1.0F, 1e-6F);
  EXPECT_EQ(strain[3], 0.0F) << "a vertex without an edge";
  strain = edgeStrain(one, geometry::Positions{{0, 0, 0}, {1, 0, 0}, {0, 4, 0}, {0, 0, 0}});
  const double third = std::sqrt(17.0);
  EXPECT_NEAR(strain[0], 5.0 / 7.0 - 1.0, 1e-6);
  EXPECT_NEAR(strain[1], (1.0 + third) / 8.0 - 1.0, 1e-6);
  EXPECT_NEAR(strain[2], (4.0 + third) / 9.0 - 1.0, 1e-6);
}

TEST(Protrusion, IsTheDistanceFromTheSkinOfWhatIsOutside) {
  const double radius = 0.1;
  const geometry::TriangleMesh ball = geometry::ellipsoid(Vec3d::Zero(), Vec3d::Constant(radius), 5);
  raycast::Scene skin(raycast::SceneUse::manyRays);
  skin.add(ball.positions, raycast::makeTopology(ball));
  skin.build();
  std::vector<Vec3f> points;
  std::vector<double> wanted;
  for (int i = 0; i < 200; ++i) {
    const double reach = 0.002 * i;
    const Vec3d direction = Vec3d(std::sin(i), std::cos(1.7 * i), std::sin(2.3 * i + 1.0)).normalized();
    points.push_back((reach * direction).cast<float>());
    wanted.push_back(std::max(0.0, reach - radius));
  }
  const std::vector<float> depth = protrusion(points, skin, {}, {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    // The ball's triangles lie up to a fifth of a millimetre within the sphere.
    EXPECT_NEAR(depth[i], wanted[i], 3e-4) << i;
  }
  for (std::size_t i = 0; i < 49; ++i) {
    EXPECT_EQ(depth[i], 0.0F) << i;
  }
}

TEST(Protrusion, OfTheSkinsOwnPointsIsZero) {
  const geometry::TriangleMesh ball = geometry::ellipsoid(Vec3d::Zero(), Vec3d::Constant(0.1), 3);
  raycast::Scene skin(raycast::SceneUse::manyRays);
  skin.add(ball.positions, raycast::makeTopology(ball));
  skin.build();
  EXPECT_EQ(protrusion(ball.positions, skin, {}, {}), std::vector<float>(ball.positions.size(), 0.0F));
}

class Colourer : public testing::Test {
 protected:
  Colourer() {
    engine_.setStudy(study_);
    FrameRequest request;
    request.pose = "toe_touch@2";
    request.models = {OrganModel::staticJoint, OrganModel::dynamic};
    QObject::connect(
        &engine_, &FrameEngine::frameReady, &engine_,
        [this](std::shared_ptr<const Frame> frame) { frame_ = std::move(frame); }, Qt::QueuedConnection);
    engine_.request(request);
    EXPECT_TRUE(QTest::qWaitFor([this] { return frame_ != nullptr; }, 20000));
    QObject::connect(&colourer_, &OrganColourer::ready, &colourer_,
                     [this](const std::shared_ptr<const OrganColours>& colours) { found_.push_back(colours); });
  }

  std::shared_ptr<const analysis::LoadedStudy> study_ = std::make_shared<const analysis::LoadedStudy>(
      analysis::load(study::parseStudy(study::templateText("sample"), "sample"), "sample.lorica.json", {}));
  FrameEngine engine_;
  std::shared_ptr<const Frame> frame_;
  OrganColourer colourer_;
  std::vector<std::shared_ptr<const OrganColours>> found_;
};

TEST_F(Colourer, HasAValueForEveryVertexOfEveryOrganAndModel) {
  colourer_.request(frame_, Colouring::strain);
  ASSERT_TRUE(QTest::qWaitFor([this] { return !found_.empty(); }, 20000));
  const auto& organs = study_->organs;
  ASSERT_EQ(found_[0]->values.size(), 2 * organs.size());
  for (std::size_t slot = 0; slot < found_[0]->values.size(); ++slot) {
    const geometry::TriangleMesh& rest = organs[slot % organs.size()]->rig.rest;
    EXPECT_EQ(found_[0]->values[slot],
              edgeStrain(rest, frame_->scene->organ(slot % organs.size(), slot / organs.size())));
  }
  for (std::size_t o = 0; o < organs.size(); ++o) {
    for (const float strain : found_[0]->values[o]) {
      ASSERT_NEAR(strain, 0.0F, 0.01F) << "a rigid organ is not strained";
    }
  }
}

TEST_F(Colourer, WhatIsAskedForReplacesWhatWasAskedForBefore) {
  colourer_.request(frame_, Colouring::protrusion);
  colourer_.request(frame_, Colouring::strain);
  ASSERT_TRUE(QTest::qWaitFor([this] { return !colourer_.isBusy(); }, 20000));
  ASSERT_EQ(found_.size(), 1U);
  EXPECT_EQ(found_[0]->what, Colouring::strain);
  colourer_.request(frame_, Colouring::protrusion);
  colourer_.abandon();
  QTest::qWait(300);
  EXPECT_EQ(found_.size(), 1U);
}

}  // namespace
}  // namespace lorica::jobs
