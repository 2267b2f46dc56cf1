#include "lorica/human/retarget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/manikin/human.h"
#include "rigs.h"

// A motion shown by one rig and done by another, against what is known: the same motion made for that other rig, and
// the ways its bones point.

namespace lorica::human {
namespace {

using test::Quatd;
using test::Vec3d;
using Rig = test::Actor;

constexpr std::array kSides{Side::left, Side::right};

const Rig& builtIn() {
  static const Rig rig(manikin::keptHuman({}, {}).body.skeleton);
  return rig;
}

/// Arms held out to the sides.
const Rig& tPose() {
  static const Rig rig(
      test::restingIn(builtIn().skeleton(), turnedPose(builtIn().skeleton(),
                                                       {{*builtIn().skeleton().find("glenohumeral_L"), {0, 0, 75}},
                                                        {*builtIn().skeleton().find("glenohumeral_R"), {0, 0, -75}}},
                                                       Vec3d::Zero())));
  return rig;
}

Retargeted onto(const Rig& doer, const Rig& shown, const Clip& clip) {
  return retarget(clip, {shown.skeleton(), shown.roles()}, {doer.skeleton(), doer.roles()});
}

/// Largest distance of a joint between two motions at shares of their time, moved along the floor so that the pelvis
/// begins in the same place; metres.
double largestGap(const Rig& rig, const Clip& found, const Clip& wanted, const std::vector<double>& shares) {
  const auto pelvis = rig.roles().joint(Role::pelvis).value().value;
  const auto at = [&](const Clip& clip, double u) {
    return rig.positions(sample(clip, rig.skeleton(), u * wanted.duration()));
  };
  Vec3d between = at(wanted, 0.0)[pelvis] - at(found, 0.0)[pelvis];
  between.y() = 0.0;
  double largest = 0.0;
  for (const double u : shares) {
    const auto first = at(found, u);
    const auto second = at(wanted, u);
    for (std::size_t j = 0; j < first.size(); ++j) {
      largest = std::max(largest, (first[j] + between - second[j]).norm());
    }
  }
  return largest;
}

const std::vector<double> kAllAlong{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};

TEST(Retarget, LeavesAMotionOfTheSameRigAsItIs) {
  for (const Clip& clip : builtIn().clips()) {
    const Retargeted done = onto(builtIn(), builtIn(), clip);
    EXPECT_EQ(done.clip.name, clip.name);
    EXPECT_EQ(done.clip.duration(), clip.duration());
    if (clip.name == "walk") {
      // Its pelvis begins turned towards the leg that is ahead.
      EXPECT_NEAR(done.turned, 0.0, 3.0);
      continue;
    }
    EXPECT_NEAR(done.turned, 0.0, 1e-9);
    // On the ball of the foot, that joint is a little lower than flat on the floor.
    const bool onBall = clip.name == "kneel_aim" || clip.name == "prone_aim";
    EXPECT_LT(largestGap(builtIn(), done.clip, clip, kAllAlong), onBall ? 0.005 : 1e-6) << clip.name;
  }
}

TEST(Retarget, ReachesTheSamePostureFromAnyRestPoseFrameSizeAndFacing) {
  const Quatd left(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3d::UnitY()));
  const Rig shown(
      test::hungBelow(test::scaled(test::withRandomFrames(tPose().skeleton(), 7), 1.3), left, {2, 0.4, -3}));
  for (const Clip& clip : shown.clips()) {
    const Retargeted done = onto(builtIn(), shown, clip);
    const Retargeted own = onto(builtIn(), builtIn(), builtIn().clip(clip.name));
    EXPECT_NEAR(done.turned, own.turned, 1e-6);
    // All but the walk begin and end as their rig rests.
    const std::vector<double> shares = clip.name == "walk" ? kAllAlong : std::vector{0.5};
    EXPECT_LT(largestGap(builtIn(), done.clip, own.clip, shares), 1e-4) << clip.name;
  }
}

/// A clip of one key that turns joints at random, up to a right angle about each axis.
Clip randomPosture(const Rig& rig, unsigned seed) {
  std::mt19937 random(seed);
  const auto degrees = [&] {
    return 180.0 * (static_cast<double>(random()) / static_cast<double>(std::mt19937::max())) - 90.0;
  };
  std::vector<JointTurn> turns;
  std::vector<JointIndex> joints;
  for (const Part& part : rig.frames().parts()) {
    joints.push_back(part.joint);
    if (part.role != Role::pelvis) {
      turns.push_back({part.joint, {degrees(), degrees(), degrees()}});
    }
  }
  return clipThrough("random", rig.skeleton(), {0.0}, {turnedPose(rig.skeleton(), turns, Vec3d::Zero())}, joints,
                     rig.roles().joint(Role::pelvis).value());
}

TEST(Retarget, PointsTheBonesTheSameWay) {
  const std::vector<std::pair<Role, Role>> bones{
      {Role::shoulder, Role::elbow}, {Role::elbow, Role::wrist}, {Role::hip, Role::knee}, {Role::knee, Role::ankle}};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Clip clip = randomPosture(tPose(), seed);
    const Retargeted done = onto(builtIn(), tPose(), clip);
    const auto shown = tPose().positions(sample(clip, tPose().skeleton(), 0.0));
    const auto found = builtIn().positions(sample(done.clip, builtIn().skeleton(), 0.0));
    const auto way = [](const Rig& rig, const std::vector<Vec3d>& at, Role from, Role to, Side side) {
      return Vec3d(at[rig.roles().joint(to, side)->value] - at[rig.roles().joint(from, side)->value]).normalized();
    };
    for (const Side side : kSides) {
      for (const auto& [from, to] : bones) {
        EXPECT_LT((way(tPose(), shown, from, to, side) - way(builtIn(), found, from, to, side)).norm(), 1e-6)
            << roleName(from, side) << " of posture " << seed;
      }
    }
  }
}

