#pragma once

/// \file
/// What the joints of any skeleton stand for: the bridge between the anatomical names of the motion tables and the
/// names a rig's maker chose.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lorica/human/skeleton.h"

namespace lorica::human {

/// A joint is named for the part it turns about its upper end: `shoulder` turns the upper arm, `ankle` the foot.
enum class Role : std::uint8_t {
  pelvis,    ///< carries spine and legs
  lumbar,    ///< one or more joints of the lower back
  thoracic,  ///< one or more joints of the chest
  neck,      ///< one or more
  head,
  clavicle,  ///< shoulder girdle, one or more (sternoclavicular, acromioclavicular)
  shoulder,
  elbow,
  forearmTwist,  ///< pronation, between elbow and wrist
  wrist,
  thumb,  ///< fingers: their joints from the hand outwards
  index,
  middle,
  ring,
  little,
  hip,
  knee,
  ankle,
  toe,  ///< the joints at the ball of the foot, one or more
};
inline constexpr std::size_t kRoles = 19;

enum class Side : std::uint8_t { middle, left, right };

/// Whether there is one of it on each side.
bool isSided(Role role);
/// "pelvis", "shoulder_left", "forearm_twist_right".
std::string roleName(Role role, Side side);

/// The joints of each role. Value type.
class RoleMap {
 public:
  std::span<const JointIndex> joints(Role role, Side side = Side::middle) const { return place(role, side); }
  /// The first (uppermost) joint of a role.
  std::optional<JointIndex> joint(Role role, Side side = Side::middle) const;
  void set(Role role, Side side, std::vector<JointIndex> joints);

  bool operator==(const RoleMap&) const = default;

 private:
  const std::vector<JointIndex>& place(Role role, Side side) const {
    return joints_.at(static_cast<std::size_t>(role)).at(static_cast<std::size_t>(side));
  }
  std::array<std::array<std::vector<JointIndex>, 3>, kRoles> joints_;
};

/// One entry of a mapping: a role's name and the joints that play it.
struct RoleEntry {
  std::string role;
  std::vector<std::string> joints;
  bool operator==(const RoleEntry&) const = default;
};

/// Roles by explicit names. Necessary are pelvis, at least one of lumbar and thoracic, and on both sides shoulder,
/// elbow, wrist, hip, knee and ankle; everything else may be missing.
/// \throw base::InputError, its place the role: unknown role, unknown joint, role or joint named twice, necessary role
/// missing, a joint that does not hang below the one it has to
RoleMap rolesFromNames(const Skeleton& skeleton, std::span<const RoleEntry> entries);

/// Roles by the spellings of the field: the built-in human, glTF VRM humanoid, Mixamo, MakeHuman, Blender (Rigify,
/// Unity-like), Unreal, CMU and common BVH names; left and right are told by left, right, l, r in the name. Where a
/// name says no more than "spine", lower back and chest are told apart by height.
/// \throw base::InputError naming every necessary role for which no joint was found, or joints that hang wrongly
RoleMap findRoles(const Skeleton& skeleton);

}  // namespace lorica::human
