#pragma once

/// \file
/// How far joints turn (resources/tables/joint_limits.csv, each row with its source), and which motion segments of the
/// spine each joint of a skeleton stands for.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lorica/human/joint_angles.h"
#include "lorica/human/joint_roles.h"

namespace lorica::human {

/// Degrees away from the anatomical position, none of them negative; empty where the table gives no limit.
struct JointRange {
  std::optional<double> flexion, extension;
  std::optional<double> abduction, adduction;  ///< spine: bend to the left, to the right
  std::optional<double> internal, external;    ///< spine: turn to the left, to the right
};

struct JointRangeRow {
  std::string joint;    ///< name of the joint table, without side
  double height = 0.0;  ///< of the joint, fraction of stature (male)
  JointRange range;
};

/// The whole table. Thread-safe; read once.
const std::vector<JointRangeRow>& jointRanges();

/// Range of a joint by the name of the joint table, with or without _L or _R.
std::optional<JointRange> jointRange(std::string_view joint);

/// Motion segments of the spine, L5/S1 = 0 upwards to skull/C1 = 24.
inline constexpr std::size_t kSpineLevels = 25;
inline constexpr std::size_t kFirstThoracicLevel = 5;   ///< T12/L1
inline constexpr std::size_t kFirstCervicalLevel = 17;  ///< C7/T1
inline constexpr std::size_t kHeadLevel = 24;           ///< C0/C1

/// Level of a joint of the built-in names ("spine_L3L4", "head_C0C1").
std::optional<std::size_t> spineLevel(std::string_view joint);
/// Height of a level's joint, fraction of stature (male).
double spineLevelHeight(std::size_t level);
/// Range of one motion segment.
const JointRange& spineLevelRange(std::size_t level);

/// A joint of the spine or head and the motion segments it stands for: from its own up to the next joint's.
struct SpineSegment {
  JointIndex joint;
  std::size_t firstLevel = 0;
  std::size_t lastLevel = 0;  ///< inclusive
};

/// Upwards. Joints with built-in names know their level; others of the trunk are told by their height between hip and
/// shoulder joints, those of the neck share its levels evenly.
/// Without neck and head the cervical levels belong to nobody.
std::vector<SpineSegment> spineSegments(const Skeleton& skeleton, const RoleMap& roles);

/// The angles of a region that a joint takes: every motion segment's part is proportional to its range in that
/// direction, so that the parts of all joints sum to the whole and all reach their limits together.
/// \param firstLevel, endLevel the region
JointAngles shareOf(const SpineSegment& segment, const JointAngles& whole, std::size_t firstLevel,
                    std::size_t endLevel);

}  // namespace lorica::human
