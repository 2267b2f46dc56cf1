#include "lorica/stats/tests.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "lorica/base/error.h"
#include "lorica/stats/accumulators.h"

namespace lorica::stats {

namespace {

Moments momentsOf(std::span<const double> values) {
  Moments moments;
  for (const double value : values) {
    LORICA_CHECK(std::isfinite(value), "samples must be finite");
    moments.add(value);
  }
  return moments;
}

TTest tTest(double statistic, double degreesOfFreedom) {
  const boost::math::students_t distribution(degreesOfFreedom);
  const double tail = boost::math::cdf(boost::math::complement(distribution, std::abs(statistic)));
  return {statistic, degreesOfFreedom, std::min(1.0, 2.0 * tail)};
}

}  // namespace

std::optional<TTest> welch(std::span<const double> first, std::span<const double> second) {
  LORICA_CHECK(first.size() >= 2 && second.size() >= 2, "each sample needs two values");
  const Moments a = momentsOf(first);
  const Moments b = momentsOf(second);
  const double errorA = a.variance() / static_cast<double>(a.count());
  const double errorB = b.variance() / static_cast<double>(b.count());
  const double error = errorA + errorB;
  if (error == 0.0) {
    return std::nullopt;
  }
  // Shares of the squared standard error; the fourth powers of Welch's formula would under- or overflow sooner.
  const double shareA = errorA / error;
  const double shareB = errorB / error;
  const double freedom = 1.0 / (shareA * shareA / static_cast<double>(a.count() - 1) +
                                shareB * shareB / static_cast<double>(b.count() - 1));
  return tTest((a.mean() - b.mean()) / std::sqrt(error), freedom);
}

std::optional<TTest> pairedT(std::span<const double> first, std::span<const double> second) {
  LORICA_CHECK(first.size() == second.size() && first.size() >= 2, "samples of one size, at least two, are needed");
  std::vector<double> differences(first.size());
  std::transform(first.begin(), first.end(), second.begin(), differences.begin(), std::minus<>());
  const Moments moments = momentsOf(differences);
  const double error = std::sqrt(moments.variance() / static_cast<double>(moments.count()));
  if (error == 0.0) {
    return std::nullopt;
  }
  return tTest(moments.mean() / error, static_cast<double>(moments.count() - 1));
}

McNemar mcNemar(std::uint64_t onlyFirst, std::uint64_t onlySecond) {
  const std::uint64_t fewer = std::min(onlyFirst, onlySecond);
  const std::uint64_t more = std::max(onlyFirst, onlySecond);
  if (more == 0) {
    return {};
  }
  const double discordant = static_cast<double>(fewer) + static_cast<double>(more);
  const boost::math::binomial fair(discordant, 0.5);
  McNemar result;
  result.exactP = std::min(1.0, 2.0 * boost::math::cdf(fair, static_cast<double>(fewer)));
  const double surplus = more > fewer ? static_cast<double>(more - fewer) - 1.0 : 0.0;
  result.chiSquare = surplus * surplus / discordant;
  result.chiSquareP = std::erfc(std::sqrt(0.5 * result.chiSquare));
  return result;
}

std::vector<double> holm(std::span<const double> pValues) {
  std::vector<std::size_t> order(pValues.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return pValues[a] < pValues[b]; });
  std::vector<double> adjusted(pValues.size());
  double largest = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double p = pValues[order[rank]];
    LORICA_CHECK(p >= 0.0 && p <= 1.0, "a p-value lies between 0 and 1");
    largest = std::max(largest, std::min(1.0, p * static_cast<double>(order.size() - rank)));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

}  // namespace lorica::stats
