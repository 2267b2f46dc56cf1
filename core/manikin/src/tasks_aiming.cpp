#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/base/units.h"
#include "motion_table.h"
#include "tasks.h"

namespace lorica::manikin {

using base::radians;

namespace {

constexpr Side kTrigger = Side::right;
constexpr Side kSupport = Side::left;

/// Where the wrists belong and how the hands lie.
struct Grip {
  Vec3d wrist;
  Quatd hand;       ///< turn away from the anatomical position
  Vec3d elbowSide;  ///< which way the elbow goes
};

struct Rifle {
  Grip trigger;
  Grip support;
};

/// Turn of a hand whose fingers point along `fingers`, its thumb side towards `thumb`.
Quatd handAlong(const Vec3d& fingers, const Vec3d& thumb) {
  Eigen::Matrix3d m;
  m.col(1) = -fingers.normalized();
  m.col(2) = (thumb - thumb.dot(m.col(1)) * m.col(1)).normalized();
  m.col(0) = m.col(1).cross(m.col(2));
  return Quatd(m);
}

/// The rifle lies along z below the aiming eye, its butt at the shoulder.
Rifle rifleOf(const Figure& figure, const Stance& stance, double supportReach) {
  const double scale = figure.stature() / 1.755;
  const double pull = scale * (tableValue("rifle", "shoulder joint to butt", "distance") +
                               tableValue("rifle", "butt to trigger hand", "distance"));
  const double sight = scale * tableValue("rifle", "eye over grips", "distance");
  const double palm = 0.045 * figure.stature();  // wrist to the middle of the palm
  const Vec3d eye = figure.eye(stance, kTrigger);
  const Vec3d& shoulder = figure.position(stance, Role::shoulder, kTrigger);
  const Vec3d grip(eye.x(), eye.y() - sight, shoulder.z() + pull);
  const Vec3d handguard = grip + Vec3d(0.0, 0.25 * sight, supportReach);
  // The palm lies beside the grip and under the handguard.
  return {{grip + Vec3d(-0.012 * figure.stature(), 0.0, -palm),
           handAlong({0.1, -0.25, 1.0}, Vec3d::UnitY()),
           {-0.8, -0.6, 0.0}},
          {handguard + Vec3d(0.012 * figure.stature(), -0.02 * figure.stature(), -palm),
           handAlong({-0.15, 0.1, 1.0}, Vec3d(0.9, 0.5, 0.0)),
           {0.25, -1.0, 0.0}}};
}

/// The circle an elbow can be turned on while shoulder and wrist stay.
struct ElbowCircle {
  Vec3d centre;
  Vec3d now;     ///< from the centre to the elbow
  Vec3d across;  ///< a quarter turn further
};

ElbowCircle elbowCircle(const Figure& figure, const Stance& stance, Side side) {
  const Vec3d& shoulder = figure.position(stance, Role::shoulder, side);
  const Vec3d axis = (figure.position(stance, Role::wrist, side) - shoulder).normalized();
  const Vec3d arm = figure.position(stance, Role::elbow, side) - shoulder;
  const Vec3d along = arm.dot(axis) * axis;
  return {shoulder + along, arm - along, axis.cross(arm - along)};
}

/// The turn that brings the elbow nearest to a direction.
double swivelTowards(const ElbowCircle& circle, const Vec3d& wanted) {
  return std::atan2(wanted.dot(circle.across), wanted.dot(circle.now));
}

/// The turn that brings the elbow onto the floor on the side of a direction, else as low as it gets.
double swivelOntoFloor(const Figure& figure, const ElbowCircle& circle, const Vec3d& wanted) {
  const double range = std::hypot(circle.now.y(), circle.across.y());
  const double top = std::atan2(circle.across.y(), circle.now.y());
  const double height = figure.floor() + figure.elbowHeight() - circle.centre.y();
  const double away = std::acos(std::clamp(height / std::max(range, 1e-9), -1.0, 1.0));
  const auto outwards = [&](double angle) {
    return wanted.x() * (std::cos(angle) * circle.now + std::sin(angle) * circle.across).x();
  };
  const double angle = outwards(top + away) > outwards(top - away) ? top + away : top - away;
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

void aimArm(const Figure& figure, Stance& stance, Side side, const Grip& grip, const Aim& aim) {
  const Vec3d& wrist = figure.position(stance, Role::wrist, side);
  figure.reach(stance, Role::shoulder, Role::elbow, Role::wrist, side, wrist + aim.weight * (grip.wrist - wrist));
  const double swivel =
      aim.swivels ? (*aim.swivels)[placeOf(side)] : swivelTowards(elbowCircle(figure, stance, side), grip.elbowSide);
  figure.swivel(stance, side, aim.weight * swivel);
  // Forearm and hand share the turn that lays the hand to the rifle, within what a wrist can do.
  const Quatd forearm = figure.partTurn(stance, Role::elbow, side);
  JointAngles hand = human::angles(Role::wrist, side, forearm.conjugate() * grip.hand);
  hand.flexion = std::clamp(hand.flexion, -45.0, 45.0);
  hand.abduction = std::clamp(hand.abduction, -22.0, 15.0);
  hand.axial = std::clamp(hand.axial, -80.0, 70.0);
  figure.turnHand(stance, side, hand, aim.weight);
}

}  // namespace

void aimRifle(const Figure& figure, Stance& stance, const Aim& aim) {
  if (aim.weight <= 0.0) {
    return;
  }
  const Rifle rifle = rifleOf(figure, stance, aim.supportReach);
  aimArm(figure, stance, kTrigger, rifle.trigger, aim);
  aimArm(figure, stance, kSupport, rifle.support, aim);
}

FloorRest restOnElbows(const Figure& figure, const Stance& stance, double supportReach) {
  FloorRest rest;
  const auto reached = [&](Side side, double reach) {
    Stance aiming = stance;
    const Rifle rifle = rifleOf(figure, aiming, reach);
    const Grip& grip = side == kTrigger ? rifle.trigger : rifle.support;
    figure.reach(aiming, Role::shoulder, Role::elbow, Role::wrist, side, grip.wrist);
    return elbowCircle(figure, aiming, side);
  };
  const auto touches = [&](double reach) {
    const ElbowCircle circle = reached(kSupport, reach);
    const double lowest = circle.centre.y() - std::hypot(circle.now.y(), circle.across.y());
    return lowest <= figure.floor() + figure.elbowHeight();
  };
  rest.supportReach = supportReach;
  if (!touches(supportReach)) {
    double low = 0.4 * supportReach;
    double high = supportReach;
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (low + high);
      (touches(middle) ? low : high) = middle;
    }
    rest.supportReach = low;
  }
  const Rifle rifle = rifleOf(figure, stance, rest.supportReach);
  for (const Side side : kSides) {
    const Vec3d& wanted = side == kTrigger ? rifle.trigger.elbowSide : rifle.support.elbowSide;
    rest.swivels[placeOf(side)] = swivelOntoFloor(figure, reached(side, rest.supportReach), wanted);
  }
  return rest;
}

namespace {

/// Lengths of a leg and how it rests, in the plane of walking.
struct LegLengths {
  double thigh = 0.0;
  double shank = 0.0;
};

LegLengths lengthsOf(const Figure& figure, Side side) {
  return {(figure.restPosition(Role::hip, side) - figure.restPosition(Role::knee, side)).norm(),
          (figure.restPosition(Role::knee, side) - figure.restPosition(Role::ankle, side)).norm()};
}

Quatd aboutX(double degrees) {
  return Quatd(Eigen::AngleAxisd(radians(degrees), Vec3d::UnitX()));
}

/// Toes' tips from the ankle of a foot at rest, and half their thickness: they end 0.0495 of stature before the ball's
/// joint, 0.008 above the sole (joint table).
Vec3d toeTip(const Figure& figure, Side side) {
  return figure.ball(side) + figure.stature() * Vec3d(0.0, -0.0076, 0.0495);
}
double toeThickness(const Figure& figure) {
  return 0.008 * figure.stature();
}

/// Rise of the shank, degrees, from a knee on the floor to the ankle of a foot that lies on its back, bent downwards by
/// `plantarflexion`.
double lyingShankRise(const Figure& figure, Side side, double plantarflexion) {
  const double shank = lengthsOf(figure, side).shank;
  double rise = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Quatd foot = aboutX(90.0 + rise + plantarflexion);
    const double ball = figure.soleHeight(side) + figure.ball(side).y() - (foot * figure.ball(side)).y();
    const double toes = toeThickness(figure) - (foot * toeTip(figure, side)).y();
    rise = base::degrees(std::asin(std::clamp((std::max(ball, toes) - figure.kneeHeight()) / shank, -0.5, 0.5)));
  }
  return rise;
}

constexpr double kToesBent = 65.0;  ///< most that toes under a foot bend, below the limit of the joint table

/// How far along its way from toes bent under a standing foot to a foot lying on its back a pitched foot is.
double lying(const Quatd& foot) {
  constexpr double begin = 0.5;  // cosine of the foot's pitch
  return minimumJerk((begin - (foot * Vec3d::UnitZ()).z()) / (2.0 * begin));
}

/// How deep a foot would dip into the floor with the ball or, when it lies, with the toes; metres, negative above it.
double footDepth(const Figure& figure, const Stance& stance, Side side) {
  const Quatd& foot = stance.carry[figure.joint(Role::ankle, side).value];
  const Vec3d& ankle = figure.position(stance, Role::ankle, side);
  const Vec3d ball = figure.ball(side);
  const double ballHeight = figure.soleHeight(side) + ball.y();
  const double ballDepth = figure.floor() + ballHeight - (ankle + foot * ball).y();
  const double toesDepth = figure.floor() + toeThickness(figure) - (ankle + foot * toeTip(figure, side)).y();
  return ballDepth + lying(foot) * std::max(0.0, toesDepth - ballDepth);
}

/// Lifts a foot that would dip into the floor; bends the toes that stand on it.
void settleFoot(const Figure& figure, Stance& stance, Side side) {
  const Quatd foot = stance.carry[figure.joint(Role::ankle, side).value];
  // The floor meets the foot softly: the first millimetres do not lift it in full, so that it is not struck.
  const double soft = 0.0046 * figure.stature();
  const double dip = std::max(0.0, footDepth(figure, stance, side));
  const double depth = dip < soft ? 0.5 * dip * dip / soft : dip - 0.5 * soft;
  if (depth > 1e-9) {
    const Vec3d& ankle = figure.position(stance, Role::ankle, side);
    figure.reach(stance, Role::hip, Role::knee, Role::ankle, side, ankle + Vec3d(0.0, depth, 0.0));
    figure.layFoot(stance, side, foot);
  }
  const double pitch = base::degrees(std::asin(std::clamp(-(foot * Vec3d::UnitZ()).y(), 0.0, 1.0)));
  const double extension = std::min(pitch, kToesBent) * (1.0 - lying(foot));
  for (const human::JointIndex toe : figure.roles().joints(Role::toe, side)) {
    figure.turnBelow(stance, toe, foot * aboutX(-extension) * stance.carry[toe.value].conjugate());
  }
}

/// Puts a foot down, its ankle at a place; where the shank would lean further over it than an ankle bends, the heel
/// rises about the ball.
void plantFoot(const Figure& figure, Stance& stance, Side side, const Vec3d& ankle, const Quatd& foot) {
  constexpr double soft = 10.0;  // degrees over which the heel begins to rise
  // A degree below the limit of the joint table, or what the rig rests with.
  const double most = std::max(19.0, figure.rest().legs[placeOf(side)].ankle.flexion + soft);
  const Vec3d ball = foot * figure.ball(side);
  const Stance before = stance;
  const auto beyond = [&](double heelUp) {
    stance = before;
    figure.reach(stance, Role::hip, Role::knee, Role::ankle, side, ankle + ball - aboutX(heelUp) * ball);
    figure.layFoot(stance, side, aboutX(heelUp) * foot);
    settleFoot(figure, stance, side);
    const Quatd shank = figure.partTurn(stance, Role::knee, side);
    const Quatd bend = shank.conjugate() * figure.partTurn(stance, Role::ankle, side);
    return human::angles(Role::ankle, side, bend).flexion - most;
  };
  double low = -30.0;
  double high = 80.0;
  for (int i = 0; i < 16; ++i) {
    const double middle = 0.5 * (low + high);
    (beyond(middle) > 0.0 ? low : high) = middle;
  }
  // It begins to rise a little before it must, so that it does so without a jerk.
  const double eased = high < soft ? 0.25 * std::pow(std::max(0.0, high + soft), 2.0) / soft : high;
  beyond(eased);
}

}  // namespace

