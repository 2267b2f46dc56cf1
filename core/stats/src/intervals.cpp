#include "lorica/stats/intervals.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"

namespace lorica::stats {

double normalQuantile(double probability) {
  LORICA_CHECK(probability > 0.0 && probability < 1.0, "a probability strictly between 0 and 1 is needed");
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability);
}

Interval wilson(std::uint64_t hits, std::uint64_t trials, double confidence) {
  LORICA_CHECK(hits <= trials, "more hits than trials");
  LORICA_CHECK(confidence > 0.0 && confidence < 1.0, "a confidence strictly between 0 and 1 is needed");
  if (trials == 0) {
    return {0.0, 1.0};
  }
  // The ends are the roots of a x^2 - b x + p^2 = 0. The small one comes from the product of both, so that it keeps its
  // digits when hits are rare.
  const double n = static_cast<double>(trials);
  const double p = static_cast<double>(hits) / n;
  const double q = static_cast<double>(trials - hits) / n;
  const double z = std::numbers::sqrt2 * boost::math::erfc_inv(1.0 - confidence);
  const double spread = z * z / n;
  const double a = 1.0 + spread;
  const double high = (p + 0.5 * spread + std::sqrt(spread * (p * q + 0.25 * spread))) / a;
  const double low = p * p / (a * high);
  return {low, hits == trials ? 1.0 : std::min(high, 1.0)};
}

double studentQuantile(double probability, double degreesOfFreedom) {
  LORICA_CHECK(probability > 0.0 && probability < 1.0, "a probability strictly between 0 and 1 is needed");
  LORICA_CHECK(degreesOfFreedom > 0.0, "degrees of freedom are positive");
  return boost::math::quantile(boost::math::students_t(degreesOfFreedom), probability);
}

std::optional<Interval> ratioInterval(std::span<const TrialCount> trials, double confidence) {
  LORICA_CHECK(confidence > 0.0 && confidence < 1.0, "a confidence strictly between 0 and 1 is needed");
  double hits = 0.0;
  double base = 0.0;
  for (const TrialCount& trial : trials) {
    LORICA_CHECK(trial.hits <= trial.base, "more hits than shots");
    hits += static_cast<double>(trial.hits);
    base += static_cast<double>(trial.base);
  }
  if (trials.size() < 2 || base == 0.0) {
    return std::nullopt;
  }
  const double n = static_cast<double>(trials.size());
  const double ratio = hits / base;
  double squares = 0.0;
  for (const TrialCount& trial : trials) {
    const double others = base - static_cast<double>(trial.base);
    if (others == 0.0) {
      return std::nullopt;
    }
    const double without = (hits - static_cast<double>(trial.hits)) / others;
    squares += (without - ratio) * (without - ratio);
  }
  const double error = std::sqrt(squares * (n - 1.0) / n);
  // Differences that are rounding alone are none.
  if (error <= 1e-14) {
    return std::nullopt;
  }
  const double reach = studentQuantile(0.5 + 0.5 * confidence, n - 1.0) * error;
  return Interval{std::max(0.0, ratio - reach), std::min(1.0, ratio + reach)};
}

}  // namespace lorica::stats
