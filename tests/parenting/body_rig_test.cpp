#include "lorica/parenting/body_rig.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lorica/geometry/primitives.h"
#include "lorica/parenting/skin_side.h"

namespace lorica::parenting {
namespace {

using geometry::Vec3d;
using geometry::Vec3f;

/// A capsule-like body that bends at a joint in its middle.
Body bendingBody() {
  Body body;
  body.skin = geometry::ellipsoid({0, 1, 0}, {0.2, 0.8, 0.15}, 5);
  human::Joint root{"pelvis", std::nullopt, {}};
  root.rest.translation = {0, 0.8, 0};
  human::Joint chest{"chest", human::JointIndex{0}, {}};
  chest.rest.translation = {0, 0.2, 0};
  body.skeleton = human::Skeleton({root, chest});
  std::vector<human::Influence> influences;
  for (const Vec3f& p : body.skin.positions) {
    const double w = std::clamp((static_cast<double>(p.y()) - 0.9) / 0.2, 0.0, 1.0);
    influences.push_back({0, 1 - w});
    influences.push_back({1, w});
  }
  body.weights = human::normaliseWeights(influences, 2).weights;
  body.regions = human::bodyRegions(body.skin, *body.weights, *body.skeleton);
  return body;
}

TEST(BodyRig, AtRestMovesNothing) {
  const BodyRig rig(bendingBody(), {}, {});
  const PosedBody posed = rig.pose(std::nullopt, {});
  EXPECT_EQ(std::memcmp(posed.skin.data(), rig.body().skin.positions.data(), posed.skin.size() * sizeof(Vec3f)), 0);
  for (const auto& carry : posed.sites.carry) {
    EXPECT_TRUE(carry.isIdentity());
  }
  for (const auto& carry : posed.thesisSites.carry) {
    EXPECT_TRUE(carry.isIdentity());
  }
}

TEST(BodyRig, AnswersAPoseTheSameWhateverCameBefore) {
  const BodyRig rig(bendingBody(), {}, {});
  const auto& skeleton = *rig.body().skeleton;
  const human::Pose bent = human::turnedPose(skeleton, {{human::JointIndex{1}, Vec3d(70, 0, 0)}}, Vec3d::Zero());
  const PosedBody fresh = rig.pose(bent, {});
  PosedBody reused = rig.pose(human::turnedPose(skeleton, {{human::JointIndex{1}, Vec3d(0, 50, 0)}}, {0, 1, 0}), {});
  rig.poseInto(bent, {}, reused);
  EXPECT_EQ(std::memcmp(fresh.skin.data(), reused.skin.data(), fresh.skin.size() * sizeof(Vec3f)), 0);
  for (std::size_t s = 0; s < fresh.sites.carry.size(); ++s) {
    EXPECT_EQ(fresh.sites.carry[s].translation, reused.sites.carry[s].translation);
    EXPECT_EQ(fresh.sites.carry[s].rotation.coeffs(), reused.sites.carry[s].rotation.coeffs());
  }
}

TEST(BodyRig, WithoutASkeletonStaysAtRestInAnyPose) {
  Body body;
  body.skin = geometry::ellipsoid({0, 1, 0}, {0.2, 0.8, 0.15}, 3);
  body.regions.names = {"unassigned"};
  body.regions.ofTriangle.assign(body.skin.triangles.size(), 0);
  const BodyRig rig(std::move(body), {}, {});
  EXPECT_FALSE(rig.sites().empty());
  EXPECT_TRUE(rig.pose(std::nullopt, {}).joints.empty());
}

TEST(JointParenting, TakesTheNearestJointAndTurnsWithIt) {
  const Body body = bendingBody();
  EXPECT_EQ(nearestJoint(*body.skeleton, {0, 1.4, 0}), human::JointIndex{1});
  EXPECT_EQ(nearestJoint(*body.skeleton, {0, 0.2, 0}), human::JointIndex{0});
  const human::Pose bent = human::turnedPose(*body.skeleton, {{human::JointIndex{1}, Vec3d(90, 0, 0)}}, Vec3d::Zero());
  const auto carry = carryJoints(*body.skeleton, bent);
  EXPECT_TRUE(carry[0].isIdentity());
  EXPECT_LT((carry[1] * Vec3d(0, 1.4, 0) - Vec3d(0, 1, 0.4)).norm(), 1e-12);
}

TEST(Strays, TellHowManyPointsAreOnTheWrongSideOfTheSkinAndHowFar) {
  const BodyRig rig(bendingBody(), {}, {});
  const std::vector<Vec3f> points{Vec3f(0, 1, 0), Vec3f(0.5F, 1, 0), Vec3f(0.1F, 1, 0)};
  const Strays outside = outsideSkin(points, rig, {});
  EXPECT_EQ(outside.points, 3U);
  EXPECT_EQ(outside.strayed, 1U);
  EXPECT_NEAR(outside.farthest, 0.3, 1e-3);
  const Strays inside = insideSkin(points, rig, {});
  EXPECT_EQ(inside.strayed, 2U);
  EXPECT_NEAR(inside.farthest, 0.15, 2e-3);
}

TEST(Strays, PointsOfTheSkinItselfAreOnNeitherSide) {
  const BodyRig rig(bendingBody(), {}, {});
  const geometry::Positions& skin = rig.body().skin.positions;
  EXPECT_EQ(outsideSkin(skin, rig, {}).strayed, 0U);
  EXPECT_EQ(insideSkin(skin, rig, {}).strayed, 0U);
}

}  // namespace
}  // namespace lorica::parenting
