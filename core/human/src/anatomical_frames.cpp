#include "lorica/human/anatomical_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"

namespace lorica::human {

using geometry::Quatd;
using geometry::Vec3d;

namespace {

const Vec3d kDown(0.0, -1.0, 0.0);
constexpr double kSamePlace = 1e-6;  // m between two joints

/// The least turn that lays a part carried by `carrier` along a direction.
Quatd laidAlong(const Quatd& carrier, const Vec3d& direction) {
  return (Quatd::FromTwoVectors(carrier * kDown, direction) * carrier).normalized();
}

/// Along a direction, its front towards `forward`.
Quatd laidAlong(const Vec3d& direction, const Vec3d& forward) {
  Eigen::Matrix3d m;
  m.col(1) = -direction;
  m.col(2) = (forward - forward.dot(direction) * direction).normalized();
  m.col(0) = m.col(1).cross(m.col(2));
  return Quatd(m);
}

}  // namespace

AnatomicalFrames::AnatomicalFrames(const Skeleton& skeleton, const RoleMap& roles) {
  const Vec3d across = skeleton.restPosition(roles.joint(Role::hip, Side::left).value()) -
                       skeleton.restPosition(roles.joint(Role::hip, Side::right).value());
  const double quarter = 0.5 * std::numbers::pi;
  const double yaw = quarter * std::round(std::atan2(-across.z(), across.x()) / quarter);
  facing_ = Quatd(Eigen::AngleAxisd(yaw, Vec3d::UnitY()));
  restPositions_.reserve(skeleton.size());
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    restPositions_.emplace_back(facing_.conjugate() * skeleton.restPosition(JointIndex{j}));
  }
  spine_ = spineSegments(skeleton, roles);
  addTrunk(skeleton, roles);
  for (const Side side : {Side::left, Side::right}) {
    addArm(skeleton, roles, side);
    addLeg(skeleton, roles, side);
  }
}

std::size_t AnatomicalFrames::add(Role role, Side side, std::size_t place, JointIndex joint,
                                  std::optional<std::size_t> carrier, const Quatd& restTurn) {
  Part part{role, side, place, joint, carrier, restTurn, {}};
  if (carrier) {
    part.rest = angles(role, side, parts_[*carrier].restTurn.conjugate() * restTurn);
  }
  parts_.push_back(part);
  return parts_.size() - 1;
}

Vec3d AnatomicalFrames::direction(const Skeleton& skeleton, JointIndex from, JointIndex to) const {
  const Vec3d along = restPosition(to) - restPosition(from);
  if (along.norm() < kSamePlace) {
    throw base::InputError("", "",
                           fmt::format("joints \"{}\" and \"{}\" rest at the same place", skeleton.joint(from).name,
                                       skeleton.joint(to).name));
  }
  return along.normalized();
}

std::size_t AnatomicalFrames::carrierOf(const Skeleton& skeleton, JointIndex joint) const {
  for (std::optional<JointIndex> j = skeleton.joint(joint).parent; j; j = skeleton.joint(*j).parent) {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      // The upper arm's angles are counted against the chest, whatever the shoulder girdle does.
      if (parts_[p].joint == *j && parts_[p].role != Role::clavicle) {
        return p;
      }
    }
  }
  return 0;
}

void AnatomicalFrames::addTrunk(const Skeleton& skeleton, const RoleMap& roles) {
  add(Role::pelvis, Side::middle, 0, roles.joint(Role::pelvis).value(), std::nullopt, Quatd::Identity());
  for (const Role role : {Role::lumbar, Role::thoracic, Role::neck, Role::head}) {
    std::size_t place = 0;
    for (const JointIndex joint : roles.joints(role)) {
      add(role, Side::middle, place++, joint, carrierOf(skeleton, joint), Quatd::Identity());
    }
  }
}

void AnatomicalFrames::addArm(const Skeleton& skeleton, const RoleMap& roles, Side side) {
  const JointIndex shoulder = roles.joint(Role::shoulder, side).value();
  const JointIndex elbow = roles.joint(Role::elbow, side).value();
  const JointIndex wrist = roles.joint(Role::wrist, side).value();
  const std::size_t chest = carrierOf(skeleton, shoulder);
  std::size_t carrier = chest;
  std::size_t place = 0;
  for (const JointIndex joint : roles.joints(Role::clavicle, side)) {
    carrier = add(Role::clavicle, side, place++, joint, carrier, Quatd::Identity());
  }
  const Quatd upperArm = laidAlong(Quatd::Identity(), direction(skeleton, shoulder, elbow));
  const Quatd forearm = laidAlong(upperArm, direction(skeleton, elbow, wrist));
  Quatd hand = forearm;
  // Some rigs have the first joint of a finger in the wrist.
  const auto fingers = roles.joints(Role::middle, side);
  const auto middle = std::find_if(fingers.begin(), fingers.end(), [&](JointIndex finger) {
    return (restPosition(finger) - restPosition(wrist)).norm() > kSamePlace;
  });
  if (middle != fingers.end()) {
    const auto index = roles.joint(Role::index, side);
    const auto little =
        roles.joint(Role::little, side) ? roles.joint(Role::little, side) : roles.joint(Role::ring, side);
    const Vec3d along = direction(skeleton, wrist, *middle);
    hand = index && little ? laidAlong(along, direction(skeleton, *little, *index)) : laidAlong(forearm, along);
  }
  const double pronation = angles(Role::wrist, side, forearm.conjugate() * hand).axial;
  const auto twist = roles.joint(Role::forearmTwist, side);
  const auto pronated = [&](double degrees) { return forearm * turn(Role::elbow, side, {0.0, 0.0, degrees}); };
  carrier = add(Role::shoulder, side, 0, shoulder, chest, upperArm);
  // Without a joint of its own, half of the pronation turns the forearm and half the hand.
  carrier = add(Role::elbow, side, 0, elbow, carrier, twist ? forearm : pronated(0.5 * pronation));
  if (twist) {
    carrier = add(Role::forearmTwist, side, 0, *twist, carrier, pronated(pronation));
  }
  carrier = add(Role::wrist, side, 0, wrist, carrier, hand);
  const std::size_t palm = carrier;
  for (const Role finger : {Role::thumb, Role::index, Role::middle, Role::ring, Role::little}) {
    carrier = palm;
    place = 0;
    for (const JointIndex joint : roles.joints(finger, side)) {
      carrier = add(finger, side, place++, joint, carrier, hand);
    }
  }
}

