#pragma once

/// \file
/// The same body on other rigs: other rest poses, other local frames, other sizes, another way to face; and what a test
/// measures on a clip.

#include <random>

#include "lorica/human/anatomical_frames.h"
#include "lorica/human/clip.h"
#include "lorica/manikin/task_clips.h"

namespace lorica::test {

using geometry::Quatd;
using geometry::Vec3d;

/// The pose becomes the rest.
inline human::Skeleton restingIn(const human::Skeleton& skeleton, const human::Pose& pose) {
  std::vector<human::Joint> joints = skeleton.joints();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints[j].rest = pose.local[j];
  }
  return human::Skeleton(joints);
}

/// Every joint where it was, its local frame turned at random.
inline human::Skeleton withRandomFrames(const human::Skeleton& skeleton, unsigned seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5; };
  std::vector<human::Joint> joints = skeleton.joints();
  std::vector<Quatd> frames;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    frames.push_back(Quatd(unit(), unit(), unit(), unit()).normalized());
    const Vec3d place = skeleton.restPosition(human::JointIndex{j});
    const auto parent = joints[j].parent;
    const Quatd above = parent ? frames[parent->value] : Quatd::Identity();
    const Vec3d origin = parent ? skeleton.restPosition(*parent) : Vec3d::Zero();
    joints[j].rest = {above.conjugate() * (place - origin), above.conjugate() * frames[j], Vec3d::Ones()};
  }
  return human::Skeleton(joints);
}

/// Hung below a root that turns and moves it.
inline human::Skeleton hungBelow(const human::Skeleton& skeleton, const Quatd& turn, const Vec3d& shift) {
  std::vector<human::Joint> joints{{"Armature", std::nullopt, {shift, turn, Vec3d::Ones()}}};
  for (human::Joint joint : skeleton.joints()) {
    joint.parent = human::JointIndex{joint.parent ? joint.parent->value + std::size_t{1} : std::size_t{0}};
    joints.push_back(joint);
  }
  return human::Skeleton(joints);
}

inline human::Skeleton scaled(const human::Skeleton& skeleton, double factor) {
  std::vector<human::Joint> joints = skeleton.joints();
  for (human::Joint& joint : joints) {
    joint.rest.translation *= factor;
  }
  return human::Skeleton(joints);
}

/// A rig and its task motions.
class Actor {
 public:
  Actor(human::Skeleton skeleton, human::RoleMap roles, const manikin::TaskOptions& options = {})
      : skeleton_(std::move(skeleton)),
        roles_(std::move(roles)),
        frames_(skeleton_, roles_),
        clips_(manikin::taskClips(skeleton_, roles_, options)) {}
  explicit Actor(const human::Skeleton& skeleton) : Actor(skeleton, human::findRoles(skeleton)) {}

  const human::Skeleton& skeleton() const { return skeleton_; }
  const human::RoleMap& roles() const { return roles_; }
  const human::AnatomicalFrames& frames() const { return frames_; }
  const std::vector<human::Clip>& clips() const { return clips_; }

  const human::Clip& clip(const std::string& name) const {
    for (const human::Clip& clip : clips_) {
      if (clip.name == name) {
        return clip;
      }
    }
    throw std::out_of_range(name);
  }
  /// \param u share of the clip's duration
  human::Pose pose(const std::string& name, double u) const {
    return human::sample(clip(name), skeleton_, u * clip(name).duration());
  }
  std::vector<Vec3d> positions(const human::Pose& pose) const {
    const auto carry = human::carryTransforms(skeleton_, pose);
    std::vector<Vec3d> all;
    for (std::size_t j = 0; j < skeleton_.size(); ++j) {
      all.emplace_back(carry[j] * skeleton_.restPosition(human::JointIndex{j}));
    }
    return all;
  }
  Vec3d at(const std::string& name, double u, human::Role role, human::Side side = human::Side::middle) const {
    return positions(pose(name, u)).at(roles_.joint(role, side).value().value);
  }
  Vec3d atRest(human::Role role, human::Side side = human::Side::middle) const {
    return skeleton_.restPosition(roles_.joint(role, side).value());
  }
  human::JointAngles angles(const std::string& name, double u, human::Role role,
                            human::Side side = human::Side::middle) const {
    return frames_.measure(skeleton_, pose(name, u)).at(frames_.part(role, side).value());
  }
  /// Sum of flexion, abduction and turn over all joints of a role.
  human::JointAngles sum(const std::string& name, double u, human::Role role) const {
    const auto measured = frames_.measure(skeleton_, pose(name, u));
    human::JointAngles total;
    for (std::size_t p = 0; p < measured.size(); ++p) {
      total = frames_.parts()[p].role == role ? total + measured[p] : total;
    }
    return total;
  }
  /// The fingertips' place: along the forearm-to-hand line, 0.110 of stature beyond the wrist.
  Vec3d fingertip(const std::string& name, double u, human::Side side, double stature) const {
    const Vec3d elbow = at(name, u, human::Role::elbow, side);
    const Vec3d wrist = at(name, u, human::Role::wrist, side);
    return wrist + 0.110 * stature * (wrist - elbow).normalized();
  }
  double stature() const {
    double legs = 0.0;
    for (const human::Side side : {human::Side::left, human::Side::right}) {
      legs += 0.5 * ((atRest(human::Role::hip, side) - atRest(human::Role::knee, side)).norm() +
                     (atRest(human::Role::knee, side) - atRest(human::Role::ankle, side)).norm());
    }
    return legs / 0.4715;
  }
  double floor() const {
    return 0.5 * (atRest(human::Role::ankle, human::Side::left).y() +
                  atRest(human::Role::ankle, human::Side::right).y()) -
           0.0415 * stature();
  }

 private:
  human::Skeleton skeleton_;
  human::RoleMap roles_;
  human::AnatomicalFrames frames_;
  std::vector<human::Clip> clips_;
};

}  // namespace lorica::test
