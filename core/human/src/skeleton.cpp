#include "lorica/human/skeleton.h"

#include <algorithm>

#include "lorica/base/error.h"
#include "lorica/base/units.h"

namespace lorica::human {

using geometry::Affine3d;
using geometry::Quatd;
using geometry::Vec3d;

Affine3d Trs::matrix() const {
  Affine3d frame = Affine3d::Identity();
  frame.linear() = rotation.toRotationMatrix() * scale.asDiagonal();
  frame.translation() = translation;
  return frame;
}

bool Trs::operator==(const Trs& other) const {
  return translation == other.translation && rotation.coeffs() == other.rotation.coeffs() && scale == other.scale;
}

namespace {

std::vector<Affine3d> frames(const std::vector<Joint>& joints, const std::vector<Trs>& local) {
  std::vector<Affine3d> result(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto parent = joints[j].parent;
    result[j] = parent ? result[parent->value] * local[j].matrix() : local[j].matrix();
  }
  return result;
}

}  // namespace

Skeleton::Skeleton(std::vector<Joint> joints) : joints_(std::move(joints)) {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    LORICA_CHECK(!joints_[j].parent || joints_[j].parent->value < j, "a parent stands before its child");
  }
  restFrames_ = frames(joints_, restPose(*this).local);
}

std::optional<JointIndex> Skeleton::find(std::string_view name) const {
  const auto found = std::find_if(joints_.begin(), joints_.end(), [&](const Joint& j) { return j.name == name; });
  if (found == joints_.end()) {
    return std::nullopt;
  }
  return JointIndex{static_cast<std::size_t>(found - joints_.begin())};
}

Pose restPose(const Skeleton& skeleton) {
  Pose pose;
  pose.local.reserve(skeleton.size());
  for (const Joint& joint : skeleton.joints()) {
    pose.local.push_back(joint.rest);
  }
  return pose;
}

Pose turnedPose(const Skeleton& skeleton, const std::vector<JointTurn>& turns, const Vec3d& rootOffset) {
  Pose pose = restPose(skeleton);
  for (const JointTurn& turn : turns) {
    if (turn.degrees == Vec3d::Zero()) {
      continue;
    }
    const Joint& joint = skeleton.joint(turn.joint);
    const Quatd world = Eigen::AngleAxisd(base::radians(turn.degrees.z()), Vec3d::UnitZ()) *
                        Eigen::AngleAxisd(base::radians(turn.degrees.y()), Vec3d::UnitY()) *
                        Eigen::AngleAxisd(base::radians(turn.degrees.x()), Vec3d::UnitX());
    const Quatd parent = joint.parent ? Quatd(skeleton.restFrame(*joint.parent).rotation()) : Quatd::Identity();
    pose.local[turn.joint.value].rotation = (parent.conjugate() * world * parent * joint.rest.rotation).normalized();
  }
  if (rootOffset != Vec3d::Zero()) {
    for (std::size_t j = 0; j < skeleton.size(); ++j) {
      if (!skeleton.joints()[j].parent) {
        pose.local[j].translation += rootOffset;
      }
    }
  }
  return pose;
}

std::vector<Affine3d> carryTransforms(const Skeleton& skeleton, const Pose& pose) {
  LORICA_CHECK(pose.local.size() == skeleton.size(), "one local transform per joint");
  const std::vector<Affine3d> posed = frames(skeleton.joints(), pose.local);
  std::vector<Affine3d> carry(skeleton.size());
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const Joint& joint = skeleton.joints()[j];
    if (pose.local[j] == joint.rest) {
      // Exactly what its parent does, so that joints at rest give the exact identity.
      carry[j] = joint.parent ? carry[joint.parent->value] : Affine3d::Identity();
    } else {
      carry[j] = posed[j] * skeleton.restFrame(JointIndex{j}).inverse();
    }
  }
  return carry;
}

}  // namespace lorica::human