/// The built-in rig without some of its joints; what hung on them hangs on what carried them.
Rig without(const std::vector<std::string>& dropped) {
  std::vector<Joint> kept;
  std::vector<std::optional<std::size_t>> place(builtIn().skeleton().size());
  std::vector<Vec3d> at;
  for (std::size_t j = 0; j < place.size(); ++j) {
    Joint joint = builtIn().skeleton().joints()[j];
    std::optional<JointIndex> parent = joint.parent;
    while (parent && !place[parent->value]) {
      parent = builtIn().skeleton().joint(*parent).parent;
    }
    const Vec3d here = builtIn().skeleton().restPosition(JointIndex{j});
    if (std::find(dropped.begin(), dropped.end(), joint.name) != dropped.end()) {
      continue;
    }
    joint.parent = parent ? std::optional(JointIndex{*place[parent->value]}) : std::nullopt;
    joint.rest = {here - (joint.parent ? at[joint.parent->value] : Vec3d::Zero()), Quatd::Identity(), Vec3d::Ones()};
    place[j] = kept.size();
    kept.push_back(joint);
    at.push_back(here);
  }
  return Rig(Skeleton(kept));
}

std::vector<std::string> namesOf(const Rig& rig, Role role, Side side, std::size_t from) {
  std::vector<std::string> names;
  const auto joints = rig.roles().joints(role, side);
  for (std::size_t k = from; k < joints.size(); ++k) {
    names.push_back(rig.skeleton().joint(joints[k]).name);
  }
  return names;
}

Quatd turnOf(const Rig& rig, const Clip& clip, double seconds, Role role, Side side) {
  const auto carry = carryTransforms(rig.skeleton(), sample(clip, rig.skeleton(), seconds));
  return Quatd(carry[rig.roles().joints(role, side).back().value].rotation());
}

TEST(Retarget, SpreadsTheBendOverTheJointsThereAre) {
  std::vector<std::string> dropped;
  for (const Role role : {Role::lumbar, Role::thoracic, Role::neck}) {
    const auto names = namesOf(builtIn(), role, Side::middle, 1);
    dropped.insert(dropped.end(), names.begin(), names.end());
  }
  ASSERT_FALSE(dropped.empty());
  const Rig few = without(dropped);
  for (const std::string name : {"toe_touch", "belly_twist", "lateral_twist"}) {
    for (const auto& [doer, shown] : {std::pair(&builtIn(), &few), std::pair(&few, &builtIn())}) {
      const Retargeted done = onto(*doer, *shown, shown->clip(name));
      const double seconds = 0.25 * done.clip.duration();
      for (const Role role : {Role::lumbar, Role::thoracic, Role::head}) {
        EXPECT_LT(turnOf(*doer, done.clip, seconds, role, Side::middle)
                      .angularDistance(turnOf(*shown, shown->clip(name), seconds, role, Side::middle)),
                  1e-6)
            << roleName(role, Side::middle) << " in " << name;
      }
    }
  }
}

