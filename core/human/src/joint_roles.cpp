#include "lorica/human/joint_roles.h"

#include <fmt/format.h>

#include <algorithm>

#include "lorica/base/error.h"
#include "role_checks.h"

namespace lorica::human {

namespace {

constexpr std::array<std::string_view, kRoles> kNames{
    "pelvis", "lumbar",        "thoracic", "neck",  "head",  "clavicle", "shoulder",
    "elbow",  "forearm_twist", "wrist",    "thumb", "index", "middle",   "ring",
    "little", "hip",           "knee",     "ankle", "toe"};

struct RoleAndSide {
  Role role;
  Side side;
};

std::optional<RoleAndSide> roleNamed(std::string_view name) {
  for (std::size_t r = 0; r < kRoles; ++r) {
    const auto role = static_cast<Role>(r);
    for (const Side side : {Side::middle, Side::left, Side::right}) {
      if (isSided(role) == (side != Side::middle) && roleName(role, side) == name) {
        return RoleAndSide{role, side};
      }
    }
  }
  return std::nullopt;
}

bool isBelow(const Skeleton& skeleton, JointIndex joint, JointIndex ancestor) {
  for (std::optional<JointIndex> j = joint; j; j = skeleton.joint(*j).parent) {
    if (*j == ancestor) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool isSided(Role role) {
  return role >= Role::clavicle;
}

std::string roleName(Role role, Side side) {
  const std::string_view name = kNames.at(static_cast<std::size_t>(role));
  return side == Side::middle ? std::string(name) : fmt::format("{}_{}", name, side == Side::left ? "left" : "right");
}

std::optional<JointIndex> RoleMap::joint(Role role, Side side) const {
  const auto& all = place(role, side);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

void RoleMap::set(Role role, Side side, std::vector<JointIndex> joints) {
  std::sort(joints.begin(), joints.end());
  joints_.at(static_cast<std::size_t>(role)).at(static_cast<std::size_t>(side)) = std::move(joints);
}

std::vector<std::string> missingRoles(const RoleMap& roles) {
  std::vector<std::string> missing;
  if (!roles.joint(Role::pelvis)) {
    missing.push_back(roleName(Role::pelvis, Side::middle));
  }
  if (!roles.joint(Role::lumbar) && !roles.joint(Role::thoracic)) {
    missing.push_back(roleName(Role::lumbar, Side::middle));
  }
  for (const Role role : {Role::shoulder, Role::elbow, Role::wrist, Role::hip, Role::knee, Role::ankle}) {
    for (const Side side : {Side::left, Side::right}) {
      if (!roles.joint(role, side)) {
        missing.push_back(roleName(role, side));
      }
    }
  }
  return missing;
}

void requireChains(const Skeleton& skeleton, const RoleMap& roles) {
  const auto require = [&](Role lower, Role upper, Side side, Side upperSide) {
    const auto above = roles.joint(upper, upperSide);
    for (const JointIndex joint : roles.joints(lower, side)) {
      if (above && (joint == *above || !isBelow(skeleton, joint, *above))) {
        throw base::InputError(
            "", roleName(lower, side),
            fmt::format("joint \"{}\" does not hang below \"{}\", the joint of {}", skeleton.joint(joint).name,
                        skeleton.joint(*above).name, roleName(upper, upperSide)));
      }
    }
  };
  for (const Role role : {Role::lumbar, Role::thoracic, Role::neck, Role::head}) {
    require(role, Role::pelvis, Side::middle, Side::middle);
  }
  for (const Side side : {Side::left, Side::right}) {
    require(Role::hip, Role::pelvis, side, Side::middle);
    require(Role::shoulder, Role::pelvis, side, Side::middle);
    require(Role::shoulder, Role::clavicle, side, side);
    require(Role::elbow, Role::shoulder, side, side);
    require(Role::forearmTwist, Role::elbow, side, side);
    require(Role::wrist, Role::elbow, side, side);
    require(Role::knee, Role::hip, side, side);
    require(Role::ankle, Role::knee, side, side);
    require(Role::toe, Role::ankle, side, side);
    for (const Role finger : {Role::thumb, Role::index, Role::middle, Role::ring, Role::little}) {
      require(finger, Role::wrist, side, side);
    }
  }
}

RoleMap rolesFromNames(const Skeleton& skeleton, std::span<const RoleEntry> entries) {
  RoleMap roles;
  std::vector<std::string> takenBy(skeleton.size());
  for (const RoleEntry& entry : entries) {
    const auto known = roleNamed(entry.role);
    if (!known) {
      throw base::InputError("", entry.role,
                             "this is no role; known are pelvis, lumbar, thoracic, neck, head and, with _left or "
                             "_right, clavicle, shoulder, elbow, forearm_twist, wrist, thumb, index, middle, ring, "
                             "little, hip, knee, ankle, toe");
    }
    if (roles.joint(known->role, known->side)) {
      throw base::InputError("", entry.role, "this role is named twice");
    }
    std::vector<JointIndex> joints;
    for (const std::string& name : entry.joints) {
      const auto joint = skeleton.find(name);
      if (!joint) {
        throw base::InputError("", entry.role, fmt::format("the skeleton has no joint \"{}\"", name));
      }
      std::string& taken = takenBy[joint->value];
      if (!taken.empty()) {
        throw base::InputError("", entry.role, fmt::format("joint \"{}\" already plays {}", name, taken));
      }
      taken = entry.role;
      joints.push_back(*joint);
    }
    roles.set(known->role, known->side, std::move(joints));
  }
  const std::vector<std::string> missing = missingRoles(roles);
  if (!missing.empty()) {
    throw base::InputError("", missing.front(), "this role is necessary, but no joint is given for it");
  }
  requireChains(skeleton, roles);
  return roles;
}

}  // namespace lorica::human
