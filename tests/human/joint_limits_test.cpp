#include "lorica/human/joint_limits.h"

#include <gtest/gtest.h>

#include <set>

#include "humanoid.h"

namespace lorica::human {
namespace {

TEST(JointRanges, ComeFromTheTable) {
  EXPECT_EQ(jointRange("knee_L")->flexion, 144.0);
  EXPECT_EQ(jointRange("hip")->external, 48.0);
  EXPECT_EQ(jointRange("radioulnar_R")->internal, 77.0);
  EXPECT_FALSE(jointRange("elbow")->abduction);
  EXPECT_FALSE(jointRange("tail"));
  std::set<std::string> names;
  for (const JointRangeRow& row : jointRanges()) {
    EXPECT_TRUE(names.insert(row.joint).second) << row.joint;
    for (const auto& limit : {row.range.flexion, row.range.extension, row.range.abduction, row.range.adduction,
                              row.range.internal, row.range.external}) {
      EXPECT_GE(limit.value_or(0.0), 0.0) << row.joint;
      EXPECT_LE(limit.value_or(0.0), 180.0) << row.joint;
    }
  }
}

TEST(SpineLevels, RiseFromTheSacrumToTheSkull) {
  EXPECT_EQ(spineLevel("spine_L5S1"), 0U);
  EXPECT_EQ(spineLevel("spine_T12L1"), kFirstThoracicLevel);
  EXPECT_EQ(spineLevel("spine_C7T1"), kFirstCervicalLevel);
  EXPECT_EQ(spineLevel("head_C0C1"), kHeadLevel);
  EXPECT_FALSE(spineLevel("spine01"));
  for (std::size_t level = 1; level < kSpineLevels; ++level) {
    EXPECT_GT(spineLevelHeight(level), spineLevelHeight(level - 1));
  }
}

TEST(SpineSegments, StandForTheLevelsUpToTheNextJoint) {
  const Skeleton skeleton = test::humanoid(test::builtIn());
  const auto segments = spineSegments(skeleton, findRoles(skeleton));
  ASSERT_EQ(segments.size(), 5U);
  // Without a joint at L5/S1 the first one takes the levels below it, too.
  EXPECT_EQ(segments[0].firstLevel, 0U);
  EXPECT_EQ(segments[0].lastLevel, *spineLevel("spine_T11T12"));
  EXPECT_EQ(segments[1].firstLevel, *spineLevel("spine_T10T11"));
  EXPECT_EQ(segments[2].lastLevel, *spineLevel("spine_T1T2"));
  EXPECT_EQ(segments[3].lastLevel, *spineLevel("spine_C1C2"));
  EXPECT_EQ(segments[4].firstLevel, kHeadLevel);
}

TEST(SpineSegments, OfAnUnnamedSpineAreToldByHeightAndCoverItAll) {
  test::RigNames names = test::builtIn();
  names.spine = "Spine";
  names.chest = "Chest";
  names.upperChest = "UpperChest";
  const Skeleton skeleton = test::humanoid(names);
  const auto segments = spineSegments(skeleton, findRoles(skeleton));
  ASSERT_EQ(segments.size(), 5U);
  std::size_t next = 0;
  for (const SpineSegment& segment : segments) {
    EXPECT_EQ(segment.firstLevel, next);
    next = segment.lastLevel + 1;
  }
  EXPECT_EQ(next, kSpineLevels);
  // The chest's joint rests 62 % of the way from hips to shoulders: T10/T11 to T11/T12.
  EXPECT_GE(segments[1].firstLevel, *spineLevel("spine_T12L1"));
  EXPECT_LE(segments[1].firstLevel, *spineLevel("spine_T9T10"));
}

TEST(SpineShares, SumToTheWholeOverWhateverJointsThereAre) {
  for (const bool withoutHead : {false, true}) {
    test::RigNames names = test::builtIn();
    if (withoutHead) {
      names.head = "x";
      names.neck = "y";
    }
    const Skeleton skeleton = test::humanoid(names);
    const JointAngles whole{30.0, -12.0, 7.0};
    JointAngles sum;
    for (const SpineSegment& segment : spineSegments(skeleton, findRoles(skeleton))) {
      sum = sum + shareOf(segment, whole, 0, kFirstThoracicLevel);
    }
    EXPECT_NEAR(sum.flexion, whole.flexion, 1e-12);
    EXPECT_NEAR(sum.abduction, whole.abduction, 1e-12);
    EXPECT_NEAR(sum.axial, whole.axial, 1e-12);
  }
}

TEST(SpineShares, FollowTheRangesOfTheLevels) {
  const SpineSegment lowest{JointIndex{0}, 0, 0};
  // L5/S1 bends 9 of the lumbar spine's 9 + 14 + 12.5 + 11 + 9 degrees.
  EXPECT_NEAR(shareOf(lowest, {55.5, 0.0, 0.0}, 0, kFirstThoracicLevel).flexion, 9.0, 1e-9);
  // Stretching, 5 of 18.5.
  EXPECT_NEAR(shareOf(lowest, {-18.5, 0.0, 0.0}, 0, kFirstThoracicLevel).flexion, -5.0, 1e-9);
  EXPECT_EQ(shareOf(lowest, {10.0, 0.0, 0.0}, kFirstThoracicLevel, kFirstCervicalLevel).flexion, 0.0);
}

}  // namespace
}  // namespace lorica::human
