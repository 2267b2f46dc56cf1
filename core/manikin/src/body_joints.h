#pragma once

/// \file
/// Where a person's joints are at rest.

#include <array>
#include <cstdint>

#include "anthropometry.h"
#include "lorica/geometry/vectors.h"
#include "lorica/human/skeleton.h"

namespace lorica::manikin {

using geometry::Vec3d;

/// The joints in the order of the skeleton: those of the middle, those of the left, then those of the right in the
/// same order.
enum BodyJoint : std::uint32_t {
  jPelvis,
  jL5S1,
  jL3L4,
  jL1L2,
  jT10T11,
  jT6T7,
  jT2T3,
  jC7T1,
  jC3C4,
  jHead,
  jJaw,
  jEye,
  jSternoclavicular,
  jAcromioclavicular,
  jGlenohumeral,
  jElbow,
  jRadioulnar,
  jWrist,
  jThumb1,
  jThumb2,
  jIndex1,
  jIndex2,
  jMiddle1,
  jMiddle2,
  jRing1,
  jRing2,
  jLittle1,
  jLittle2,
  jHip,
  jKnee,
  jAnkle,
  jSubtalar,
  jToe,
};
inline constexpr std::uint32_t kLeftAndMiddle = jToe + 1;
inline constexpr std::uint32_t kSided = kLeftAndMiddle - jEye;
inline constexpr std::uint32_t kAllJoints = kLeftAndMiddle + kSided;

/// The right-hand counterpart of a left joint.
inline constexpr std::uint32_t rightOf(std::uint32_t left) {
  return left + kSided;
}

/// A finger from its knuckle to its tip.
struct Finger {
  Vec3d knuckle;  ///< metacarpophalangeal joint; of the thumb the carpometacarpal one
  Vec3d second;   ///< proximal interphalangeal joint; of the thumb the metacarpophalangeal one
  Vec3d third;    ///< distal joint
  Vec3d tip;      ///< end of the bone
  double radius;  ///< at the second joint
};

/// Left and middle places at rest, metres; soles at y = 0, the hip axis at z = 0. Heights and depths are shares of
/// stature (resources/tables/joints.csv), the arms hang 30 degrees from the trunk, or as far as it takes to keep stout
/// ones clear of a stout trunk below the armpit; the feet stand apart so that the thighs do not touch.
struct BodyJoints {
  std::array<Vec3d, kLeftAndMiddle> at;
  std::array<Finger, 5> fingers;  ///< thumb first
  Vec3d armDirection;             ///< from shoulder to wrist
  Vec3d palmDirection;            ///< out of the palm
  Vec3d footDirection;            ///< level, towards the toes, turned out a little
};

BodyJoints bodyJoints(const Anthropometry& sizes);

/// \pre places are of the same person as the skin the skeleton is for
human::Skeleton bodySkeleton(const BodyJoints& places);

}  // namespace lorica::manikin
