#include "lorica/human/anatomical_frames.h"

#include <gtest/gtest.h>

#include "humanoid.h"
#include "lorica/base/error.h"

namespace lorica::human {
namespace {

using geometry::Quatd;
using geometry::Vec3d;
using test::builtIn;
using test::humanoid;

void expectNear(const JointAngles& found, const JointAngles& expected, double tolerance) {
  EXPECT_NEAR(found.flexion, expected.flexion, tolerance);
  EXPECT_NEAR(found.abduction, expected.abduction, tolerance);
  EXPECT_NEAR(found.axial, expected.axial, tolerance);
}

TEST(JointAngles, AreRecoveredFromTheirTurn) {
  for (std::size_t r = 0; r < kRoles; ++r) {
    const Role role = static_cast<Role>(r);
    for (const Side side : {Side::left, Side::right}) {
      const JointAngles given{-37.0, 21.0, 12.0};
      expectNear(angles(role, side, turn(role, side, given)), given, 1e-9);
    }
  }
}

TEST(JointAngles, TurnTheWayPhysiciansCount) {
  const Vec3d down(0, -1, 0);
  const Vec3d forward(0, 0, 1);
  EXPECT_GT((turn(Role::hip, Side::left, {30, 0, 0}) * down).z(), 0.4);
  EXPECT_LT((turn(Role::knee, Side::left, {30, 0, 0}) * down).z(), -0.4);
  EXPECT_GT((turn(Role::shoulder, Side::right, {30, 0, 0}) * down).z(), 0.4);
  EXPECT_GT((turn(Role::elbow, Side::right, {30, 0, 0}) * down).z(), 0.4);
  EXPECT_GT((turn(Role::ankle, Side::left, {20, 0, 0}) * forward).y(), 0.3);
  EXPECT_GT((turn(Role::hip, Side::left, {0, 30, 0}) * down).x(), 0.4);
  EXPECT_LT((turn(Role::hip, Side::right, {0, 30, 0}) * down).x(), -0.4);
  // Inwards: the foot's tip goes to the other side.
  EXPECT_LT((turn(Role::hip, Side::left, {0, 0, 30}) * forward).x(), -0.4);
  EXPECT_GT((turn(Role::hip, Side::right, {0, 0, 30}) * forward).x(), 0.4);
  // Trunk: forward, to the left, turned to the left.
  EXPECT_GT((turn(Role::lumbar, Side::middle, {30, 0, 0}) * -down).z(), 0.4);
  EXPECT_GT((turn(Role::lumbar, Side::middle, {0, 30, 0}) * -down).x(), 0.4);
  EXPECT_GT((turn(Role::lumbar, Side::middle, {0, 0, 30}) * forward).x(), 0.4);
  // The left palm faces the right thigh: bending brings the fingers there.
  EXPECT_LT((turn(Role::wrist, Side::left, {30, 0, 0}) * down).x(), -0.4);
  EXPECT_GT((turn(Role::wrist, Side::left, {0, 15, 0}) * down).z(), 0.2);
}

TEST(AnatomicalFrames, ReadTheRestPoseOffTheBones) {
  const Skeleton skeleton = humanoid(builtIn());
  const AnatomicalFrames frames(skeleton, findRoles(skeleton));
  const auto rest = [&](Role role) { return frames.parts()[frames.part(role, Side::right).value()].rest; };
  // The upper arm of the humanoid hangs 0.25 m down and 0.14 m out.
  expectNear(rest(Role::shoulder), {0.0, 29.25, 0.0}, 0.01);
  // Its forearm points a little more forward, its shank a little backward.
  EXPECT_NEAR(rest(Role::elbow).flexion, 4.3, 0.1);
  EXPECT_NEAR(rest(Role::knee).flexion, 1.4, 0.1);
  expectNear(frames.parts()[frames.part(Role::pelvis).value()].rest, {}, 0.0);
}

TEST(AnatomicalFrames, MeasureWhatAPoseTurns) {
  const Skeleton skeleton = humanoid(builtIn());
  const AnatomicalFrames frames(skeleton, findRoles(skeleton));
  const Pose pose = turnedPose(
      skeleton, {{*skeleton.find("hip_L"), {-40, 0, 0}}, {*skeleton.find("spine_L3L4"), {25, 0, 0}}}, {0, 0, 0});
  const auto measured = frames.measure(skeleton, pose);
  const auto of = [&](Role role, Side side) { return measured[frames.part(role, side).value()]; };
  const auto restOf = [&](Role role, Side side) { return frames.parts()[frames.part(role, side).value()].rest; };
  expectNear(of(Role::lumbar, Side::middle), {25, 0, 0}, 1e-6);
  EXPECT_NEAR(of(Role::hip, Side::left).flexion, 40.0 + restOf(Role::hip, Side::left).flexion, 1e-6);
  expectNear(of(Role::knee, Side::left), restOf(Role::knee, Side::left), 1e-6);
  expectNear(of(Role::shoulder, Side::right), restOf(Role::shoulder, Side::right), 1e-6);
}

TEST(AnatomicalFrames, RefuseALimbWithoutLength) {
  std::vector<Joint> joints = humanoid(builtIn()).joints();
  joints[humanoid(builtIn()).find("wrist_L")->value].rest.translation = Vec3d::Zero();
  const Skeleton skeleton(joints);
  EXPECT_THROW(AnatomicalFrames(skeleton, findRoles(skeleton)), base::InputError);
}

TEST(LimitExcesses, NameJointDirectionAndBothAngles) {
  const Skeleton skeleton = humanoid(builtIn());
  const AnatomicalFrames frames(skeleton, findRoles(skeleton));
  EXPECT_TRUE(limitExcesses(frames, skeleton, restPose(skeleton), 0.0).empty());
  const Pose pose = turnedPose(skeleton, {{*skeleton.find("knee_R"), {-20, 0, 0}}}, {0, 0, 0});
  const auto found = limitExcesses(frames, skeleton, pose, 1.0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].joint, "knee_R");
  EXPECT_EQ(found[0].direction, "extension");
  EXPECT_NEAR(found[0].angle, 18.6, 0.1);
  EXPECT_EQ(found[0].limit, 2.0);
}

}  // namespace
}  // namespace lorica::human
