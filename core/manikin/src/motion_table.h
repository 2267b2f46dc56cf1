#pragma once

/// \file
/// The table of task motions (resources/tables/motions.csv) as curves in time.

#include <string_view>
#include <vector>

namespace lorica::manikin {

/// A cubic spline with continuous second derivative through keys.
class Curve {
 public:
  /// At rest at both ends; constant beyond them. \pre keys rise strictly, at least one
  static Curve clamped(std::vector<double> times, std::vector<double> values);
  /// Of period 1. \pre keys rise strictly within [0, 1), at least three
  static Curve periodic(std::vector<double> times, std::vector<double> values);

  double at(double time) const;

 private:
  std::vector<double> times_;
  std::vector<double> values_;
  std::vector<double> slopes_;
  bool periodic_ = false;
};

/// 0 before 0, 1 after 1, between them as a hand moves: least jerk (Flash and Hogan 1985).
double minimumJerk(double u);

/// A motion's row or rows for a joint and axis over the time fractions they give.
/// \pre the table has them
Curve tableCurve(std::string_view motion, std::string_view joint, std::string_view axis);
/// The same as a cycle: a last key at 1 repeats the first one and is averaged with it.
Curve tableCycle(std::string_view motion, std::string_view joint, std::string_view axis);
/// The only or first row's value.
double tableValue(std::string_view motion, std::string_view joint, std::string_view axis);
/// Sum over the joints of the largest values of an axis, for rows that list motion segments one by one.
double tableSum(std::string_view motion, const std::vector<std::string_view>& joints, std::string_view axis,
                double timeFraction);

}  // namespace lorica::manikin
