#pragma once

/// \file
/// Confidence intervals. Pure functions, thread-safe.

#include <cstdint>
#include <optional>
#include <span>

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

/// The x below which a Student t variable lies with the given probability.
/// \pre 0 < probability < 1, degreesOfFreedom > 0
double studentQuantile(double probability, double degreesOfFreedom);

/// Hits and their base in one randomised trial.
struct TrialCount {
  std::uint64_t hits = 0;
  std::uint64_t base = 0;
};

/// Interval of the sum of hits over the sum of bases across independent randomised trials, whatever the shots of one
/// trial have to do with each other: Student's t with the standard error of the jackknife, which leaves out one trial
/// at a time (W. G. Cochran, Sampling Techniques, 1977, ch. 6.17), cut to [0, 1]. When all bases are equal it is the t
/// interval of the trials' mean.
/// \return nothing with fewer than two trials that have a base, and when no trial differs from the others: then there
/// is
///         no spread to measure by
/// \pre hits <= base in every trial, 0 < confidence < 1
std::optional<Interval> ratioInterval(std::span<const TrialCount> trials, double confidence = 0.95);

}  // namespace lorica::stats
