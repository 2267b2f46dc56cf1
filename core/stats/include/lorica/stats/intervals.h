#pragma once

/// \file
/// Confidence intervals. Pure functions, thread-safe.

#include <cstdint>

namespace lorica::stats {

struct Interval {
  double low = 0.0;
  double high = 0.0;
  bool operator==(const Interval&) const = default;
};

/// The x below which a standard normal variable lies with the given probability.
/// \pre 0 < probability < 1
double normalQuantile(double probability);

/// Interval of a proportion from independent, equally weighted shots (E. B. Wilson, 1927, without continuity
/// correction). Within [0, 1]; low is exactly 0 without hits, high exactly 1 when all hit; [0, 1] without trials.
/// \pre hits <= trials, 0 < confidence < 1
Interval wilson(std::uint64_t hits, std::uint64_t trials, double confidence = 0.95);

}  // namespace lorica::stats
