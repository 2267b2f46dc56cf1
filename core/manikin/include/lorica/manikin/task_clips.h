#pragma once

/// \file
/// The task motions: what the armored person does. They run on any skeleton whose joints play the roles of
/// human::RoleMap. Joint angles come from resources/tables/motions.csv, each row with its source; they are anatomical,
/// so that rigs of any rest pose and proportions reach the same posture. What stands, kneels or lies on the floor does
/// so on the floor of the given skeleton.

#include <optional>
#include <string>
#include <vector>

#include "lorica/human/clip.h"
#include "lorica/human/joint_roles.h"
#include "lorica/manikin/body.h"

namespace lorica::manikin {

/// Bones have no thickness; these are the soft parts between joints and floor. Fractions of stature are from memory,
/// unverified, unless said otherwise.
struct TaskOptions {
  /// Metres. Default: from the length of the legs (hip to ankle is 0.4715 of stature, joint table).
  std::optional<double> stature;
  /// Height of the floor, metres. Default: 0.0415 of stature below the ankles at rest (joint table).
  std::optional<double> floor;
  double kneeThickness = 0.031;    ///< centre of the knee above the floor when kneeling on it, fractions of stature
  double elbowThickness = 0.022;   ///< centre of the elbow above the floor when leaning on it
  double pelvisThickness = 0.062;  ///< hip joints above the floor when lying prone
};

/// What can be measured on a body instead of guessed: its stature, its soles and, where its joints are named as in the
/// joint table, what lies between knees, elbows, hips and the floor.
TaskOptions measuredOn(const Body& body);

/// toe_touch, belly_twist, lateral_twist, squat, kneel_aim, prone_aim, arm_raise, walk, sit, in this order; see
/// taskClipNames(). All but walk start and end at rest; kneel_aim and prone_aim aim a rifle (not modelled) along the
/// way the body faces, right-handed, and hold it in the middle. walk is one cycle on the spot: the ground runs
/// backwards under it. 30 keys a second (walk 40), linear between.
/// Thread-safe. Cost: about a tenth of a second for a rig of fifty joints. The same bytes at each call.
/// \throw base::InputError when a limb has no length
/// \pre the roles are those of the skeleton, made by findRoles() or rolesFromNames()
std::vector<human::Clip> taskClips(const human::Skeleton& skeleton, const human::RoleMap& roles,
                                   const TaskOptions& options = {});

std::vector<std::string> taskClipNames();

/// Metres a second at which the ground runs backwards under `walk` of this skeleton.
double walkingSpeed(const human::Skeleton& skeleton, const human::RoleMap& roles, const TaskOptions& options = {});

}  // namespace lorica::manikin
