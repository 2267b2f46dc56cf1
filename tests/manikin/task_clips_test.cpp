#include "lorica/manikin/task_clips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lorica/base/units.h"
#include "lorica/manikin/human.h"
#include "rigs.h"

namespace lorica::manikin {
namespace {

using base::degrees;
using human::Role;
using human::Side;
using test::Actor;
using test::Quatd;
using test::Vec3d;

constexpr std::array<Side, 2> kSides{Side::left, Side::right};
constexpr double kHeight = 1.755;

const Body& builtIn() {
  static const Body body = keptHuman({}, {}).body;
  return body;
}

const Actor& actor() {
  static const Actor built(builtIn().skeleton);
  return built;
}

Vec3d mirrored(const Vec3d& p) {
  return {-p.x(), p.y(), p.z()};
}

/// Largest distance of a joint from its twin's mirror image between two poses.
double asymmetry(const human::Pose& a, const human::Pose& b) {
  const auto first = actor().positions(a);
  const auto second = actor().positions(b);
  double largest = 0.0;
  for (std::size_t j = 0; j < first.size(); ++j) {
    std::string name = actor().skeleton().joints()[j].name;
    if (name.ends_with("_L")) {
      name.back() = 'R';
    } else if (name.ends_with("_R")) {
      name.back() = 'L';
    }
    largest = std::max(largest, (first[j] - mirrored(second.at(actor().skeleton().find(name)->value))).norm());
  }
  return largest;
}

double largestGap(const Actor& a, const Actor& b, const std::string& clip, double u, double scale = 1.0) {
  const auto first = a.positions(a.pose(clip, u));
  const auto second = b.positions(b.pose(clip, u));
  double largest = 0.0;
  for (std::size_t j = 0; j < first.size(); ++j) {
    const auto twin = b.skeleton().find(a.skeleton().joints()[j].name);
    largest = std::max(largest, (scale * first[j] - second.at(twin->value)).norm());
  }
  return largest;
}

TEST(TaskClips, AreTheNineTasks) {
  std::vector<std::string> names;
  for (const human::Clip& clip : actor().clips()) {
    names.push_back(clip.name);
    EXPECT_GE(clip.duration(), 1.0) << clip.name;
    EXPECT_LE(clip.duration(), 10.0) << clip.name;
  }
  EXPECT_EQ(names, taskClipNames());
}

TEST(TaskClips, StartAndEndAtRestButForTheWalk) {
  for (const human::Clip& clip : actor().clips()) {
    for (const human::Channel& channel : clip.channels) {
      if (clip.name == "walk") {
        EXPECT_LT((channel.values.front() - channel.values.back()).norm(), 1e-9);
        continue;
      }
      const human::Trs& rest = actor().skeleton().joint(channel.joint).rest;
      const Eigen::Vector4d expected =
          channel.path == human::ChannelPath::rotation
              ? Eigen::Vector4d(rest.rotation.coeffs())
              : Eigen::Vector4d(rest.translation.x(), rest.translation.y(), rest.translation.z(), 0);
      EXPECT_LT((channel.values.front() - expected).norm(), 1e-6) << clip.name;
      EXPECT_LT((channel.values.back() - expected).norm(), 1e-6) << clip.name;
    }
  }
}

TEST(TaskClips, AreTheSameBytesAtEachCall) {
  const auto again = taskClips(actor().skeleton(), actor().roles());
  for (std::size_t c = 0; c < again.size(); ++c) {
    ASSERT_EQ(again[c].channels.size(), actor().clips()[c].channels.size());
    for (std::size_t k = 0; k < again[c].channels.size(); ++k) {
      EXPECT_EQ(again[c].channels[k].values, actor().clips()[c].channels[k].values);
    }
  }
}

TEST(TaskClips, TurnNoJointBeyondItsLimit) {
  for (const human::Clip& clip : actor().clips()) {
    for (const double seconds : clip.channels.front().times) {
      const human::Pose pose = human::sample(clip, actor().skeleton(), seconds);
      for (const auto& excess : human::limitExcesses(actor().frames(), actor().skeleton(), pose, 0.1)) {
        ADD_FAILURE() << clip.name << " at " << seconds << " s: " << excess.joint << " " << excess.direction << " "
                      << excess.angle << " of " << excess.limit;
      }
    }
  }
}

TEST(TaskClips, MoveWithoutJerks) {
  // Joints gain or lose no more speed between two keys than a quick person's: 2.5 times gravity's pull.
  for (const human::Clip& clip : actor().clips()) {
    const auto& times = clip.channels.front().times;
    const double step = times[1] - times[0];
    std::vector<std::vector<Vec3d>> path;
    for (const double seconds : times) {
      path.push_back(actor().positions(human::sample(clip, actor().skeleton(), seconds)));
    }
    double largest = 0.0;
    std::string where;
    for (std::size_t k = 1; k + 1 < path.size(); ++k) {
      for (std::size_t j = 0; j < path[k].size(); ++j) {
        const double acceleration = (path[k + 1][j] - 2.0 * path[k][j] + path[k - 1][j]).norm() / (step * step);
        if (acceleration > largest) {
          largest = acceleration;
          where = actor().skeleton().joints()[j].name + " at " + std::to_string(times[k]);
        }
      }
    }
    EXPECT_LT(largest, clip.name == "walk" ? 60.0 : 25.0) << clip.name << " " << where;
  }
}

TEST(TaskClips, LetNoJointSinkIntoTheFloor) {
  for (const human::Clip& clip : actor().clips()) {
    for (int key = 0; key <= 200; ++key) {
      const auto positions = actor().positions(actor().pose(clip.name, key / 200.0));
      for (std::size_t j = 0; j < positions.size(); ++j) {
        EXPECT_GT(positions[j].y(), 0.020) << clip.name << " " << actor().skeleton().joints()[j].name << " " << key;
      }
    }
  }
}

TEST(ToeTouch, BringsTheFingertipsToTheFloorWithStraightKnees) {
  for (const Side side : kSides) {
    const Vec3d tip = actor().fingertip("toe_touch", 0.5, side, kHeight);
    EXPECT_NEAR(tip.y(), 0.012 * kHeight, 0.03);
    EXPECT_GT(tip.z(), actor().atRest(Role::ankle, side).z());
    EXPECT_LT(std::abs(actor().angles("toe_touch", 0.5, Role::knee, side).flexion), 2.0);
  }
}

TEST(ToeTouch, BendsTheSpineByTheTablesSums) {
  EXPECT_NEAR(
      actor().sum("toe_touch", 0.5, Role::lumbar).flexion + actor().sum("toe_touch", 0.5, Role::thoracic).flexion,
      45.0 + 12.0, 0.01);
  // The trunk is inclined by legs, hips and spine together.
  const Quatd chest(human::carryTransforms(actor().skeleton(), actor().pose("toe_touch", 0.5))
                        .at(actor().skeleton().find("spine_T2T3")->value)
                        .rotation());
  const double hips = 0.5 * (actor().angles("toe_touch", 0.5, Role::hip, Side::left).flexion +
                             actor().angles("toe_touch", 0.5, Role::hip, Side::right).flexion);
  EXPECT_GE(hips, 69.0);
  EXPECT_LE(hips, 96.0);
  EXPECT_NEAR(degrees(chest.angularDistance(Quatd::Identity())), hips - 7.0 + 57.0, 1.5);
}

TEST(StandingTasks, KeepBothFeetWhereTheyRest) {
  for (const char* clip : {"toe_touch", "belly_twist", "lateral_twist", "squat", "arm_raise", "sit"}) {
    for (int key = 0; key <= 60; ++key) {
      for (const Side side : kSides) {
        for (const Role role : {Role::ankle, Role::toe}) {
          EXPECT_LT((actor().at(clip, key / 60.0, role, side) - actor().atRest(role, side)).norm(), 2e-3)
              << clip << key;
        }
      }
    }
  }
}

TEST(Squat, IsParallelAtItsLowest) {
  for (const Side side : kSides) {
    EXPECT_NEAR(actor().angles("squat", 0.5, Role::knee, side).flexion, 110.0, 1.0);
    EXPECT_NEAR(actor().angles("squat", 0.5, Role::hip, side).flexion, 115.0, 1.5);
    EXPECT_NEAR(actor().at("squat", 0.5, Role::hip, side).y(), actor().at("squat", 0.5, Role::knee, side).y(), 0.01);
  }
  EXPECT_NEAR(actor().sum("squat", 0.5, Role::lumbar).flexion, 20.0, 0.01);
}

TEST(Sit, HasThighsLevelAndShanksUpright) {
  for (const Side side : kSides) {
    EXPECT_NEAR(actor().at("sit", 0.5, Role::hip, side).y(), actor().at("sit", 0.5, Role::knee, side).y(), 0.02);
    EXPECT_NEAR(actor().at("sit", 0.5, Role::ankle, side).z(), actor().at("sit", 0.5, Role::knee, side).z(), 0.03);
    // Hands over the thighs.
    const Vec3d wrist = actor().at("sit", 0.5, Role::wrist, side);
    EXPECT_GT(wrist.y(), actor().at("sit", 0.5, Role::hip, side).y());
    EXPECT_LT(wrist.y(), actor().at("sit", 0.5, Role::hip, side).y() + 0.16);
    EXPECT_GT(wrist.z(), actor().at("sit", 0.5, Role::hip, side).z() + 0.15);
    EXPECT_LT(wrist.z(), actor().at("sit", 0.5, Role::knee, side).z() + 0.05);
  }
}

TEST(ArmRaise, BringsTheHandsOverTheHead) {
  for (const Side side : kSides) {
    EXPECT_GT(actor().at("arm_raise", 0.5, Role::wrist, side).y(), actor().at("arm_raise", 0.5, Role::head).y() + 0.25);
    EXPECT_NEAR(actor().angles("arm_raise", 0.5, Role::shoulder, side).flexion, 150.0, 0.5);
  }
}

TEST(BellyTwist, TurnsTheTrunkOverThePelvisByTheSumOfItsSegments) {
  for (const auto& [u, sign] : {std::pair{0.25, 1.0}, {0.75, -1.0}}) {
    const double turn =
        actor().sum("belly_twist", u, Role::lumbar).axial + actor().sum("belly_twist", u, Role::thoracic).axial;
    EXPECT_NEAR(turn, sign * 32.1, 0.05);
    EXPECT_NEAR(actor().angles("belly_twist", u, Role::pelvis).axial, sign * 20.0, 0.2);
    // The left shoulder goes back when the trunk turns to the left.
    const double ahead = actor().at("belly_twist", u, Role::shoulder, Side::left).z() -
                         actor().at("belly_twist", u, Role::shoulder, Side::right).z();
    EXPECT_LT(sign * ahead, -0.2);
  }
}

TEST(LateralTwist, BendsAndTurnsToTheSameSide) {
  const double bend = actor().sum("lateral_twist", 0.25, Role::lumbar).abduction +
                      actor().sum("lateral_twist", 0.25, Role::thoracic).abduction;
  EXPECT_NEAR(bend, 36.0, 0.5);
  EXPECT_NEAR(
      actor().sum("lateral_twist", 0.25, Role::lumbar).axial + actor().sum("lateral_twist", 0.25, Role::thoracic).axial,
      27.0, 1.0);
  EXPECT_GT(actor().at("lateral_twist", 0.25, Role::head).x(), 0.15);
}

TEST(SymmetricTasks, AreTheirOwnMirrorImage) {
  for (const char* clip : {"toe_touch", "squat", "sit", "arm_raise"}) {
    for (int key = 0; key <= 20; ++key) {
      EXPECT_LT(asymmetry(actor().pose(clip, key / 20.0), actor().pose(clip, key / 20.0)), 1e-6) << clip << key;
    }
  }
}

TEST(TwistingTasks, AreMirroredBetweenTheirExtremes) {
  for (const char* clip : {"belly_twist", "lateral_twist"}) {
    EXPECT_LT(asymmetry(actor().pose(clip, 0.25), actor().pose(clip, 0.75)), 1e-6) << clip;
  }
}

/// Both hands before the face, a rifle's length from each other and the shoulder.
void expectAim(const Actor& who, const std::string& clip) {
  const double size = who.stature() / kHeight;
  const Vec3d head = who.at(clip, 0.5, Role::head);
  const Vec3d trigger = who.at(clip, 0.5, Role::wrist, Side::right);
  const Vec3d support = who.at(clip, 0.5, Role::wrist, Side::left);
  const Vec3d shoulder = who.at(clip, 0.5, Role::shoulder, Side::right);
  EXPECT_GT(trigger.z(), head.z() + 0.05 * size) << clip;
  EXPECT_LT((trigger - head).norm(), 0.30 * size) << clip;
  EXPECT_NEAR((trigger - shoulder).norm(), 0.31 * size, 0.06 * size) << clip;
  EXPECT_GT(support.z(), trigger.z() + 0.12 * size) << clip;
  EXPECT_LT((support - trigger).norm(), 0.35 * size) << clip;
  EXPECT_LT(std::abs(support.x() - trigger.x()), 0.10 * size) << clip;
  for (const Vec3d& hand : {trigger, support}) {
    EXPECT_NEAR(hand.y(), head.y(), 0.16 * size) << clip;
  }
}

TEST(KneelAim, StandsOnARearKneeAndAFlatFrontFoot) {
  expectAim(actor(), "kneel_aim");
  EXPECT_NEAR(actor().at("kneel_aim", 0.5, Role::knee, Side::right).y(), 0.031 * kHeight, 0.004);
  EXPECT_NEAR(actor().angles("kneel_aim", 0.5, Role::knee, Side::right).flexion, 100.0, 10.0);
  EXPECT_NEAR(actor().angles("kneel_aim", 0.5, Role::knee, Side::left).flexion, 95.0, 10.0);
  EXPECT_LT((actor().at("kneel_aim", 0.5, Role::ankle, Side::left) - actor().atRest(Role::ankle, Side::left)).norm(),
            2e-3);
  EXPECT_LT((actor().at("kneel_aim", 0.5, Role::toe, Side::left) - actor().atRest(Role::toe, Side::left)).norm(), 2e-3);
  // The front foot's ball never leaves its place.
  for (int key = 0; key <= 100; ++key) {
    EXPECT_LT(
        (actor().at("kneel_aim", key / 100.0, Role::toe, Side::left) - actor().atRest(Role::toe, Side::left)).norm(),
        5e-3)
        << key;
  }
}

TEST(ProneAim, LiesOnTheFloorAndLeansOnItsElbows) {
  expectAim(actor(), "prone_aim");
  for (const Side side : kSides) {
    EXPECT_NEAR(actor().at("prone_aim", 0.5, Role::knee, side).y(), 0.031 * kHeight, 0.006);
    EXPECT_NEAR(actor().at("prone_aim", 0.5, Role::hip, side).y(), 0.062 * kHeight, 0.012);
    EXPECT_GT(actor().at("prone_aim", 0.5, Role::elbow, side).y(), 0.030);
    EXPECT_LT(actor().at("prone_aim", 0.5, Role::elbow, side).y(), 0.075);
    EXPECT_LT(actor().at("prone_aim", 0.5, Role::ankle, side).y(), 0.15);
  }
  const Vec3d chest = actor().at("prone_aim", 0.5, Role::shoulder, Side::left);
  EXPECT_LT(chest.y(), 0.30);
  EXPECT_GT(actor().at("prone_aim", 0.5, Role::head).z(),
            actor().at("prone_aim", 0.5, Role::hip, Side::left).z() + 0.5);
}

TEST(Walk, MirrorsItselfAtHalfTheCycle) {
  for (int key = 0; key < 22; ++key) {
    EXPECT_LT(asymmetry(actor().pose("walk", key / 44.0), actor().pose("walk", key / 44.0 + 0.5)), 1e-4) << key;
  }
}

TEST(Walk, DoesNotSlideOnItsFlatFoot) {
  const double speed = walkingSpeed(actor().skeleton(), actor().roles());
  EXPECT_GT(speed, 0.9);
  EXPECT_LT(speed, 1.6);
  const double duration = actor().clip("walk").duration();
  // The right sole lies flat from 12 to 34 % of the cycle; seen from the ground it moves less than a millimetre.
  const auto ground = [&](double u, Role role) {
    return Vec3d(actor().at("walk", u, role, Side::right) + Vec3d(0, 0, speed * u * duration));
  };
  for (int key = 6; key <= 14; ++key) {
    for (const Role role : {Role::ankle, Role::toe}) {
      EXPECT_LT((ground(key / 44.0, role) - ground(6 / 44.0, role)).norm(), 1e-3) << key;
    }
  }
  // While the heel rises, its ball stays.
  for (int key = 15; key <= 26; ++key) {
    EXPECT_LT((ground(key / 44.0, Role::toe) - ground(6 / 44.0, Role::toe)).norm(), 12e-3) << key;
  }
}

TEST(Walk, StaysNearTheMeasuredAngles) {
  // Contact, loading, mid-stance, push-off, swing: the corrections that keep the feet on the ground are small.
  for (const auto& [u, knee] : {std::pair{0.0, 4.0}, {0.1, 16.4}, {0.3, 6.6}, {0.5, 8.2}, {0.7, 57.8}, {0.8, 47.0}}) {
    EXPECT_NEAR(actor().angles("walk", std::round(u * 44) / 44, Role::knee, Side::right).flexion, knee, 12.0) << u;
  }
}

/// T-pose: the arms of the A-pose lifted by 60 degrees.
human::Skeleton tPose() {
  const human::Skeleton& a = builtIn().skeleton;
  return test::restingIn(
      a, human::turnedPose(a, {{*a.find("glenohumeral_L"), {0, 0, 60}}, {*a.find("glenohumeral_R"), {0, 0, -60}}},
                           Vec3d::Zero()));
}

TEST(TaskClips, ReachTheSamePostureOnTheTPoseRig) {
  const Actor other(tPose());
  EXPECT_GT(other.atRest(Role::wrist, Side::left).x(), actor().atRest(Role::wrist, Side::left).x() + 0.2);
  for (const auto& [clip, u] : {std::pair{"toe_touch", 0.5},
                                {"belly_twist", 0.25},
                                {"lateral_twist", 0.75},
                                {"squat", 0.5},
                                {"kneel_aim", 0.5},
                                {"prone_aim", 0.5},
                                {"arm_raise", 0.5},
                                {"walk", 0.3},
                                {"sit", 0.5}}) {
    EXPECT_LT(largestGap(actor(), other, clip, u), 5e-3) << clip;
  }
}

TEST(TaskClips, DoNotDependOnLocalFrames) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    const Actor other(test::withRandomFrames(builtIn().skeleton, seed));
    for (const human::Clip& clip : actor().clips()) {
      for (const double u : {0.0, 0.13, 0.25, 0.5, 0.77}) {
        // Keys agree; between keys the rotations of a chain of other frames are blended alike.
        EXPECT_LT(largestGap(actor(), other, clip.name, u), 1e-6) << clip.name << u << " seed " << seed;
      }
    }
  }
}