Task kneelAim() {
  constexpr auto table = "kneel_one_knee";
  constexpr auto own = "kneel_aim";
  const auto pose = [](const char* motion, const char* joint, const char* axis) {
    return tableValue(motion, joint, axis);
  };
  const double lumbar = pose(table, "lumbar", "flexion");
  const double frontDorsiflexion = pose(table, "front ankle", "dorsiflexion");
  const double frontHipBend = pose(table, "front hip", "flexion");
  const double frontKneeBend = pose(table, "front knee", "flexion");
  const double shoulder = pose(own, "shoulder, both", "flexion");
  const double elbow = pose(own, "elbow, both", "flexion");
  const double rearHip = pose(table, "rear hip", "flexion");
  const double rearKnee = pose(table, "rear knee", "flexion");
  const double rearPlantarflexion = pose(table, "rear ankle", "plantarflexion");
  const double tilt = pose(own, "pelvis", "anterior tilt");
  const double turn = pose(own, "pelvis", "axial");
  const JointAngles thoracic{pose(own, "thoracic_total", "flexion"), 0.0, pose(own, "thoracic_total", "axial")};
  const JointAngles neck{0.0, pose(own, "cervical_total", "lateral bend"), pose(own, "cervical_total", "axial")};
  const double fingers = pose(own, "fingers, both", "flexion");
  const double supportReach = pose("rifle", "trigger hand to support hand", "distance");
  return {own, 5.0, 30.0, [=](const Figure& figure, double u) {
            const double s = upHoldDown(u);
            Attitude attitude;
            attitude.pelvis = JointAngles{tilt, 0.0, turn} * s;
            attitude.lumbar.flexion = lumbar * s;
            attitude.thoracic = thoracic * s;
            attitude.neck = neck * s;
            const double aim = minimumJerk((s - 0.35) / 0.65);
            for (Arm& arm : attitude.arms) {
              arm.shoulder = {shoulder * s, 0.0, 0.0};
              arm.elbow.flexion = elbow * s;
              arm.fingers = fingers * aim;
            }
            addRest(figure, attitude, restLeft(u));
            // The rear thigh stands on its knee; the front foot stays, its shank leans as the table says.
            const LegLengths front = lengthsOf(figure, kSupport);
            const LegLengths rear = lengthsOf(figure, kTrigger);
            const double thighLean = tilt - rearHip;
            const Vec3d& frontAnkle = figure.restPosition(Role::ankle, kSupport);
            const double hipHeight = figure.floor() + figure.kneeHeight() + rear.thigh * std::cos(radians(thighLean));
            const double kneeHeight = frontAnkle.y() + front.shank * std::cos(radians(frontDorsiflexion));
            const double rise = std::clamp((hipHeight - kneeHeight) / front.thigh, -0.9, 0.9);
            const double frontHip = frontAnkle.z() + front.shank * std::sin(radians(frontDorsiflexion)) -
                                    front.thigh * std::sqrt(1.0 - rise * rise);
            const Vec3d half =
                0.5 * (figure.restPosition(Role::hip, kSupport) - figure.restPosition(Role::hip, kTrigger));
            const Quatd yaw(Eigen::AngleAxisd(radians(turn), Vec3d::UnitY()));
            const Vec3d kneeling(figure.restHips().x(), hipHeight, frontHip - (yaw * half).z());
            // The hips go back before they go down, lest the front shank leans too far.
            const double backwards = minimumJerk(s / 0.7);
            attitude.place = figure.restHips() + Vec3d(s, s, backwards).cwiseProduct(kneeling - figure.restHips());
            for (std::size_t side = 0; side < 2; ++side) {
              attitude.legs[side] = figure.rest().legs[side];
            }
            Leg& back = attitude.legs[placeOf(kTrigger)];
            back.hip.flexion += s * (rearHip - back.hip.flexion);
            back.knee.flexion += s * (rearKnee - back.knee.flexion);
            // The pelvis is turned, the legs are not: thigh and shank of the rear leg stand in one upright plane.
            back.hip.abduction *= 1.0 - s;
            back.knee.abduction *= 1.0 - s;
            back.hip.axial += s * (-turn - back.hip.axial);
            Leg& fore = attitude.legs[placeOf(kSupport)];
            fore.hip.flexion += s * (frontHipBend - fore.hip.flexion);
            fore.knee.flexion += s * (frontKneeBend - fore.knee.flexion);
            fore.hip.axial += s * (turn - fore.hip.axial);
            Stance stance = figure.take(attitude);
            // The rear knee stands below its hip; its ankle lies behind it.
            const Vec3d rearHipPlace = kneeling - yaw * half;
            const double shankRise = radians(lyingShankRise(figure, kTrigger, rearPlantarflexion));
            const double pitch = 90.0 + base::degrees(shankRise) + rearPlantarflexion;
            const Vec3d behind(
                figure.restPosition(Role::ankle, kTrigger).x(),
                figure.floor() + figure.kneeHeight() + rear.shank * std::sin(shankRise),
                rearHipPlace.z() - rear.thigh * std::sin(radians(thighLean)) - rear.shank * std::cos(shankRise));
            const Vec3d& rearStand = figure.restPosition(Role::ankle, kTrigger);
            const double step = minimumJerk(s / 0.75);
            Vec3d rearAnkle = rearStand + step * (behind - rearStand);
            // The foot is lifted on its way back.
            rearAnkle.y() += 0.12 * rear.shank * std::pow(std::sin(std::numbers::pi * step), 2.0);
            plantFoot(figure, stance, kSupport, frontAnkle, Quatd::Identity());
            plantFoot(figure, stance, kTrigger, rearAnkle, aboutX(pitch * step));
            const double reach = figure.stature() / 1.755 * supportReach;
            aimRifle(figure, stance, {aim, reach, std::nullopt});
            return stance;
          }};
}