void AnatomicalFrames::addLeg(const Skeleton& skeleton, const RoleMap& roles, Side side) {
  const JointIndex hip = roles.joint(Role::hip, side).value();
  const JointIndex knee = roles.joint(Role::knee, side).value();
  const JointIndex ankle = roles.joint(Role::ankle, side).value();
  const Quatd thigh = laidAlong(Quatd::Identity(), direction(skeleton, hip, knee));
  std::size_t carrier = add(Role::hip, side, 0, hip, 0, thigh);
  carrier = add(Role::knee, side, 0, knee, carrier, laidAlong(thigh, direction(skeleton, knee, ankle)));
  carrier = add(Role::ankle, side, 0, ankle, carrier, Quatd::Identity());
  std::size_t place = 0;
  for (const JointIndex joint : roles.joints(Role::toe, side)) {
    add(Role::toe, side, place++, joint, carrier, Quatd::Identity());
  }
}

std::optional<std::size_t> AnatomicalFrames::part(Role role, Side side) const {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (parts_[p].role == role && parts_[p].side == side) {
      return p;
    }
  }
  return std::nullopt;
}

std::vector<JointAngles> AnatomicalFrames::measure(const Skeleton& skeleton, const Pose& pose) const {
  const std::vector<geometry::Affine3d> carry = carryTransforms(skeleton, pose);
  const auto turnOf = [&](const Part& part) {
    return facing_.conjugate() * Quatd(carry.at(part.joint.value).rotation()) * facing_ * part.restTurn;
  };
  std::vector<JointAngles> measured;
  measured.reserve(parts_.size());
  for (const Part& part : parts_) {
    const Quatd carrier = part.carrier ? turnOf(parts_[*part.carrier]) : Quatd::Identity();
    measured.push_back(angles(part.role, part.side, carrier.conjugate() * turnOf(part)));
  }
  return measured;
}

namespace {

std::optional<JointRange> rangeOf(const AnatomicalFrames& frames, const Part& part) {
  for (const SpineSegment& segment : frames.spine()) {
    if (segment.joint == part.joint) {
      JointRange sum{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
      for (std::size_t level = segment.firstLevel; level <= segment.lastLevel; ++level) {
        const JointRange& range = spineLevelRange(level);
        for (const auto limit : {&JointRange::flexion, &JointRange::extension, &JointRange::abduction,
                                 &JointRange::adduction, &JointRange::internal, &JointRange::external}) {
          *(sum.*limit) += (range.*limit).value_or(0.0);
        }
      }
      return sum;
    }
  }
  switch (part.role) {
    case Role::clavicle:
      return jointRange(part.place == 0 ? "sternoclavicular" : "acromioclavicular");
    case Role::shoulder:
      return jointRange("glenohumeral");
    case Role::elbow:
      return jointRange("elbow");
    case Role::forearmTwist:
      return jointRange("radioulnar");
    case Role::wrist:
      return jointRange("wrist");
    case Role::index:
      return part.place == 0 ? jointRange("index_MCP") : std::nullopt;
    case Role::middle:
      return part.place == 0 ? jointRange("middle_MCP") : std::nullopt;
    case Role::ring:
      return part.place == 0 ? jointRange("ring_MCP") : std::nullopt;
    case Role::little:
      return part.place == 0 ? jointRange("little_MCP") : std::nullopt;
    case Role::hip:
      return jointRange("hip");
    case Role::knee:
      return jointRange("knee");
    case Role::ankle: {
      // Without a joint of its own the subtalar joint's tilt is the ankle's.
      auto range = jointRange("ankle");
      const auto subtalar = jointRange("subtalar");
      range->abduction = subtalar->abduction;
      range->adduction = subtalar->adduction;
      return range;
    }
    case Role::toe:
      return jointRange("toe_MTP");
    default:
      return std::nullopt;
  }
}

}  // namespace

std::vector<LimitExcess> limitExcesses(const AnatomicalFrames& frames, const Skeleton& skeleton, const Pose& pose,
                                       double tolerance) {
  const std::vector<JointAngles> measured = frames.measure(skeleton, pose);
  std::vector<LimitExcess> found;
  for (std::size_t p = 0; p < measured.size(); ++p) {
    const auto range = rangeOf(frames, frames.parts()[p]);
    if (!range) {
      continue;
    }
    const auto check = [&](const char* direction, double angle, const std::optional<double>& limit) {
      if (limit && angle > *limit + tolerance) {
        found.push_back({skeleton.joint(frames.parts()[p].joint).name, direction, angle, *limit});
      }
    };
    check("flexion", measured[p].flexion, range->flexion);
    check("extension", -measured[p].flexion, range->extension);
    check("abduction", measured[p].abduction, range->abduction);
    check("adduction", -measured[p].abduction, range->adduction);
    check("internal rotation", measured[p].axial, range->internal);
    check("external rotation", -measured[p].axial, range->external);
  }
  return found;
}

}  // namespace lorica::human
