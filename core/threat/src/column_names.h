#pragma once

/// \file
/// Names of columns and arrays that carry their unit: "pressure_kPa", "pressure (kPa)", "pressure [kPa]".

#include <optional>
#include <string>
#include <string_view>

#include "lorica/base/units.h"
#include "lorica/threat/read_threat.h"

namespace lorica::threat {

struct ColumnName {
  std::string name;
  std::string unit;  ///< empty when the name has none
};

/// Only known units are taken from behind a '_'; between brackets any.
ColumnName columnName(std::string_view text);

std::string lowerCase(std::string_view text);
/// "m", "cm", "mm" or "in".
std::optional<base::LengthUnit> lengthUnit(const std::string& unit);
/// "s", "ms", "us" or with the letter mu.
std::optional<TimeUnit> timeUnit(const std::string& unit);
/// Whether the values of such a name say which fragment a point is.
bool isIdName(std::string_view name);

}  // namespace lorica::threat