namespace {

/// Postures on the way to the floor.
struct ProneWay {
  Attitude kneeling;
  Attitude fours;
  Attitude prone;
};

void bendLegs(const Figure& figure, Attitude& attitude, const JointAngles& hip, double knee, double ankle) {
  for (const Side side : kSides) {
    Leg& leg = attitude.legs[placeOf(side)];
    leg = figure.rest().legs[placeOf(side)];
    leg.hip = {hip.flexion, hip.abduction + leg.hip.abduction, hip.axial};
    leg.knee.flexion = knee;
    leg.ankle.flexion = ankle;
  }
}

/// Pitch of the pelvis, between 70 and 110 degrees, at which the shoulders are as high as leaning upper arms lift them
/// from elbows on the floor.
double pronePitch(const Figure& figure, Attitude attitude, double armLean) {
  const double arm =
      (figure.restPosition(Role::shoulder, kSupport) - figure.restPosition(Role::elbow, kSupport)).norm();
  const double wanted = figure.floor() + figure.elbowHeight() + arm * std::cos(radians(armLean));
  double low = 70.0;
  double high = 110.0;
  for (int i = 0; i < 40; ++i) {
    attitude.pelvis.flexion = 0.5 * (low + high);
    const Stance stance = figure.take(attitude);
    const double height = 0.5 * (figure.position(stance, Role::shoulder, kSupport).y() +
                                 figure.position(stance, Role::shoulder, kTrigger).y());
    (height > wanted ? low : high) = attitude.pelvis.flexion;
  }
  return 0.5 * (low + high);
}

/// \param armLean degrees from the vertical by which the upper arms lean; sets how high the chest is
ProneWay proneWay(const Figure& figure, double armLean) {
  constexpr auto table = "prone_rifle";
  constexpr auto own = "prone_aim";
  constexpr auto two = "kneel_two_knees";
  constexpr auto axis = "flexion(+)/plantarflexion(-)";
  ProneWay way;
  const LegLengths leg = lengthsOf(figure, kSupport);
  const Vec3d stand = figure.restHips();
  const double ankle = figure.restPosition(Role::ankle, kSupport).z();

  way.kneeling.pelvis.flexion = tableValue(two, "hip, both", axis);
  bendLegs(figure, way.kneeling, {tableValue(two, "hip, both", axis), 0.0, 0.0}, tableValue(two, "knee, both", axis),
           tableValue(two, "ankle, both", axis));
  way.kneeling.place = {stand.x(), figure.floor() + figure.kneeHeight() + leg.thigh, ankle + leg.shank};

  const double tilt = tableValue(own, "pelvis on all fours", "anterior tilt");
  const double hip = tableValue(own, "hip on all fours, both", "flexion");
  bendLegs(figure, way.fours, {hip, 0.0, 0.0}, tableValue(own, "knee on all fours, both", "flexion"),
           tableValue(two, "ankle, both", axis));
  way.fours.pelvis.flexion = tilt;
  way.fours.neck.flexion = -tableValue(own, "cervical_total on all fours", "extension");
  way.fours.place = {stand.x(), figure.floor() + figure.kneeHeight() + leg.thigh * std::cos(radians(tilt - hip)),
                     ankle + leg.shank - leg.thigh * std::sin(radians(hip - tilt))};
  for (Arm& arm : way.fours.arms) {
    arm.shoulder.flexion = tableValue(own, "shoulder on all fours, both", "flexion");
    arm.pronation = tableValue(own, "forearm on all fours, both", "pronation");
    arm.wrist.flexion = -tableValue(own, "wrist on all fours, both", "extension");
  }

  Attitude& prone = way.prone;
  prone.place = {stand.x(), figure.floor() + figure.pelvisHeight(), ankle + leg.shank};
  prone.pelvis.axial = -tableValue(table, "thorax_to_rifle", "axial offset of body from line of fire");
  prone.lumbar.flexion = -tableValue(table, "lumbar_total", "extension");
  prone.thoracic.flexion = -tableValue(table, "thoracic_total", "extension");
  prone.neck = {-tableValue(table, "cervical_total", "extension"), 0.0, tableValue(table, "head", "axial to stock")};
  prone.head.flexion = -tableValue(table, "C0-C1", "extension");
  prone.pelvis.flexion = pronePitch(figure, prone, armLean);
  // The thighs slope down from the hips to knees that lie on the floor.
  const double slope = std::asin(std::clamp((figure.pelvisHeight() - figure.kneeHeight()) / leg.thigh, -0.5, 0.5));
  const JointAngles hips{prone.pelvis.flexion - 90.0 + base::degrees(slope),
                         tableValue(table, "hip, both", "abduction"),
                         -tableValue(table, "hip, both", "external rotation")};
  const double plantarflexion = tableValue(own, "ankle, both", "plantarflexion");
  // The knees bend from the table's angle until the feet lie on the floor and not in it: on the joints of the toes,
  // whose backs are lower than the tips of feet as flat as these.
  const double joints = 0.0075 * figure.stature();
  double low = tableValue(table, "knee, both", "flexion");
  double high = low + 40.0;
  for (int i = 0; i < 30; ++i) {
    const double knee = 0.5 * (low + high);
    bendLegs(figure, prone, hips, knee, -plantarflexion);
    const Stance stance = figure.take(prone);
    const double depth = std::max(footDepth(figure, stance, Side::left), footDepth(figure, stance, Side::right));
    (depth + joints > 0.0 ? low : high) = knee;
  }
  for (Arm& arm : prone.arms) {
    arm.shoulder = {tableValue(own, "shoulder, both", "flexion"), tableValue(own, "shoulder, both", "abduction"), 0.0};
    arm.elbow.flexion = tableValue(own, "elbow, both", "flexion");
    arm.fingers = tableValue(own, "fingers, both", "flexion");
  }
  return way;
}

}  // namespace

