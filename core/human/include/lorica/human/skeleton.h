#pragma once

/// \file
/// The skeleton of a digital human and its poses. Rest is the bind pose of the skin.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lorica/base/index.h"
#include "lorica/geometry/vectors.h"

namespace lorica::human {

using JointIndex = base::Index<struct JointTag>;

/// Scale, then rotation, then translation (metres).
struct Trs {
  geometry::Vec3d translation = geometry::Vec3d::Zero();
  geometry::Quatd rotation = geometry::Quatd::Identity();
  geometry::Vec3d scale = geometry::Vec3d::Ones();

  geometry::Affine3d matrix() const;
  /// Equal bit for bit.
  bool operator==(const Trs& other) const;
};

struct Joint {
  std::string name;
  std::optional<JointIndex> parent;  ///< always before the joint itself
  Trs rest;                          ///< in the parent's frame, at rest
};

/// A forest of joints, parents before children. Value type; const functions are thread-safe.
class Skeleton {
 public:
  Skeleton() = default;
  /// \pre every parent stands before its child
  explicit Skeleton(std::vector<Joint> joints);

  const std::vector<Joint>& joints() const { return joints_; }
  std::size_t size() const { return joints_.size(); }
  const Joint& joint(JointIndex index) const { return joints_.at(index.value); }
  std::optional<JointIndex> find(std::string_view name) const;
  /// Frame of a joint in the scene, at rest.
  const geometry::Affine3d& restFrame(JointIndex index) const { return restFrames_.at(index.value); }
  geometry::Vec3d restPosition(JointIndex index) const { return restFrame(index).translation(); }

 private:
  std::vector<Joint> joints_;
  std::vector<geometry::Affine3d> restFrames_;
};

/// What every joint does: its transform in the parent's frame. One entry per joint of its skeleton.
struct Pose {
  std::vector<Trs> local;
};

Pose restPose(const Skeleton& skeleton);

/// A turn of one joint against its rest.
struct JointTurn {
  JointIndex joint;
  /// Degrees about the scene's x, then y, then z axis through the joint, as seen with its parents at rest.
  geometry::Vec3d degrees = geometry::Vec3d::Zero();
};

/// Turns applied to the rest pose; the roots (joints without parent) are moved by `rootOffset` metres.
Pose turnedPose(const Skeleton& skeleton, const std::vector<JointTurn>& turns, const geometry::Vec3d& rootOffset);

/// For every joint the affine map that carries what is fixed to it from rest to the pose. A joint that does not move,
/// below parents that do not move, gives the exact identity.
std::vector<geometry::Affine3d> carryTransforms(const Skeleton& skeleton, const Pose& pose);

}  // namespace lorica::human
