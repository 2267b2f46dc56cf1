#pragma once

/// \file
/// A skeleton that takes postures given in anatomical angles and reaches for the floor, for its feet's places and for a
/// rifle. All in the body's frame: x left, y up, z forward, metres.

#include <array>

#include "lorica/human/anatomical_frames.h"
#include "lorica/manikin/task_clips.h"

namespace lorica::manikin {

using geometry::Quatd;
using geometry::Vec3d;
using human::JointAngles;
using human::Role;
using human::Side;

inline constexpr std::array<Side, 2> kSides{Side::left, Side::right};
inline std::size_t placeOf(Side side) {
  return side == Side::left ? 0 : 1;
}

struct Arm {
  JointAngles clavicle;
  double blade = 0.0;  ///< upward rotation of the shoulder blade, where it has a joint of its own
  JointAngles shoulder;
  JointAngles elbow;  ///< flexion and, at rest only, the carrying angle
  JointAngles wrist;
  double pronation = 0.0;
  double fingers = 0.0;  ///< flexion of every finger joint but the thumb's

  Arm operator+(const Arm& other) const;
  Arm operator*(double factor) const;
};

struct Leg {
  JointAngles hip;
  JointAngles knee;
  JointAngles ankle;
  double toeExtension = 0.0;

  Leg operator+(const Leg& other) const;
  Leg operator*(double factor) const;
};

/// A posture. Value type, linear: attitudes can be added and scaled.
struct Attitude {
  Vec3d place = Vec3d::Zero();  ///< middle between the hip joints
  JointAngles pelvis;           ///< pitch forward, lean to the left, turn to the left (this one about the vertical)
  JointAngles lumbar;
  JointAngles thoracic;
  JointAngles neck;
  JointAngles head;
  std::array<Arm, 2> arms;  ///< left, right
  std::array<Leg, 2> legs;

  Attitude operator+(const Attitude& other) const;
  Attitude operator*(double factor) const;
};

/// Where every joint is and how it is turned against rest.
struct Stance {
  std::vector<Vec3d> positions;
  std::vector<Quatd> carry;
};

class Figure {
 public:
  Figure(const human::Skeleton& skeleton, const human::RoleMap& roles, const TaskOptions& options);

  const human::AnatomicalFrames& frames() const { return frames_; }
  double stature() const { return stature_; }
  double floor() const { return floor_; }
  /// Heights of joint centres over the floor they rest on, metres.
  double kneeHeight() const { return stature_ * options_.kneeThickness; }
  double elbowHeight() const { return stature_ * options_.elbowThickness; }
  double pelvisHeight() const { return stature_ * options_.pelvisThickness; }
  /// Height of the ankle over its sole.
  double soleHeight(Side side) const { return restPosition(Role::ankle, side).y() - floor_; }
  const Vec3d& restPosition(Role role, Side side) const { return frames_.restPosition(joint(role, side)); }
  Vec3d restHips() const;
  /// The ball of the foot from the ankle, at rest: the toe joint, or where the joint table has it.
  Vec3d ball(Side side) const;
  /// The angles it rests with.
  const Attitude& rest() const { return rest_; }

  Stance take(const Attitude& attitude) const;

  const Vec3d& position(const Stance& stance, Role role, Side side) const {
    return stance.positions[joint(role, side).value];
  }
  /// Turn of a part away from the anatomical position.
  Quatd partTurn(const Stance& stance, Role role, Side side) const;
  /// The top of the chest: what the arms hang on.
  Quatd chestTurn(const Stance& stance) const;
  Vec3d eye(const Stance& stance, Side side) const;

  /// Turns a joint and all below it about the joint.
  void turnBelow(Stance& stance, human::JointIndex joint, const Quatd& turn) const;
  /// Bends the middle joint and turns the upper one until the lower one is at a place, or as near as the limb's length
  /// lets it. The plane of the limb stays as near as can be.
  void reach(Stance& stance, Role upper, Role middle, Role lower, Side side, const Vec3d& target) const;
  /// Turns the arm about the line from shoulder to wrist by an angle in radians.
  void swivel(Stance& stance, Side side, double angle) const;
  /// Pronates the forearm (axial) and bends the wrist (flexion, abduction) by `weight` of the way to angles counted
  /// against the unpronated forearm.
  void turnHand(Stance& stance, Side side, const JointAngles& angles, double weight) const;
  /// Lays the foot as it rests, turned by `turn`.
  void layFoot(Stance& stance, Side side, const Quatd& turn) const;
  void moveAll(Stance& stance, const Vec3d& shift) const;

  human::JointIndex joint(Role role, Side side) const { return *roles_.joint(role, side); }
  const human::RoleMap& roles() const { return roles_; }
  /// The pose of the skeleton.
  human::Pose pose(const Stance& stance) const;

 private:
  JointAngles anglesOf(const human::Part& part, const Attitude& attitude) const;
  void locate(Stance& stance) const;

  const human::Skeleton& skeleton_;
  human::RoleMap roles_;
  human::AnatomicalFrames frames_;
  std::vector<std::optional<std::size_t>> partOf_;  ///< of every joint
  std::vector<std::vector<std::size_t>> below_;     ///< of every joint: it and all that hangs on it
  TaskOptions options_;
  double stature_ = 0.0;
  double floor_ = 0.0;
  Attitude rest_;
};

}  // namespace lorica::manikin
