#pragma once

/// \file
/// A plain humanoid of 24 joints whose names a test chooses.

#include <array>
#include <string>
#include <vector>

#include "lorica/human/skeleton.h"

namespace lorica::test {

/// Names from the pelvis up, then of the left arm and leg; "{}" stands for the side.
struct RigNames {
  std::string pelvis, spine, chest, upperChest, neck, head;
  std::string clavicle, shoulder, elbow, wrist;
  std::string hip, knee, ankle, toe;
  std::string left = "left", right = "right";
};

inline std::string sided(std::string name, const std::string& side) {
  const std::size_t place = name.find("{}");
  return place == std::string::npos ? name : name.replace(place, 2, side);
}

/// A-pose, y up, facing +z; translations only.
inline human::Skeleton humanoid(const RigNames& names) {
  using geometry::Vec3d;
  std::vector<human::Joint> joints;
  const auto add = [&](const std::string& name, int parent, const Vec3d& offset) {
    human::Joint joint{name, std::nullopt, {}};
    if (parent >= 0) {
      joint.parent = human::JointIndex{static_cast<std::size_t>(parent)};
    }
    joint.rest.translation = offset;
    joints.push_back(joint);
    return static_cast<int>(joints.size()) - 1;
  };
  const int pelvis = add(names.pelvis, -1, {0.0, 0.90, 0.0});
  const int spine = add(names.spine, pelvis, {0.0, 0.11, -0.03});
  const int chest = add(names.chest, spine, {0.0, 0.20, -0.02});
  const int upperChest = add(names.upperChest, chest, {0.0, 0.18, 0.01});
  const int neck = add(names.neck, upperChest, {0.0, 0.11, 0.01});
  add(names.head, neck, {0.0, 0.10, 0.02});
  for (const double out : {1.0, -1.0}) {
    const std::string& side = out > 0.0 ? names.left : names.right;
    const int clavicle = add(sided(names.clavicle, side), upperChest, {0.03 * out, 0.05, 0.04});
    const int shoulder = add(sided(names.shoulder, side), clavicle, {0.145 * out, -0.03, -0.05});
    const int elbow = add(sided(names.elbow, side), shoulder, {0.14 * out, -0.25, 0.0});
    add(sided(names.wrist, side), elbow, {0.13 * out, -0.23, 0.02});
    const int hip = add(sided(names.hip, side), pelvis, {0.08 * out, 0.0, 0.0});
    const int knee = add(sided(names.knee, side), hip, {0.03 * out, -0.41, 0.0});
    const int ankle = add(sided(names.ankle, side), knee, {0.03 * out, -0.42, -0.01});
    add(sided(names.toe, side), ankle, {0.01 * out, -0.045, 0.135});
  }
  return human::Skeleton(joints);
}

inline RigNames builtIn() {
  return {"pelvis_root",
          "spine_L3L4",
          "spine_T10T11",
          "spine_T2T3",
          "spine_C7T1",
          "head_C0C1",
          "sternoclavicular_{}",
          "glenohumeral_{}",
          "elbow_{}",
          "wrist_{}",
          "hip_{}",
          "knee_{}",
          "ankle_{}",
          "toe_MTP_{}",
          "L",
          "R"};
}

}  // namespace lorica::test