TEST(TaskClips, DoNotDependOnWhereTheBodyStandsAndFaces) {
  const Quatd turn(Eigen::AngleAxisd(base::radians(-90.0), Vec3d::UnitY()));
  const Vec3d shift(1.5, -0.4, 2.0);
  const Actor other(test::hungBelow(builtIn().skeleton, turn, shift));
  for (const human::Clip& clip : actor().clips()) {
    for (const double u : {0.2, 0.5}) {
      const auto here = actor().positions(actor().pose(clip.name, u));
      const auto there = other.positions(other.pose(clip.name, u));
      for (std::size_t j = 0; j < here.size(); ++j) {
        EXPECT_LT((turn * here[j] + shift - there[j + 1]).norm(), 1e-6) << clip.name;
      }
    }
  }
}

TEST(TaskClips, ScaleWithTheBody) {
  const Actor small(test::scaled(builtIn().skeleton, 0.85));
  for (const human::Clip& clip : actor().clips()) {
    for (const double u : {0.2, 0.5}) {
      EXPECT_LT(largestGap(actor(), small, clip.name, u, 0.85), 1e-6) << clip.name;
    }
  }
}

TEST(TaskClips, DoWithoutOptionalJoints) {
  human::RoleMap bare = actor().roles();
  for (const Side side : kSides) {
    bare.set(Role::clavicle, side, {});
    bare.set(Role::toe, side, {});
  }
  bare.set(Role::neck, Side::middle, {});
  bare.set(Role::head, Side::middle, {});
  bare.set(Role::thoracic, Side::middle, {});
  const Actor poor(builtIn().skeleton, bare);
  // The lower back takes what the chest would have.
  EXPECT_NEAR(poor.sum("toe_touch", 0.5, Role::lumbar).flexion, 57.0, 0.01);
  EXPECT_NEAR(poor.angles("squat", 0.5, Role::knee, Side::left).flexion, 110.0, 1.0);
  for (const human::Clip& clip : poor.clips()) {
    for (const human::Channel& channel : clip.channels) {
      EXPECT_TRUE(
          std::all_of(channel.values.begin(), channel.values.end(), [](const auto& v) { return v.allFinite(); }));
    }
  }
}

