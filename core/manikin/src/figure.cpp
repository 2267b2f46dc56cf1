#include "figure.h"

#include <algorithm>
#include <cmath>

#include "lorica/base/error.h"
#include "lorica/base/units.h"

namespace lorica::manikin {

using base::radians;
using human::JointIndex;
using human::Part;

namespace {

/// Metres or radians below which nothing has moved: rest stays rest, bit for bit.
constexpr double kStill = 1e-9;

}  // namespace

Arm Arm::operator+(const Arm& other) const {
  return {clavicle + other.clavicle, blade + other.blade,         shoulder + other.shoulder, elbow + other.elbow,
          wrist + other.wrist,       pronation + other.pronation, fingers + other.fingers};
}

Arm Arm::operator*(double factor) const {
  return {clavicle * factor, blade * factor,     shoulder * factor, elbow * factor,
          wrist * factor,    pronation * factor, fingers * factor};
}

Leg Leg::operator+(const Leg& other) const {
  return {hip + other.hip, knee + other.knee, ankle + other.ankle, toeExtension + other.toeExtension};
}

Leg Leg::operator*(double factor) const {
  return {hip * factor, knee * factor, ankle * factor, toeExtension * factor};
}

Attitude Attitude::operator+(const Attitude& other) const {
  return {place + other.place,
          pelvis + other.pelvis,
          lumbar + other.lumbar,
          thoracic + other.thoracic,
          neck + other.neck,
          head + other.head,
          {arms[0] + other.arms[0], arms[1] + other.arms[1]},
          {legs[0] + other.legs[0], legs[1] + other.legs[1]}};
}

Attitude Attitude::operator*(double factor) const {
  return {place * factor,
          pelvis * factor,
          lumbar * factor,
          thoracic * factor,
          neck * factor,
          head * factor,
          {arms[0] * factor, arms[1] * factor},
          {legs[0] * factor, legs[1] * factor}};
}

Figure::Figure(const human::Skeleton& skeleton, const human::RoleMap& roles, const TaskOptions& options)
    : skeleton_(skeleton), roles_(roles), frames_(skeleton, roles), partOf_(skeleton.size()), options_(options) {
  for (std::size_t p = 0; p < frames_.parts().size(); ++p) {
    partOf_[frames_.parts()[p].joint.value] = p;
  }
  below_.resize(skeleton.size());
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    for (std::optional<JointIndex> above = JointIndex{j}; above; above = skeleton.joint(*above).parent) {
      below_[above->value].push_back(j);
    }
  }
  double legs = 0.0;
  double ankles = 0.0;
  for (const Side side : kSides) {
    legs += 0.5 * ((restPosition(Role::hip, side) - restPosition(Role::knee, side)).norm() +
                   (restPosition(Role::knee, side) - restPosition(Role::ankle, side)).norm());
    ankles += 0.5 * restPosition(Role::ankle, side).y();
  }
  // Hip 0.5130, ankle 0.0415 of stature in the joint table.
  stature_ = options.stature.value_or(legs / 0.4715);
  floor_ = options.floor.value_or(ankles - 0.0415 * stature_);
  rest_.place = restHips();
  for (const Side side : kSides) {
    const auto angles = [&](Role role) {
      const auto part = frames_.part(role, side);
      return part ? frames_.parts()[*part].rest : JointAngles{};
    };
    Arm& arm = rest_.arms[placeOf(side)];
    arm.shoulder = angles(Role::shoulder);
    arm.elbow = angles(Role::elbow);
    arm.wrist = angles(Role::wrist);
    // The pronation is kept apart; what a bent bone adds to these angles stays with them.
    if (frames_.part(Role::forearmTwist, side)) {
      arm.pronation = angles(Role::forearmTwist).axial;
    } else {
      arm.pronation = arm.elbow.axial + arm.wrist.axial;
      arm.elbow.axial -= 0.5 * arm.pronation;
      arm.wrist.axial -= 0.5 * arm.pronation;
    }
    Leg& leg = rest_.legs[placeOf(side)];
    leg.hip = angles(Role::hip);
    leg.knee = angles(Role::knee);
    leg.ankle = angles(Role::ankle);
  }
}

Vec3d Figure::restHips() const {
  return 0.5 * (restPosition(Role::hip, Side::left) + restPosition(Role::hip, Side::right));
}

Vec3d Figure::ball(Side side) const {
  const auto toes = roles_.joints(Role::toe, side);
  if (toes.empty()) {
    return stature_ * Vec3d(0.0, -0.0259, 0.0765);
  }
  Vec3d sum = Vec3d::Zero();
  for (const JointIndex toe : toes) {
    sum += frames_.restPosition(toe);
  }
  return sum / static_cast<double>(toes.size()) - restPosition(Role::ankle, side);
}

