#pragma once

/// \file
/// Who a digital human stands for.

namespace lorica::human {

enum class Sex { male, female };

/// The median man of ANSUR II where nothing else is said.
struct Person {
  Sex sex = Sex::male;
  double stature = 1.755;  ///< m
  double mass = 84.6;      ///< kg

  bool operator==(const Person&) const = default;
};

}  // namespace lorica::human
