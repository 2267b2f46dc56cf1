#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

namespace lorica::analysis {

/// A p-value as the tables have it; empty when there is none.
inline std::string probability(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : std::string();
}

}  // namespace lorica::analysis