JointAngles Figure::anglesOf(const Part& part, const Attitude& attitude) const {
  const Arm& arm = attitude.arms[part.side == Side::right ? 1 : 0];
  const Leg& leg = attitude.legs[part.side == Side::right ? 1 : 0];
  for (const human::SpineSegment& segment : frames_.spine()) {
    if (segment.joint == part.joint) {
      return shareOf(segment, attitude.lumbar, 0, human::kFirstThoracicLevel) +
             shareOf(segment, attitude.thoracic, human::kFirstThoracicLevel, human::kFirstCervicalLevel) +
             shareOf(segment, attitude.neck, human::kFirstCervicalLevel, human::kHeadLevel) +
             shareOf(segment, attitude.head, human::kHeadLevel, human::kSpineLevels);
    }
  }
  const bool twists = frames_.part(Role::forearmTwist, part.side).has_value();
  switch (part.role) {
    case Role::clavicle: {
      const auto girdle = roles_.joints(Role::clavicle, part.side);
      JointAngles angles = arm.clavicle * (1.0 / static_cast<double>(girdle.size()));
      if (girdle.size() > 1 && part.joint == girdle.back()) {
        angles.abduction += arm.blade;
      }
      return angles;
    }
    case Role::shoulder:
      return arm.shoulder;
    case Role::elbow:
      return arm.elbow + JointAngles{0.0, 0.0, twists ? 0.0 : 0.5 * arm.pronation};
    case Role::forearmTwist:
      return {0.0, 0.0, arm.pronation};
    case Role::wrist:
      return arm.wrist + JointAngles{0.0, 0.0, twists ? 0.0 : 0.5 * arm.pronation};
    case Role::index:
    case Role::middle:
    case Role::ring:
    case Role::little:
      return {arm.fingers, 0.0, 0.0};
    case Role::hip:
      return leg.hip;
    case Role::knee:
      return leg.knee;
    case Role::ankle:
      return leg.ankle;
    case Role::toe:
      return {-leg.toeExtension, 0.0, 0.0};
    default:
      return {};
  }
}

Stance Figure::take(const Attitude& attitude) const {
  const auto& parts = frames_.parts();
  std::vector<Quatd> turns(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!parts[p].carrier) {
      const Quatd yaw(Eigen::AngleAxisd(radians(attitude.pelvis.axial), Vec3d::UnitY()));
      turns[p] =
          yaw * human::turn(Role::pelvis, Side::middle, {attitude.pelvis.flexion, attitude.pelvis.abduction, 0.0});
    } else {
      turns[p] = turns[*parts[p].carrier] * human::turn(parts[p].role, parts[p].side, anglesOf(parts[p], attitude));
    }
  }
  Stance stance;
  stance.carry.resize(skeleton_.size(), Quatd::Identity());
  stance.positions.resize(skeleton_.size(), Vec3d::Zero());
  for (std::size_t j = 0; j < skeleton_.size(); ++j) {
    const auto parent = skeleton_.joints()[j].parent;
    if (partOf_[j]) {
      stance.carry[j] = (turns[*partOf_[j]] * parts[*partOf_[j]].restTurn.conjugate()).normalized();
    } else if (parent) {
      stance.carry[j] = stance.carry[parent->value];
    }
  }
  locate(stance);
  const JointIndex pelvis = *roles_.joint(Role::pelvis);
  const Vec3d hips =
      stance.positions[pelvis.value] + stance.carry[pelvis.value] * (restHips() - frames_.restPosition(pelvis));
  moveAll(stance, attitude.place - hips);
  return stance;
}

void Figure::locate(Stance& stance) const {
  for (std::size_t j = 0; j < skeleton_.size(); ++j) {
    const auto parent = skeleton_.joints()[j].parent;
    const Vec3d& rest = frames_.restPosition(JointIndex{j});
    stance.positions[j] = parent ? Vec3d(stance.positions[parent->value] +
                                         stance.carry[parent->value] * (rest - frames_.restPosition(*parent)))
                                 : rest;
  }
}

void Figure::moveAll(Stance& stance, const Vec3d& shift) const {
  for (Vec3d& position : stance.positions) {
    position += shift;
  }
}

Quatd Figure::partTurn(const Stance& stance, Role role, Side side) const {
  const Part& part = frames_.parts()[*frames_.part(role, side)];
  return stance.carry[part.joint.value] * part.restTurn;
}

Quatd Figure::chestTurn(const Stance& stance) const {
  const Part& shoulder = frames_.parts()[*frames_.part(Role::shoulder, Side::left)];
  return stance.carry[frames_.parts()[*shoulder.carrier].joint.value];
}

Vec3d Figure::eye(const Stance& stance, Side side) const {
  // From the skull's joint in the joint table.
  const Vec3d offset = stature_ * Vec3d(side == Side::left ? 0.0182 : -0.0182, 0.0260, 0.0480);
  if (const auto head = roles_.joint(Role::head)) {
    return stance.positions[head->value] + stance.carry[head->value] * offset;
  }
  const Vec3d shoulders =
      0.5 * (position(stance, Role::shoulder, Side::left) + position(stance, Role::shoulder, Side::right));
  return shoulders + chestTurn(stance) * (offset + stature_ * Vec3d(0.0, 0.1087, 0.0127));
}

