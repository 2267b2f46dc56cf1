#include <cmath>

#include "lorica/base/units.h"
#include "motion_table.h"
#include "tasks.h"

namespace lorica::manikin {

using base::degrees;
using base::radians;

namespace {

/// Degrees by which the upper end of a bone lies before its lower one.
double leanAtRest(const Figure& figure, Side side, Role lower, Role upper) {
  const Vec3d bone = figure.restPosition(upper, side) - figure.restPosition(lower, side);
  return degrees(std::atan2(bone.z(), bone.y()));
}

}  // namespace

void standOn(const Figure& figure, Attitude& attitude, double shankLean, double thighLean) {
  Vec3d place = Vec3d::Zero();
  for (const Side side : kSides) {
    // The bone keeps its way sideways and leans in the plane of walking.
    const auto leant = [&](Role lower, Role upper, double lean) {
      const Vec3d bone = figure.restPosition(upper, side) - figure.restPosition(lower, side);
      const double length = std::hypot(bone.y(), bone.z());
      return Vec3d(bone.x(), length * std::cos(radians(lean)), length * std::sin(radians(lean)));
    };
    place += 0.5 * (figure.restPosition(Role::ankle, side) + leant(Role::ankle, Role::knee, shankLean) +
                    leant(Role::knee, Role::hip, thighLean));
    const Leg& rest = figure.rest().legs[placeOf(side)];
    Leg& leg = attitude.legs[placeOf(side)];
    leg = rest;
    const auto more = [&](Role lower, Role upper, double lean) {
      return lean - leanAtRest(figure, side, lower, upper);
    };
    const double thigh = more(Role::knee, Role::hip, thighLean);
    const double shank = more(Role::ankle, Role::knee, shankLean);
    leg.hip.flexion += attitude.pelvis.flexion - thigh;
    leg.knee.flexion += shank - thigh;
    leg.ankle.flexion += shank;
  }
  attitude.place = place;
}

double restLeft(double u) {
  constexpr double fade = 0.2;
  return 1.0 - minimumJerk(u / fade) * minimumJerk((1.0 - u) / fade);
}

void addRest(const Figure& figure, Attitude& attitude, double left) {
  for (std::size_t side = 0; side < 2; ++side) {
    attitude.arms[side] = attitude.arms[side] + figure.rest().arms[side] * left;
  }
}

Stance standing(const Figure& figure, const Attitude& attitude) {
  Stance stance = figure.take(attitude);
  for (const Side side : kSides) {
    figure.reach(stance, Role::hip, Role::knee, Role::ankle, side, figure.restPosition(Role::ankle, side));
    figure.layFoot(stance, side, Quatd::Identity());
  }
  return stance;
}

double upHoldDown(double u) {
  constexpr double up = 0.42;
  return minimumJerk(u / up) * minimumJerk((1.0 - u) / up);
}

namespace {

/// Leans of shank and thigh at rest, degrees, mean of both legs; they fade as the task begins.
struct Leans {
  double shank = 0.0;
  double thigh = 0.0;
};

Leans restLeans(const Figure& figure) {
  Leans leans;
  for (const Side side : kSides) {
    leans.shank += 0.5 * leanAtRest(figure, side, Role::ankle, Role::knee);
    leans.thigh += 0.5 * leanAtRest(figure, side, Role::knee, Role::hip);
  }
  return leans;
}

/// Stands with the table's angles of ankle, knee and pelvis, which fade out of rest.
void standOnTable(const Figure& figure, Attitude& attitude, double u, double dorsiflexion, double knee) {
  const Leans rest = restLeans(figure);
  const double left = restLeft(u);
  standOn(figure, attitude, dorsiflexion + left * rest.shank, dorsiflexion - knee + left * rest.thigh);
}

void setArms(Attitude& attitude, const JointAngles& shoulder, double elbow) {
  for (Arm& arm : attitude.arms) {
    arm.shoulder = shoulder;
    arm.elbow.flexion = elbow;
  }
}

}  // namespace

namespace {

/// Where the fingertips are to touch: the toes' tips.
Vec3d toeTips(const Figure& figure, Side side) {
  const Vec3d& ankle = figure.restPosition(Role::ankle, side);
  return {ankle.x() + figure.ball(side).x(), figure.floor() + 0.012 * figure.stature(),
          ankle.z() + figure.ball(side).z() + 0.045 * figure.stature()};
}

/// Shoulder to fingertip of a straight arm; wrist to fingertip is 0.110 of stature in the joint table.
double armReach(const Figure& figure, Side side) {
  const auto length = [&](Role upper, Role lower) {
    return (figure.restPosition(upper, side) - figure.restPosition(lower, side)).norm();
  };
  return length(Role::shoulder, Role::elbow) + length(Role::elbow, Role::wrist) + 0.110 * figure.stature();
}

struct ToeTouch {
  Curve lumbar = tableCurve("toe_touch", "lumbar_total", "flexion");
  Curve thoracic = tableCurve("toe_touch", "thoracic_total", "flexion");
  Curve cervical = tableCurve("toe_touch", "cervical_total", "flexion");
  Curve hip = tableCurve("toe_touch", "hip (pelvis on femur), both", "flexion");
  Curve knee = tableCurve("toe_touch", "knee, both", "flexion");
  Curve ankle = tableCurve("toe_touch", "ankle, both", "plantarflexion(-)");
  Curve shoulder = tableCurve("toe_touch", "shoulder, both", "flexion");
  Curve abduction = tableCurve("toe_touch", "shoulder, both", "abduction");

