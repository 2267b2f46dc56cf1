#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/geometry/measures.h"
#include "lorica/human/rotation_centres.h"
#include "lorica/manikin/plain_human.h"

namespace lorica::manikin {
namespace {

using geometry::Affine3d;
using geometry::Vec3d;

const PlainHuman& sample() {
  static const PlainHuman human = plainHuman();
  return human;
}

const human::Clip& clipNamed(const std::string& name) {
  return *std::find_if(sample().clips.begin(), sample().clips.end(),
                       [&](const auto& clip) { return clip.name == name; });
}

geometry::TriangleMesh posedSkin(const std::string& clip, double seconds) {
  const human::Pose pose = human::sample(clipNamed(clip), sample().skeleton, seconds);
  geometry::TriangleMesh posed = sample().skin;
  static const auto centres = human::rotationCentres(sample().skin, sample().weights, base::Threads{1});
  human::skin(sample().skin.positions, sample().weights, centres, human::skinningDeltas(sample().skeleton, pose),
              posed.positions, base::Threads{1});
  return posed;
}

Affine3d carry(const std::string& clip, double seconds, const std::string& joint) {
  const human::Pose pose = human::sample(clipNamed(clip), sample().skeleton, seconds);
  return human::carryTransforms(sample().skeleton, pose)[sample().skeleton.find(joint)->value];
}

Vec3d posedJoint(const std::string& clip, double seconds, const std::string& joint) {
  return carry(clip, seconds, joint) * sample().skeleton.restPosition(*sample().skeleton.find(joint));
}

/// Lowest point of the skin that the joint rules.
double lowestOf(const geometry::TriangleMesh& posed, const std::string& joint) {
  double lowest = 1e9;
  for (std::size_t v = 0; v < posed.positions.size(); ++v) {
    if (sample().skeleton.joint(sample().weights.strongest(v)).name == joint) {
      lowest = std::min(lowest, static_cast<double>(posed.positions[v].y()));
    }
  }
  return lowest;
}

/// Angle in degrees by which the carried x axis is turned to the person's left about y.
double leftTurn(const Affine3d& transform) {
  const Vec3d forward = transform.linear() * Vec3d::UnitZ();
  return std::atan2(forward.x(), forward.z()) * 180.0 / std::numbers::pi;
}

TEST(PlainHumanClips, AreTheFourTasksAtThirtyKeysASecond) {
  ASSERT_EQ(sample().clips.size(), 4u);
  for (const auto& [name, seconds] :
       {std::pair{"toe_touch", 4.0}, {"belly_twist", 4.0}, {"lateral_twist", 4.0}, {"squat", 3.5}}) {
    const human::Clip& clip = clipNamed(name);
    EXPECT_DOUBLE_EQ(clip.duration(), seconds) << name;
    for (const human::Channel& channel : clip.channels) {
      ASSERT_EQ(channel.interpolation, human::Interpolation::linear);
      ASSERT_EQ(channel.times.size(), static_cast<std::size_t>(std::lround(seconds * 30.0)) + 1);
      ASSERT_EQ(channel.values.size(), channel.times.size());
      ASSERT_TRUE(std::is_sorted(channel.times.begin(), channel.times.end()));
      if (channel.path == human::ChannelPath::rotation) {
        for (const auto& value : channel.values) {
          ASSERT_NEAR(value.norm(), 1.0, 1e-12);
        }
      }
    }
  }
}

TEST(PlainHumanClips, StartAndEndAtRest) {
  for (const human::Clip& clip : sample().clips) {
    for (const double seconds : {0.0, clip.duration()}) {
      const auto posed = posedSkin(clip.name, seconds);
      double furthest = 0.0;
      for (std::size_t v = 0; v < posed.positions.size(); ++v) {
        furthest = std::max(furthest, static_cast<double>((posed.positions[v] - sample().skin.positions[v]).norm()));
      }
      EXPECT_LT(furthest, 1e-6) << clip.name << " at " << seconds;
    }
  }
}

TEST(PlainHumanClips, KeepTheVolumeWithinATwentiethAndEveryVertexFinite) {
  const double rest = geometry::signedVolume(sample().skin);
  for (const human::Clip& clip : sample().clips) {
    for (const double share : {0.125, 0.25, 0.5, 0.75, 0.875}) {
      const auto posed = posedSkin(clip.name, share * clip.duration());
      ASSERT_TRUE(std::all_of(posed.positions.begin(), posed.positions.end(), [](const auto& p) {
        return p.allFinite();
      })) << clip.name;
      EXPECT_NEAR(geometry::signedVolume(posed), rest, 0.05 * rest) << clip.name << " at share " << share;
    }
  }
}

TEST(PlainHumanClips, KeepTheAnklesInPlaceAndTheSolesOnTheFloor) {
  for (const human::Clip& clip : sample().clips) {
    for (double seconds = 0.0; seconds <= clip.duration(); seconds += 0.31) {
      for (const char* ankle : {"ankle_L", "ankle_R"}) {
        const Vec3d rest = sample().skeleton.restPosition(*sample().skeleton.find(ankle));
        EXPECT_LT((posedJoint(clip.name, seconds, ankle) - rest).norm(), 0.003) << clip.name << " at " << seconds;
      }
      EXPECT_NEAR(geometry::bounds(posedSkin(clip.name, seconds).positions).min().y(), 0.0, 0.005)
          << clip.name << " at " << seconds;
    }
  }
}

TEST(ToeTouch, BringsTheHandsBelowTheKneesAtTwoSeconds) {
  const auto posed = posedSkin("toe_touch", 2.0);
  const double knee = posedJoint("toe_touch", 2.0, "knee_L").y();
  EXPECT_LT(lowestOf(posed, "wrist_L"), knee - 0.1);
  EXPECT_LT(lowestOf(posed, "wrist_R"), knee - 0.1);
}

TEST(ToeTouch, IsDeepestAtTwoSeconds) {
  const double deepest = posedJoint("toe_touch", 2.0, "spine_C7T1").y();
  for (const double seconds : {0.5, 1.0, 1.5, 1.9, 2.1, 2.5, 3.0, 3.5}) {
    EXPECT_GT(posedJoint("toe_touch", seconds, "spine_C7T1").y(), deepest) << seconds;
  }
}

TEST(ToeTouch, FlexesHipsEightyLumbarFortyFiveAndThoraxTwentyFiveDegreesForward) {
  const auto pitch = [](const std::string& joint) {
    const Vec3d up = carry("toe_touch", 2.0, joint).linear() * Vec3d::UnitY();
    return std::atan2(up.z(), up.y()) * 180.0 / std::numbers::pi;
  };
  EXPECT_NEAR(pitch("pelvis_root") - pitch("hip_L"), 80.0, 1.0);
  EXPECT_NEAR(pitch("spine_L1L2") - pitch("pelvis_root"), 45.0, 1.0);
  EXPECT_NEAR(pitch("spine_T2T3") - pitch("spine_L1L2"), 25.0, 1.0);
  EXPECT_NEAR(pitch("knee_L"), pitch("hip_L"), 1e-6);
}

TEST(BellyTwist, TurnsTheTrunkFortyDegreesToTheLeftAtOneAndToTheRightAtThreeSeconds) {
  EXPECT_NEAR(leftTurn(carry("belly_twist", 1.0, "spine_T2T3")), 40.0, 0.5);
  EXPECT_NEAR(leftTurn(carry("belly_twist", 3.0, "spine_T2T3")), -40.0, 0.5);
  EXPECT_NEAR(leftTurn(carry("belly_twist", 1.0, "pelvis_root")), 0.0, 1e-9);
}

TEST(LateralTwist, BendsToTheLeftAtOneAndToTheRightAtThreeSeconds) {
  const double rest = sample().skeleton.restPosition(*sample().skeleton.find("head_C0C1")).x();
  EXPECT_GT(posedJoint("lateral_twist", 1.0, "head_C0C1").x(), rest + 0.1);
  EXPECT_LT(posedJoint("lateral_twist", 3.0, "head_C0C1").x(), rest - 0.1);
  EXPECT_GT(leftTurn(carry("lateral_twist", 1.0, "spine_T2T3")), 10.0);
  EXPECT_LT(leftTurn(carry("lateral_twist", 3.0, "spine_T2T3")), -10.0);
}

TEST(Squat, LowersThePelvisByMoreThanThirtyCentimetres) {
  const double rest = sample().skeleton.restPosition(*sample().skeleton.find("pelvis_root")).y();
  EXPECT_LT(posedJoint("squat", 1.75, "pelvis_root").y(), rest - 0.3);
  // The knees stay before the hips.
  EXPECT_GT(posedJoint("squat", 1.75, "knee_L").z(), posedJoint("squat", 1.75, "hip_L").z() + 0.3);
}

}  // namespace
}  // namespace lorica::manikin
