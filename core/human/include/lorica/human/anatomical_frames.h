#pragma once

/// \file
/// The anatomical position of any rig: from how its bones lie at rest follow the joint angles it rests with, so that
/// angles mean the same posture on a rig that rests in T-pose, in A-pose or with bent elbows.

#include <string>
#include <vector>

#include "lorica/human/joint_limits.h"

namespace lorica::human {

/// A joint with a role.
struct Part {
  Role role;
  Side side;
  std::size_t place = 0;  ///< among the joints of its role
  JointIndex joint;
  std::optional<std::size_t> carrier;  ///< the part its angles are counted against; the pelvis has none
  /// Turn of the part at rest away from the anatomical position, in the body's frame.
  geometry::Quatd restTurn = geometry::Quatd::Identity();
  JointAngles rest;  ///< the same as joint angles; zero for trunk and head, which count from how they rest
};

/// Value type; const functions are thread-safe. The body's frame has x to its left, y up, z forward.
class AnatomicalFrames {
 public:
  /// The body stands upright along y; which way it faces is read from its hips, to the nearest quarter turn.
  /// Hands whose index and little finger have joints know where their palm faces; others are taken to rest with the
  /// palms at the thighs once the arms hang.
  /// \throw base::InputError when a limb has no length
  AnatomicalFrames(const Skeleton& skeleton, const RoleMap& roles);

  /// Carriers before what they carry.
  const std::vector<Part>& parts() const { return parts_; }
  std::optional<std::size_t> part(Role role, Side side = Side::middle) const;
  /// From the body's frame to the scene.
  const geometry::Quatd& facing() const { return facing_; }
  /// Where a joint rests, in the body's frame.
  const geometry::Vec3d& restPosition(JointIndex joint) const { return restPositions_.at(joint.value); }
  const std::vector<SpineSegment>& spine() const { return spine_; }

  /// The angles of every part in a pose, in the order of parts(); the pelvis' are those of the body in the room.
  std::vector<JointAngles> measure(const Skeleton& skeleton, const Pose& pose) const;

 private:
  void addTrunk(const Skeleton& skeleton, const RoleMap& roles);
  void addArm(const Skeleton& skeleton, const RoleMap& roles, Side side);
  void addLeg(const Skeleton& skeleton, const RoleMap& roles, Side side);
  std::size_t add(Role role, Side side, std::size_t place, JointIndex joint, std::optional<std::size_t> carrier,
                  const geometry::Quatd& restTurn);
  geometry::Vec3d direction(const Skeleton& skeleton, JointIndex from, JointIndex to) const;
  std::size_t carrierOf(const Skeleton& skeleton, JointIndex joint) const;

  geometry::Quatd facing_ = geometry::Quatd::Identity();
  std::vector<geometry::Vec3d> restPositions_;
  std::vector<Part> parts_;
  std::vector<SpineSegment> spine_;
};

/// A joint that turns further than the table of limits allows.
struct LimitExcess {
  std::string joint;      ///< name on the skeleton
  std::string direction;  ///< "flexion", "external rotation", ...
  double angle = 0.0;     ///< degrees in that direction
  double limit = 0.0;     ///< degrees
};

/// Every joint whose limits the table gives and that is more than `tolerance` degrees beyond one. Limits of the spine
/// are those of the motion segments the joint stands for.
std::vector<LimitExcess> limitExcesses(const AnatomicalFrames& frames, const Skeleton& skeleton, const Pose& pose,
                                       double tolerance);

}  // namespace lorica::human