  /// \param deeper degrees the hips bend beyond the table at the deepest
  Stance stance(const Figure& figure, double u, double deeper) const {
    Attitude attitude;
    const double depth = hip.at(u) / hip.at(0.5);
    // The legs lean back as one: the pelvis tilts by what the hips bend less that.
    attitude.pelvis.flexion = hip.at(u) + deeper * depth + ankle.at(u) - knee.at(u);
    attitude.lumbar.flexion = lumbar.at(u);
    attitude.thoracic.flexion = thoracic.at(u);
    attitude.neck.flexion = cervical.at(u);
    setArms(attitude, {shoulder.at(u), abduction.at(u), 0.0}, 0.0);
    addRest(figure, attitude, restLeft(u));
    standOnTable(figure, attitude, u, ankle.at(u), knee.at(u));
    Stance stance = standing(figure, attitude);
    for (const Side side : kSides) {
      // The table's arms hang; the deeper the bend, the more they point at the toes.
      const Vec3d& shoulderPlace = figure.position(stance, Role::shoulder, side);
      const Quatd aim = Quatd::FromTwoVectors(figure.position(stance, Role::wrist, side) - shoulderPlace,
                                              toeTips(figure, side) - shoulderPlace);
      figure.turnBelow(stance, figure.joint(Role::shoulder, side), Quatd::Identity().slerp(minimumJerk(depth), aim));
    }
    return stance;
  }

  /// The table's hips bend 70 degrees whatever the proportions; arms that are short for their trunk and legs ask for
  /// more before they reach the toes, up to 25 degrees more.
  double deeper(const Figure& figure) const {
    double low = 0.0;
    double high = 25.0;
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (low + high);
      const Stance deepest = stance(figure, 0.5, middle);
      double missing = 0.0;
      for (const Side side : kSides) {
        missing +=
            (figure.position(deepest, Role::shoulder, side) - toeTips(figure, side)).norm() - armReach(figure, side);
      }
      (missing > 0.0 ? low : high) = middle;
    }
    return high;
  }
};

}  // namespace

Task toeTouch(const Figure& figure) {
  const ToeTouch motion;
  return {"toe_touch", 4.0, 30.0, [motion, deeper = motion.deeper(figure)](const Figure& same, double u) {
            return motion.stance(same, u, deeper);
          }};
}

