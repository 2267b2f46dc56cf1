#pragma once

/// \file
/// A motion of one skeleton done by another: what a recorded person does, on the body of a study.

#include "lorica/human/clip.h"
#include "lorica/human/joint_roles.h"

namespace lorica::human {

/// A skeleton and what its joints stand for.
struct Actor {
  const Skeleton& skeleton;
  const RoleMap& roles;
};

struct Retargeted {
  Clip clip;            ///< on the doer's skeleton, with the keys of the given clip
  double turned = 0.0;  ///< degrees about the vertical, counter-clockwise from above, that make it begin facing ahead
  double travelled = 0.0;  ///< metres, farthest along the floor from where it begins; of a motion in place too
};

struct RetargetOptions {
  bool inPlace = false;  ///< the pelvis stays over where it rests, as on a treadmill
};

/// Every part of the doer lies in the room as the same part of the one shown: the same bones point the same way,
/// however either rig rests (T-pose, A-pose) and whatever its proportions. Where the two spines, necks or fingers have
/// different numbers of joints, the bend is spread over those there are. Parts without their like go with what carries
/// them. The pelvis travels as far as legs of its length would take it, from where it rests; the lowest that a foot
/// comes in the whole motion is the floor, and feet that are on it there are on it here. The motion is turned so that
/// it begins facing ahead. Both skeletons stand upright along y at rest. Cost: linear in keys and joints. Thread-safe.
/// \pre the clip has at least one key; each role map is one of its skeleton \throw base::InputError when a limb has no
/// length
Retargeted retarget(const Clip& clip, const Actor& shown, const Actor& doer, const RetargetOptions& options = {});

}  // namespace lorica::human