TEST(TaskClips, AreWithinTheLimitsOfWomenAndMen) {
  for (const human::Person& person : {human::Person{human::Sex::male, 1.755, 84.6}, {human::Sex::female, 1.55, 55.0}}) {
    const Body body = makeBody(person, {2});
    const Actor who(body.skeleton, human::findRoles(body.skeleton), measuredOn(body));
    for (const Role role : {Role::neck, Role::head}) {
      EXPECT_TRUE(who.roles().joint(role)) << static_cast<int>(role);
    }
    EXPECT_TRUE(who.roles().joint(Role::forearmTwist, Side::left));
    for (const human::Clip& clip : who.clips()) {
      for (std::size_t key = 0; key < clip.channels.front().times.size(); key += 5) {
        const double seconds = clip.channels.front().times[key];
        const human::Pose pose = human::sample(clip, who.skeleton(), seconds);
        for (const auto& excess : human::limitExcesses(who.frames(), who.skeleton(), pose, 0.1)) {
          ADD_FAILURE() << person.stature << " m, " << clip.name << " at " << seconds << " s: " << excess.joint << " "
                        << excess.direction << " " << excess.angle << " of " << excess.limit;
        }
      }
    }
    const TaskOptions measured = measuredOn(body);
    const double floor = measured.floor.value();
    EXPECT_NEAR(who.at("kneel_aim", 0.5, Role::knee, Side::right).y() - floor, measured.kneeThickness * person.stature,
                0.006);
    for (const Side side : kSides) {
      EXPECT_NEAR(who.fingertip("toe_touch", 0.5, side, person.stature).y() - floor, 0.012 * person.stature, 0.03);
      EXPECT_LT((who.at("squat", 0.5, Role::ankle, side) - who.atRest(Role::ankle, side)).norm(), 2e-3);
    }
  }
}

TEST(TaskOptions, OfABodyAreItsStatureItsSolesAndItsFlesh) {
  const TaskOptions options = measuredOn(builtIn());
  EXPECT_EQ(options.stature, 1.755);
  EXPECT_NEAR(options.floor.value(), 0.0, 0.002);
  const Actor measured(builtIn().skeleton, actor().roles(), options);
  EXPECT_NEAR(measured.at("kneel_aim", 0.5, Role::knee, Side::right).y(),
              *options.floor + options.kneeThickness * 1.755, 0.004);
}

}  // namespace
}  // namespace lorica::manikin
