#pragma once

/// \file
/// Tests that compare two armor systems, poses or models. Runs on the same shots are paired (mcNemar, pairedT),
/// independent runs are not (welch); p-values of many structures go through holm together. All p-values are two-sided.
/// Pure functions, thread-safe.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lorica::stats {

struct TTest {
  double statistic = 0.0;  ///< positive when the first sample is larger
  double degreesOfFreedom = 0.0;
  double pValue = 1.0;
};

/// Means of two independent samples with unequal variances (B. L. Welch, 1947).
/// \return nothing when neither sample varies: then there is no spread to measure the difference by
/// \pre both samples have at least two values, all finite
std::optional<TTest> welch(std::span<const double> first, std::span<const double> second);

/// Mean of the differences of values taken in pairs, as trials on the same shots are.
/// \return nothing when all differences are equal
/// \pre both samples have the same size, at least two, all finite
std::optional<TTest> pairedT(std::span<const double> first, std::span<const double> second);

struct McNemar {
  double exactP = 1.0;      ///< from the binomial distribution
  double chiSquare = 0.0;   ///< with continuity correction, one degree of freedom
  double chiSquareP = 1.0;  ///< good from about 25 discordant shots on
};

/// Shots on which two systems disagree (Q. McNemar, 1947).
/// \param onlyFirst shots that hit with the first system and not with the second
/// \param onlySecond the reverse
McNemar mcNemar(std::uint64_t onlyFirst, std::uint64_t onlySecond);

/// p-values adjusted for making several tests at once (S. Holm, 1979), in the order given.
/// \pre all in [0, 1]
std::vector<double> holm(std::span<const double> pValues);

}  // namespace lorica::stats
