#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace lorica::shotline {

/// Cosine and sine of a full turn times `u`. Made of additions and multiplications alone: the maths library picks other
/// instructions on other processors and gives other last digits there, and shots must not.
inline std::array<double, 2> pointOnCircle(double u) {
  // The nearest multiple of a quarter turn, and what is left: at most an eighth of a turn to either side.
  const double quarters = std::floor(4.0 * u + 0.5);
  const double x = 2.0 * std::numbers::pi * (u - 0.25 * quarters);
  const double x2 = x * x;
  // Taylor series; the first terms left out are below 1e-16 here.
  const double s =
      x * (1.0 + x2 * (-1.0 / 6 +
                       x2 * (1.0 / 120 + x2 * (-1.0 / 5040 + x2 * (1.0 / 362880 + x2 * (-1.0 / 39916800 +
                                                                                        x2 * (1.0 / 6227020800.0)))))));
  const double c =
      1.0 + x2 * (-0.5 + x2 * (1.0 / 24 +
                               x2 * (-1.0 / 720 +
                                     x2 * (1.0 / 40320 + x2 * (-1.0 / 3628800 + x2 * (1.0 / 479001600 +
                                                                                      x2 * (-1.0 / 87178291200.0)))))));
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace lorica::shotline
