#pragma once

/// \file
/// Names that a study cannot give away, because results and poses have a meaning of their own for them.

#include <algorithm>
#include <array>
#include <string_view>

namespace lorica::study {

/// Rows of the results that no organ or armor piece may be named like.
inline constexpr auto reservedStructures = std::to_array<std::string_view>({"body", "miss", "armor", "organs"});
/// The armor system that is the body alone; always computed, never listed.
inline constexpr std::string_view unarmored = "unarmored";
/// The pose the skin is bound in; always there, never listed.
inline constexpr std::string_view restPose = "rest";

constexpr bool isReservedStructure(std::string_view name) {
  return std::find(reservedStructures.begin(), reservedStructures.end(), name) != reservedStructures.end();
}

}  // namespace lorica::study
