#pragma once

/// \file
/// Anatomical angles of joints. Zero is the anatomical position with palms at the thighs: trunk upright, arms hanging,
/// legs straight, feet forward.

#include "lorica/human/joint_roles.h"

namespace lorica::human {

/// Degrees. Of limbs: flexion as physicians count it (dorsiflexion of the ankle, palm side of wrist and fingers),
/// abduction away from the body's middle (radial deviation of the wrist), axial inwards (pronation). Of the spine:
/// flexion forward, abduction to the left, axial to the left. The turn is axial first, then abduction, then flexion,
/// about axes of the part that carries the joint.
struct JointAngles {
  double flexion = 0.0;
  double abduction = 0.0;
  double axial = 0.0;

  JointAngles operator+(const JointAngles& other) const {
    return {flexion + other.flexion, abduction + other.abduction, axial + other.axial};
  }
  JointAngles operator*(double factor) const { return {flexion * factor, abduction * factor, axial * factor}; }
  bool operator==(const JointAngles&) const = default;
};

/// The turn of the part below the joint against the part above it, in a frame with x to the left, y up, z forward.
geometry::Quatd turn(Role role, Side side, const JointAngles& angles);
/// The inverse of turn(); abduction (of the hand flexion) comes out within 90 degrees of zero.
JointAngles angles(Role role, Side side, const geometry::Quatd& turn);

}  // namespace lorica::human
