#include "lorica/stats/intervals.h"

#include <algorithm>
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

}  // namespace lorica::stats