void Figure::turnBelow(Stance& stance, JointIndex joint, const Quatd& turn) const {
  const Vec3d centre = stance.positions[joint.value];
  for (const std::size_t j : below_[joint.value]) {
    stance.carry[j] = (turn * stance.carry[j]).normalized();
    stance.positions[j] = centre + turn * (stance.positions[j] - centre);
  }
}

void Figure::reach(Stance& stance, Role upper, Role middle, Role lower, Side side, const Vec3d& target) const {
  const auto at = [&](Role role) -> const Vec3d& { return position(stance, role, side); };
  if ((target - at(lower)).norm() < kStill) {
    return;
  }
  const double a = (at(middle) - at(upper)).norm();
  const double b = (at(lower) - at(middle)).norm();
  // A limb is never pulled quite straight: there its bend would be infinitely sensitive.
  const double longest = (a + b) * std::cos(radians(0.5));
  const double wanted = std::min((target - at(upper)).norm(), std::max(longest, (at(lower) - at(upper)).norm()));
  // Turning the lower bone q by t about the joint's axis, |p + R(t) q| has the wanted length where
  // k1 cos t + k2 sin t is what the law of cosines asks for.
  const Vec3d p = at(middle) - at(upper);
  const Vec3d q = at(lower) - at(middle);
  const Vec3d axis = partTurn(stance, middle, side) * Vec3d::UnitX();
  const Vec3d along = axis.dot(q) * axis;
  const double k1 = p.dot(q - along);
  const double k2 = p.dot(axis.cross(q));
  const double wantedCosine = 0.5 * (wanted * wanted - a * a - b * b) - p.dot(along);
  const double straight = std::atan2(k2, k1);
  const double flexes = middle == Role::knee ? 1.0 : -1.0;
  const double bend = std::acos(std::clamp(wantedCosine / std::hypot(k1, k2), -1.0, 1.0));
  turnBelow(stance, joint(middle, side), Quatd(Eigen::AngleAxisd(straight + flexes * bend, axis)));
  turnBelow(stance, joint(upper, side), Quatd::FromTwoVectors(at(lower) - at(upper), target - at(upper)));
}

void Figure::swivel(Stance& stance, Side side, double angle) const {
  const Vec3d axis = (position(stance, Role::wrist, side) - position(stance, Role::shoulder, side)).normalized();
  turnBelow(stance, joint(Role::shoulder, side), Quatd(Eigen::AngleAxisd(angle, axis)));
}

void Figure::turnHand(Stance& stance, Side side, const JointAngles& angles, double weight) const {
  const auto lay = [&](Role role, const Quatd& turn) {
    turnBelow(stance, joint(role, side), turn * partTurn(stance, role, side).conjugate());
  };
  const Quatd forearm = partTurn(stance, Role::elbow, side);
  const Quatd hand = partTurn(stance, Role::wrist, side);
  JointAngles now = human::angles(Role::wrist, side, forearm.conjugate() * hand);
  now = now * (1.0 - weight) + angles * weight;
  const bool twists = roles_.joint(Role::forearmTwist, side).has_value();
  const double pronation = twists ? now.axial : 0.5 * now.axial;
  const Quatd pronated = forearm * human::turn(Role::elbow, side, {0.0, 0.0, pronation});
  lay(twists ? Role::forearmTwist : Role::elbow, pronated);
  lay(Role::wrist, pronated * human::turn(Role::wrist, side, {now.flexion, now.abduction, now.axial - pronation}));
}

void Figure::layFoot(Stance& stance, Side side, const Quatd& turn) const {
  const JointIndex ankle = joint(Role::ankle, side);
  turnBelow(stance, ankle, turn * stance.carry[ankle.value].conjugate());
}

human::Pose Figure::pose(const Stance& stance) const {
  human::Pose pose = human::restPose(skeleton_);
  const Quatd& facing = frames_.facing();
  const auto rotation = [&](JointIndex joint) {
    return Quatd(facing * stance.carry[joint.value] * facing.conjugate() *
                 Quatd(skeleton_.restFrame(joint).rotation()));
  };
  for (const Part& part : frames_.parts()) {
    const auto parent = skeleton_.joint(part.joint).parent;
    const Quatd above = parent ? rotation(*parent) : Quatd::Identity();
    const Quatd turned = (above.conjugate() * rotation(part.joint)).normalized();
    human::Trs& local = pose.local[part.joint.value];
    if (turned.angularDistance(local.rotation) > kStill) {
      local.rotation = turned.dot(local.rotation) < 0.0 ? Quatd(-turned.coeffs()) : turned;
    }
  }
  const JointIndex pelvis = *roles_.joint(Role::pelvis);
  const auto parent = skeleton_.joint(pelvis).parent;
  const Vec3d place = facing * stance.positions[pelvis.value];
  human::Trs& local = pose.local[pelvis.value];
  const Vec3d inParent = parent ? Vec3d(skeleton_.restFrame(*parent).inverse() * place) : place;
  if ((place - skeleton_.restPosition(pelvis)).norm() > kStill) {
    local.translation = inParent;
  }
  return pose;
}

}  // namespace lorica::manikin