TEST(Retarget, TurnsTheHandWhicheverJointPronates) {
  std::vector<std::string> dropped;
  for (const Side side : kSides) {
    const auto names = namesOf(builtIn(), Role::forearmTwist, side, 0);
    dropped.insert(dropped.end(), names.begin(), names.end());
  }
  ASSERT_EQ(dropped.size(), 2U);
  const Rig plain = without(dropped);
  for (const std::string name : {"kneel_aim", "toe_touch"}) {
    for (const auto& [doer, shown] : {std::pair(&builtIn(), &plain), std::pair(&plain, &builtIn())}) {
      const Retargeted done = onto(*doer, *shown, shown->clip(name));
      const double seconds = 0.5 * done.clip.duration();
      for (const Side side : kSides) {
        EXPECT_LT(turnOf(*doer, done.clip, seconds, Role::wrist, side)
                      .angularDistance(turnOf(*shown, shown->clip(name), seconds, Role::wrist, side)),
                  1e-6);
        const auto place = [&](const Rig& rig, const Clip& clip) {
          const auto at = rig.positions(sample(clip, rig.skeleton(), seconds));
          return Vec3d(at[rig.roles().joint(Role::wrist, side)->value] -
                       at[rig.roles().joint(Role::shoulder, side)->value]);
        };
        EXPECT_LT((place(*doer, done.clip) - place(*shown, shown->clip(name))).norm(), 1e-6);
      }
    }
  }
}

TEST(Retarget, BeginsFacingAheadAndSaysByHowMuchItTurned) {
  for (const double yaw : {-140.0, -37.0, 0.0, 90.0}) {
    const Rig& rig = builtIn();
    Clip turnedAway = rig.clip("walk");
    const Quatd turn(Eigen::AngleAxisd(yaw * std::numbers::pi / 180.0, Vec3d::UnitY()));
    const JointIndex pelvis = rig.roles().joint(Role::pelvis).value();
    ASSERT_FALSE(rig.skeleton().joint(pelvis).parent);
    for (Channel& channel : turnedAway.channels) {
      for (Eigen::Vector4d& value : channel.values) {
        if (channel.joint == pelvis && channel.path == ChannelPath::rotation) {
          value = (turn * Quatd(value)).coeffs();
        } else if (channel.joint == pelvis && channel.path == ChannelPath::translation) {
          value.head<3>() = turn * value.head<3>() + Vec3d(4, 0.7, -2);
        }
      }
    }
    const Retargeted straight = onto(rig, rig, rig.clip("walk"));
    const Retargeted done = onto(rig, rig, turnedAway);
    EXPECT_NEAR(std::remainder(done.turned - straight.turned + yaw, 360.0), 0.0, 1e-6);
    EXPECT_LT(largestGap(rig, done.clip, straight.clip, kAllAlong), 1e-6);
  }
}

TEST(Retarget, KeepsFeetOnTheFloorThatAreOnIt) {
  // Long shanks and short thighs: the same angles would leave the floor.
  std::vector<Joint> joints = builtIn().skeleton().joints();
  for (const std::string side : {"L", "R"}) {
    joints[builtIn().skeleton().find("knee_" + side)->value].rest.translation *= 0.8;
    joints[builtIn().skeleton().find("ankle_" + side)->value].rest.translation *= 1.2;
  }
  const Rig other{Skeleton(joints)};
  const Retargeted done = onto(other, builtIn(), builtIn().clip("squat"));
  for (const double seconds : done.clip.channels.front().times) {
    const auto at = other.positions(sample(done.clip, other.skeleton(), seconds));
    double lift = 1.0;
    for (const Side side : kSides) {
      for (const Role role : {Role::ankle, Role::toe}) {
        const JointIndex foot = other.roles().joint(role, side).value();
        lift = std::min(lift, at[foot.value].y() - other.skeleton().restPosition(foot).y());
      }
    }
    EXPECT_NEAR(lift, 0.0, 1e-6);
  }
}

TEST(Retarget, KeepsAMotionThatRestsAsLongAsItLasts) {
  const Rig& rig = builtIn();
  const JointIndex pelvis = rig.roles().joint(Role::pelvis).value();
  const Clip still = clipThrough("still", rig.skeleton(), {0.0, 2.5},
                                 {restPose(rig.skeleton()), restPose(rig.skeleton())}, {}, pelvis);
  const Retargeted done = onto(tPose(), rig, still);
  EXPECT_EQ(done.clip.duration(), 2.5);
}

}  // namespace
}  // namespace lorica::human