namespace {

/// Shares of the way from standing over kneeling and all fours to lying; each posture is at rest.
struct ProneShares {
  double kneel = 0.0;
  double fours = 0.0;
  double prone = 0.0;

  explicit ProneShares(double s) {
    constexpr double kneeling = 0.36;
    constexpr double onFours = 0.66;
    kneel = minimumJerk(s / kneeling);
    fours = minimumJerk((s - kneeling) / (onFours - kneeling));
    prone = minimumJerk((s - onFours) / (1.0 - onFours));
  }
};

/// The stance on the way, arms not yet at the rifle.
Stance onTheWay(const Figure& figure, const ProneWay& way, const ProneShares& share) {
  Stance stance = figure.take(figure.rest() * (1.0 - share.kneel) + way.kneeling * (share.kneel - share.fours) +
                              way.fours * (share.fours - share.prone) + way.prone * share.prone);
  // The lower knee is on the floor from kneeling onwards.
  const double knees = std::min(figure.position(stance, Role::knee, Side::left).y(),
                                figure.position(stance, Role::knee, Side::right).y());
  figure.moveAll(stance, {0.0, share.kneel * (figure.floor() + figure.kneeHeight() - knees), 0.0});
  // As long as it stands, the balls of the feet stay where they are; then the feet follow the legs.
  for (const Side side : kSides) {
    const Vec3d& free = figure.position(stance, Role::ankle, side);
    const Quatd foot = Quatd::Identity().slerp(share.kneel, stance.carry[figure.joint(Role::ankle, side).value]);
    const Vec3d ball = figure.ball(side);
    const Vec3d onBall = figure.restPosition(Role::ankle, side) + ball - foot * ball;
    plantFoot(figure, stance, side, onBall + share.kneel * (free - onBall), foot);
  }
  return stance;
}

}  // namespace

Task proneAim(const Figure& figure) {
  const double reach = figure.stature() / 1.755 * tableValue("prone_aim", "trigger hand to support hand", "distance");
  // Arms that are short for their trunk lie lower, up to 15 degrees more than the table's lean.
  double lean = tableValue("prone_aim", "upper arm, both", "lean from vertical");
  const double most = lean + 15.0;
  ProneWay way = proneWay(figure, lean);
  FloorRest rest = restOnElbows(figure, onTheWay(figure, way, ProneShares(1.0)), reach);
  while (rest.supportReach < reach && lean < most) {
    lean += 2.5;
    way = proneWay(figure, lean);
    rest = restOnElbows(figure, onTheWay(figure, way, ProneShares(1.0)), reach);
  }
  return {"prone_aim", 9.0, 30.0, [=](const Figure& same, double u) {
            const ProneShares share(upHoldDown(u));
            Stance stance = onTheWay(same, way, share);
            aimRifle(same, stance, {share.prone, rest.supportReach, rest.swivels});
            return stance;
          }};
}

}  // namespace lorica::manikin
