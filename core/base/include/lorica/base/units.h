#pragma once

/// \file
/// Length units of files. Inside the program a length is in metres.

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace lorica::base {

enum class LengthUnit { metre, centimetre, millimetre, inch };

/// Metres in one unit.
double metresPer(LengthUnit unit);
/// "m", "cm", "mm" or "in".
std::string name(LengthUnit unit);
/// The inverse of name().
std::optional<LengthUnit> lengthUnitNamed(std::string_view wanted);

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}
constexpr double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

}  // namespace lorica::base