Task bellyTwist() {
  constexpr auto motion = "belly_twist";
  // The table lists the turn of each motion segment at its left extreme, a quarter of the duration.
  const double lumbar =
      tableSum("trunk_twist", {"spine_L5S1", "spine_L4L5", "spine_L3L4", "spine_L2L3", "spine_L1L2"}, "axial", 0.25);
  const double thoracic =
      tableSum("trunk_twist",
               {"spine_T12L1", "spine_T11T12", "spine_T10T11", "spine_T9T10", "spine_T8T9", "spine_T7T8", "spine_T6T7",
                "spine_T5T6", "spine_T4T5", "spine_T3T4", "spine_T2T3", "spine_T1T2"},
               "axial", 0.25);
  const Curve pelvis = tableCurve(motion, "pelvis_on_feet (both hips)", "axial");
  const Curve cervical = tableCurve(motion, "cervical_total", "axial");
  const Curve flexion = tableCurve(motion, "shoulder, both", "flexion");
  const Curve abduction = tableCurve(motion, "shoulder, both", "abduction");
  const Curve rotation = tableCurve(motion, "shoulder, both", "internal rotation");
  const Curve elbow = tableCurve(motion, "elbow, both", "flexion");
  return {motion, 4.0, 30.0, [=](const Figure& figure, double u) {
            Attitude attitude;
            // To the left, to the right and back, never beyond.
            const double swing =
                minimumJerk(u / 0.25) - 2.0 * minimumJerk((u - 0.25) / 0.5) + minimumJerk((u - 0.75) / 0.25);
            attitude.pelvis.axial = pelvis.at(u);
            attitude.lumbar.axial = lumbar * swing;
            attitude.thoracic.axial = thoracic * swing;
            attitude.neck.axial = cervical.at(u);
            setArms(attitude, {flexion.at(u), abduction.at(u), rotation.at(u)}, elbow.at(u));
            addRest(figure, attitude, restLeft(u));
            standOnTable(figure, attitude, u, 2.0 * (1.0 - restLeft(u)), 4.0 * (1.0 - restLeft(u)));
            return standing(figure, attitude);
          }};
}

namespace {

/// How much higher (or, below zero, lower) the hips may be so that neither leg is longer than at rest.
double reachableRise(const Figure& figure, const Vec3d& place) {
  std::array<double, 2> rises{};
  for (const Side side : kSides) {
    const Vec3d hip = place + figure.restPosition(Role::hip, side) - figure.restHips();
    const Vec3d bone = hip - figure.restPosition(Role::ankle, side);
    const double length = (figure.restPosition(Role::hip, side) - figure.restPosition(Role::ankle, side)).norm();
    const double aside = std::hypot(bone.x(), bone.z());
    rises[placeOf(side)] = std::sqrt(std::max(length * length - aside * aside, 0.0)) - bone.y();
  }
  // The lower of the two, rounded where they change places.
  const double round = 0.0005 * figure.stature();
  const double half = 0.5 * (rises[0] - rises[1]);
  return 0.5 * (rises[0] + rises[1]) - (std::hypot(half, round) - round);
}

}  // namespace

Task lateralTwist() {
  constexpr auto motion = "lateral_twist";
  constexpr auto table = "lateral_bend_twist";
  const Curve lumbarBend = tableCurve(table, "lumbar_total", "lateral bend");
  const Curve lumbarTurn = tableCurve(table, "lumbar_total", "axial");
  const Curve thoracicBend = tableCurve(table, "thoracic_total", "lateral bend");
  const Curve thoracicTurn = tableCurve(table, "thoracic_total", "axial");
  const Curve thoracicFlexion = tableCurve(table, "thoracic_total", "flexion");
  const Curve hips = tableCurve("lateral_bend", "hip, both", "frontal shift (abd one side/add other)");
  const Curve neckBend = tableCurve(motion, "cervical_total", "lateral bend");
  const Curve abduction = tableCurve(motion, "shoulder, both", "abduction");
  return {motion, 4.0, 30.0, [=](const Figure& figure, double u) {
            Attitude attitude;
            attitude.lumbar = {0.0, lumbarBend.at(u), lumbarTurn.at(u)};
            attitude.thoracic = {thoracicFlexion.at(u), thoracicBend.at(u), thoracicTurn.at(u)};
            attitude.neck = {0.0, neckBend.at(u), 0.0};
            setArms(attitude, {0.0, abduction.at(u), 0.0}, 0.0);
            addRest(figure, attitude, restLeft(u));
            standOnTable(figure, attitude, u, 0.0, 0.0);
            // The pelvis gives way to the other side, as high as both legs reach.
            const double height = attitude.place.y() - figure.restPosition(Role::ankle, Side::left).y();
            attitude.place.x() -= height * std::sin(radians(hips.at(u)));
            attitude.place.y() += reachableRise(figure, attitude.place);
            return standing(figure, attitude);
          }};
}

