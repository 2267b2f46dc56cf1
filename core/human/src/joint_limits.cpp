#include "lorica/human/joint_limits.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lorica/base/error.h"
#include "lorica/base/table.h"

namespace lorica::human {

std::span<const std::pair<std::string_view, std::string_view>> humanTables();

namespace {

constexpr std::array<std::string_view, kSpineLevels> kLevelNames{
    "spine_L5S1",   "spine_L4L5",  "spine_L3L4", "spine_L2L3", "spine_L1L2", "spine_T12L1", "spine_T11T12",
    "spine_T10T11", "spine_T9T10", "spine_T8T9", "spine_T7T8", "spine_T6T7", "spine_T5T6",  "spine_T4T5",
    "spine_T3T4",   "spine_T2T3",  "spine_T1T2", "spine_C7T1", "spine_C6C7", "spine_C5C6",  "spine_C4C5",
    "spine_C3C4",   "spine_C2C3",  "spine_C1C2", "head_C0C1"};

std::vector<JointRangeRow> readTable() {
  const base::Table table(humanTables().front().second, "joint_limits.csv");
  std::vector<JointRangeRow> rows;
  rows.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto limit = [&](std::string_view column) {
      return table.text(row, column).empty() ? std::nullopt : std::optional(table.number(row, column));
    };
    rows.push_back({table.text(row, "joint"),
                    table.number(row, "height_frac_stature"),
                    {limit("flexion_max_deg"), limit("extension_max_deg"), limit("abduction_max_deg"),
                     limit("adduction_max_deg"), limit("axial_internal_max_deg"), limit("axial_external_max_deg")}});
  }
  return rows;
}

double sumOf(std::size_t first, std::size_t end, const std::optional<double> JointRange::*limit) {
  double sum = 0.0;
  for (std::size_t level = first; level < end; ++level) {
    sum += (spineLevelRange(level).*limit).value_or(0.0);
  }
  return sum;
}

}  // namespace

const std::vector<JointRangeRow>& jointRanges() {
  static const std::vector<JointRangeRow> rows = readTable();
  return rows;
}

std::optional<JointRange> jointRange(std::string_view joint) {
  if (joint.ends_with("_L") || joint.ends_with("_R")) {
    joint.remove_suffix(2);
  }
  for (const JointRangeRow& row : jointRanges()) {
    if (row.joint == joint) {
      return row.range;
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> spineLevel(std::string_view joint) {
  const auto found = std::find(kLevelNames.begin(), kLevelNames.end(), joint);
  return found == kLevelNames.end() ? std::nullopt
                                    : std::optional(static_cast<std::size_t>(found - kLevelNames.begin()));
}

const JointRange& spineLevelRange(std::size_t level) {
  LORICA_CHECK(level < kSpineLevels, "a level of the spine");
  static const std::vector<JointRange> ranges = [] {
    std::vector<JointRange> all;
    for (const std::string_view name : kLevelNames) {
      all.push_back(jointRange(name).value());
    }
    return all;
  }();
  return ranges[level];
}

double spineLevelHeight(std::size_t level) {
  LORICA_CHECK(level < kSpineLevels, "a level of the spine");
  for (const JointRangeRow& row : jointRanges()) {
    if (row.joint == kLevelNames.at(level)) {
      return row.height;
    }
  }
  return 0.0;
}

namespace {

double heightOf(std::string_view joint) {
  for (const JointRangeRow& row : jointRanges()) {
    if (row.joint == joint) {
      return row.height;
    }
  }
  throw base::CallerError("the joint table has the joint");
}

/// The trunk's level that lies as high between hip and shoulder joints as a joint of the skeleton.
std::size_t levelByHeight(const Skeleton& skeleton, const RoleMap& roles, JointIndex joint) {
  const auto height = [&](Role role) {
    return 0.5 * (skeleton.restPosition(roles.joint(role, Side::left).value()).y() +
                  skeleton.restPosition(roles.joint(role, Side::right).value()).y());
  };
  const double hips = heightOf("hip");
  const double shoulders = heightOf("glenohumeral");
  const double share = (skeleton.restPosition(joint).y() - height(Role::hip)) /
                       std::max(height(Role::shoulder) - height(Role::hip), 1e-6);
  const double wanted = hips + share * (shoulders - hips);
  std::size_t nearest = 0;
  for (std::size_t level = 1; level < kFirstCervicalLevel; ++level) {
    if (std::abs(spineLevelHeight(level) - wanted) < std::abs(spineLevelHeight(nearest) - wanted)) {
      nearest = level;
    }
  }
  return nearest;
}

}  // namespace

std::vector<SpineSegment> spineSegments(const Skeleton& skeleton, const RoleMap& roles) {
  std::vector<SpineSegment> segments;
  for (const Role role : {Role::lumbar, Role::thoracic}) {
    for (const JointIndex joint : roles.joints(role)) {
      const auto named = spineLevel(skeleton.joint(joint).name);
      std::size_t level = named ? *named : levelByHeight(skeleton, roles, joint);
      if (!segments.empty()) {
        level = std::max(level, segments.back().firstLevel + 1);
      }
      segments.push_back({joint, level, level});
    }
  }
  const auto neck = roles.joints(Role::neck);
  for (std::size_t i = 0; i < neck.size(); ++i) {
    const std::size_t even = kFirstCervicalLevel + i * (kHeadLevel - kFirstCervicalLevel) / neck.size();
    segments.push_back({neck[i], spineLevel(skeleton.joint(neck[i]).name).value_or(even), 0});
  }
  const auto head = roles.joint(Role::head);
  if (head) {
    segments.push_back({*head, neck.empty() ? kFirstCervicalLevel : kHeadLevel, 0});
  }
  if (segments.empty()) {
    return segments;
  }
  segments.front().firstLevel = 0;
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    segments[i].lastLevel = std::max(segments[i + 1].firstLevel, segments[i].firstLevel + 1) - 1;
  }
  const bool bearsHead = head || !neck.empty();
  segments.back().lastLevel =
      std::max(bearsHead ? kSpineLevels : kFirstCervicalLevel, segments.back().firstLevel + 1) - 1;
  return segments;
}

JointAngles shareOf(const SpineSegment& segment, const JointAngles& whole, std::size_t firstLevel,
                    std::size_t endLevel) {
  const std::size_t first = std::max(segment.firstLevel, firstLevel);
  const std::size_t end = std::min(segment.lastLevel + 1, endLevel);
  if (first >= end) {
    return {};
  }
  const auto share = [&](double value, const std::optional<double> JointRange::*positive,
                         const std::optional<double> JointRange::*negative) {
    const auto limit = value < 0.0 ? negative : positive;
    return value * sumOf(first, end, limit) / sumOf(firstLevel, endLevel, limit);
  };
  return {share(whole.flexion, &JointRange::flexion, &JointRange::extension),
          share(whole.abduction, &JointRange::abduction, &JointRange::adduction),
          share(whole.axial, &JointRange::internal, &JointRange::external)};
}

}  // namespace lorica::human
