#include "lorica/human/regions.h"

#include <gtest/gtest.h>

#include "lorica/geometry/primitives.h"

namespace lorica::human {
namespace {

using geometry::Vec3d;

/// A ball around one joint of the given name; which regions its triangles fall into.
std::vector<std::string> regionsOf(const std::string& jointName, double x = 0.0) {
  Joint root{"thing", std::nullopt, {}};
  Joint joint{jointName, JointIndex{0}, {}};
  joint.rest.translation = {x, 1, 0};
  const Skeleton skeleton({root, joint});
  const auto ball = geometry::ellipsoid({x, 1, 0}, {0.1, 0.1, 0.1}, 2);
  const std::vector<Influence> influences(ball.positions.size(), Influence{1, 1.0});
  const BodyRegions regions = bodyRegions(ball, normaliseWeights(influences, 1).weights, skeleton);
  EXPECT_EQ(regions.ofTriangle.size(), ball.triangles.size());
  return regions.names;
}

TEST(BodyRegions, KnowTheNamesOfSeveralRigs) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(regionsOf("head_C0C1"), Names{"head"});
  EXPECT_EQ(regionsOf("neck01"), Names{"neck"});
  EXPECT_EQ(regionsOf("spine_C7T1"), Names{"neck"});
  EXPECT_EQ(regionsOf("spine_T6T7"), (Names{"chest_front", "chest_back"}));
  EXPECT_EQ(regionsOf("sternoclavicular_L"), (Names{"chest_front", "chest_back"}));
  EXPECT_EQ(regionsOf("spine_L3L4"), (Names{"abdomen_front", "abdomen_back"}));
  EXPECT_EQ(regionsOf("spine05"), (Names{"abdomen_front", "abdomen_back"}));
  EXPECT_EQ(regionsOf("pelvis_root"), Names{"pelvis"});
  EXPECT_EQ(regionsOf("Hips"), Names{"pelvis"});
  EXPECT_EQ(regionsOf("hip_L"), Names{"thigh_left"});
  EXPECT_EQ(regionsOf("LeftUpLeg"), Names{"thigh_left"});
  EXPECT_EQ(regionsOf("upperleg01.R"), Names{"thigh_right"});
  EXPECT_EQ(regionsOf("RightLeg"), Names{"lower_leg_right"});
  EXPECT_EQ(regionsOf("knee_R"), Names{"lower_leg_right"});
  EXPECT_EQ(regionsOf("ankle_L"), Names{"foot_left"});
  EXPECT_EQ(regionsOf("LeftForeArm"), Names{"forearm_left"});
  EXPECT_EQ(regionsOf("lowerarm02.L"), Names{"forearm_left"});
  EXPECT_EQ(regionsOf("glenohumeral_R"), Names{"upper_arm_right"});
  EXPECT_EQ(regionsOf("LeftArm"), Names{"upper_arm_left"});
  EXPECT_EQ(regionsOf("index_MCP_L"), Names{"hand_left"});
}

TEST(BodyRegions, TakeTheParentsRegionForAJointWithoutAKnownName) {
  Joint root{"thing", std::nullopt, {}};
  Joint elbow{"elbow_L", JointIndex{0}, {}};
  Joint odd{"bone_17", JointIndex{1}, {}};
  const Skeleton skeleton({root, elbow, odd});
  const auto ball = geometry::ellipsoid({1, 1, 0}, {0.1, 0.1, 0.1}, 1);
  const std::vector<Influence> influences(ball.positions.size(), Influence{2, 1.0});
  EXPECT_EQ(bodyRegions(ball, normaliseWeights(influences, 1).weights, skeleton).names,
            std::vector<std::string>{"forearm_left"});
}

TEST(BodyRegions, OfARigWithoutKnownNamesAreOne) {
  EXPECT_EQ(regionsOf("bone_3"), std::vector<std::string>{"unassigned"});
}

}  // namespace
}  // namespace lorica::human
