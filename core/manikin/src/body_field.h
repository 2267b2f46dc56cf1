#pragma once

/// \file
/// The shape of a person as scalar fields, negative inside, near the surface about the distance to it in metres.

#include <vector>

#include "anthropometry.h"
#include "body_joints.h"
#include "fields.h"
#include "loft.h"

namespace lorica::manikin {

/// What the tape decides: multipliers of the drawn shape, found by fitBody().
struct BodyFit {
  /// Of a section of the trunk.
  struct Belt {
    double breadth = 1.0;
    double depth = 1.0;
    double squareness = 2.4;
    double girth = 1.0;  ///< wanted, over the survey's
  };
  Belt chest;
  Belt waist;
  Belt hip;
  double head = 1.0;  ///< its girth by its squareness
  double neck = 1.0;
  double upperArm = 1.0;
  double forearm = 1.0;
  double wrist = 1.0;
  double thigh = 1.0;
  double knee = 1.0;
  double calf = 1.0;
  double ankle = 1.0;
  double flesh = 1.0;  ///< of all that no tape is laid around; found from the volume
};

/// Thread-safe.
class BodyField {
 public:
  BodyField(const Anthropometry& sizes, const BodyJoints& joints, const BodyFit& fit);

  /// Fields of the person's left half and middle; callers mirror points with x < 0.
  double trunk(const Vec3d& mirrored) const;  ///< with the neck
  double head(const Vec3d& mirrored) const;
  double arm(const Vec3d& mirrored) const;
  double leg(const Vec3d& mirrored) const;
  /// Everything but the arms: what a tape around the trunk meets.
  double withoutArms(const Vec3d& p) const;
  /// The skin.
  double whole(const Vec3d& p) const;

 private:
  /// A rounded heap (or dent, with negative height) on a surface.
  struct Heap {
    Vec3d middle;
    Vec3d reach;
    double height;
  };
  static double heaped(double field, const Vec3d& p, const std::vector<Heap>& heaps);
  double hand(const Vec3d& mirrored) const;
  double foot(const Vec3d& mirrored) const;

  BodyJoints joints_;
  bool female_ = false;
  double size_ = 1.0;  ///< stature over 1.755 m
  Loft trunk_;
  Loft neck_;
  Loft head_;
  Loft arm_;
  Loft palm_;
  Loft leg_;
  Loft foot_;
  std::vector<Heap> trunkHeaps_;
  std::vector<Heap> headHeaps_;
  std::vector<Heap> limbHeaps_;
  std::vector<std::pair<Station, Station>> shoulder_;
  Vec3d buttock_;
  Vec3d buttockAxes_;
  Vec3d breast_;
  Vec3d breastAxes_;
  Vec3d noseTop_;
  Vec3d noseTip_;
  Vec3d ear_;
  std::vector<std::pair<Station, Station>> digits_;
  std::vector<std::pair<Station, Station>> toes_;
};

}  // namespace lorica::manikin
