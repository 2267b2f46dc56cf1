#include "lorica/human/joint_angles.h"

#include <algorithm>
#include <cmath>

#include "lorica/base/units.h"

namespace lorica::human {

using base::degrees;
using base::radians;
using geometry::Quatd;
using geometry::Vec3d;

namespace {

/// Signs that make the physicians' angles right-handed turns about x, z and y.
struct Signs {
  double flexion, abduction, axial;
};

Signs signsOf(Role role, Side side) {
  const double out = side == Side::right ? -1.0 : 1.0;
  switch (role) {
    case Role::pelvis:
    case Role::lumbar:
    case Role::thoracic:
    case Role::neck:
    case Role::head:
      return {1.0, -1.0, 1.0};
    case Role::clavicle:  // flexion lifts it, abduction draws it up as the arm rises, axial draws it forward
      return {-1.0, out, -out};
    case Role::knee:
    case Role::toe:
      return {1.0, out, -out};
    default:
      return {-1.0, out, -out};
  }
}

/// The palm faces the thigh: hands and fingers bend in the frontal plane.
bool bendsSideways(Role role) {
  return role >= Role::wrist && role <= Role::little;
}

}  // namespace

Quatd turn(Role role, Side side, const JointAngles& angles) {
  const Signs sign = signsOf(role, side);
  const Eigen::AngleAxisd axial(radians(sign.axial * angles.axial), Vec3d::UnitY());
  if (bendsSideways(role)) {
    const double out = side == Side::right ? -1.0 : 1.0;
    return axial * Eigen::AngleAxisd(radians(-out * angles.flexion), Vec3d::UnitZ()) *
           Eigen::AngleAxisd(radians(-angles.abduction), Vec3d::UnitX());
  }
  return Eigen::AngleAxisd(radians(sign.flexion * angles.flexion), Vec3d::UnitX()) *
         Eigen::AngleAxisd(radians(sign.abduction * angles.abduction), Vec3d::UnitZ()) * axial;
}

JointAngles angles(Role role, Side side, const Quatd& turn) {
  const Signs sign = signsOf(role, side);
  const Eigen::Matrix3d m = turn.normalized().toRotationMatrix();
  if (bendsSideways(role)) {
    // m = Ry(c) Rz(a) Rx(b)
    const double out = side == Side::right ? -1.0 : 1.0;
    return {-out * degrees(std::asin(std::clamp(m(1, 0), -1.0, 1.0))), -degrees(std::atan2(-m(1, 2), m(1, 1))),
            sign.axial * degrees(std::atan2(-m(2, 0), m(0, 0)))};
  }
  // m = Rx(a) Rz(b) Ry(c)
  return {sign.flexion * degrees(std::atan2(m(2, 1), m(1, 1))),
          sign.abduction * degrees(-std::asin(std::clamp(m(0, 1), -1.0, 1.0))),
          sign.axial * degrees(std::atan2(m(0, 2), m(0, 0)))};
}

}  // namespace lorica::human