Task squat() {
  constexpr auto motion = "squat";
  const Curve knee = tableCurve(motion, "knee, both", "flexion");
  const Curve ankle = tableCurve(motion, "ankle, both", "dorsiflexion");
  const Curve tilt = tableCurve(motion, "pelvis", "anterior tilt");
  const Curve lumbar = tableCurve(motion, "lumbar_total", "flexion (relative)");
  const Curve shoulder = tableCurve(motion, "shoulder, both", "flexion");
  const Curve neck = tableCurve(motion, "cervical_total", "extension");
  return {motion, 3.5, 30.0, [=](const Figure& figure, double u) {
            Attitude attitude;
            attitude.pelvis.flexion = tilt.at(u);
            attitude.lumbar.flexion = lumbar.at(u);
            attitude.neck.flexion = -neck.at(u);
            setArms(attitude, {shoulder.at(u), 0.0, 0.0}, 0.0);
            addRest(figure, attitude, restLeft(u));
            standOnTable(figure, attitude, u, ankle.at(u), knee.at(u));
            return standing(figure, attitude);
          }};
}

Task armRaise() {
  constexpr auto motion = "arm_raise";
  const Curve flexion = tableCurve(motion, "shoulder, both", "flexion");
  const Curve abduction = tableCurve(motion, "shoulder, both", "abduction");
  const Curve girdle = tableCurve(motion, "sternoclavicular, both", "elevation");
  const Curve blade = tableCurve(motion, "acromioclavicular, both", "upward rotation");
  const Curve thoracic = tableCurve(motion, "thoracic_total", "extension");
  return {motion, 3.5, 30.0, [=](const Figure& figure, double u) {
            Attitude attitude;
            const double s = upHoldDown(u);
            attitude.thoracic.flexion = -thoracic.at(s);
            setArms(attitude, {flexion.at(s), abduction.at(s), 0.0}, 0.0);
            for (Arm& arm : attitude.arms) {
              arm.clavicle.abduction = girdle.at(s);
              arm.blade = blade.at(s);
            }
            addRest(figure, attitude, restLeft(u));
            standOnTable(figure, attitude, u, 0.0, 0.0);
            return standing(figure, attitude);
          }};
}

Task sit() {
  constexpr auto motion = "sit";
  const Curve knee = tableCurve(motion, "knee, both", "flexion");
  const Curve ankle = tableCurve(motion, "ankle, both", "dorsiflexion");
  const Curve tilt = tableCurve(motion, "pelvis", "anterior tilt");
  const Curve lumbar = tableCurve(motion, "lumbar_total", "flexion");
  const Curve shoulder = tableCurve(motion, "shoulder, both", "flexion");
  const Curve elbow = tableCurve(motion, "elbow, both", "flexion");
  return {motion, 4.0, 30.0, [=](const Figure& figure, double u) {
            Attitude attitude;
            const double s = upHoldDown(u);
            attitude.pelvis.flexion = tilt.at(s);
            attitude.lumbar.flexion = lumbar.at(s);
            attitude.neck.flexion = -0.5 * (tilt.at(s) + lumbar.at(s));
            setArms(attitude, {shoulder.at(s), 0.0, 0.0}, elbow.at(s));
            addRest(figure, attitude, restLeft(u));
            standOnTable(figure, attitude, u, ankle.at(s), knee.at(s));
            return standing(figure, attitude);
          }};
}

}  // namespace lorica::manikin
