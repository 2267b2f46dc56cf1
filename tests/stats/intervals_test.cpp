#include "lorica/stats/intervals.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"
#include "lorica/stats/philox.h"

namespace lorica::stats {
namespace {

TEST(NormalQuantile, GivesTheTabulatedPoints) {
  EXPECT_DOUBLE_EQ(normalQuantile(0.5), 0.0);
  EXPECT_DOUBLE_EQ(normalQuantile(0.975), 1.9599639845400545);
  EXPECT_DOUBLE_EQ(normalQuantile(0.995), 2.5758293035489004);
  EXPECT_DOUBLE_EQ(normalQuantile(0.025), -1.9599639845400545);
}

RC_GTEST_PROP(NormalQuantile, IsTheInverseOfTheDistributionFunction, ()) {
  const double exponent = *rc::gen::inRange(1, 900000) / 1000.0;
  const double p = 0.5 * std::exp2(-exponent);
  const double back = 0.5 * std::erfc(-normalQuantile(p) / std::numbers::sqrt2);
  // One unit in the last place of x changes the tail by x^2 units.
  const double x = normalQuantile(p);
  RC_ASSERT(std::abs(back - p) <= 4e-16 * (8.0 + x * x) * p);
}

TEST(Wilson, EndsSolveTheScoreEquation) {
  // By definition |p - w| = z sqrt(w (1 - w) / n) at both ends w.
  const double z = 1.9599639845400545;
  for (const std::uint64_t hits : {1U, 7U, 50U, 93U, 99U}) {
    const Interval interval = wilson(hits, 100);
    const double p = static_cast<double>(hits) / 100.0;
    for (const double w : {interval.low, interval.high}) {
      EXPECT_NEAR(std::abs(p - w), z * std::sqrt(w * (1.0 - w) / 100.0), 1e-15);
    }
  }
}

TEST(Wilson, IsExactAtNoHitAndAtAllHits) {
  for (const std::uint64_t trials : {1ULL, 3ULL, 1000ULL, 1000000000000ULL}) {
    EXPECT_EQ(wilson(0, trials).low, 0.0);
    EXPECT_EQ(wilson(trials, trials).high, 1.0);
    const double n = static_cast<double>(trials);
    const double z2 = 1.9599639845400545 * 1.9599639845400545;
    EXPECT_NEAR(wilson(0, trials).high, z2 / (n + z2), 1e-15);
    EXPECT_NEAR(wilson(trials, trials).low, n / (n + z2), 1e-15);
  }
}

TEST(Wilson, KnowsNothingWithoutTrials) {
  EXPECT_EQ(wilson(0, 0), (Interval{0.0, 1.0}));
}

TEST(Wilson, RefusesWhatIsNoProportion) {
  EXPECT_THROW(wilson(2, 1), base::CallerError);
  EXPECT_THROW(wilson(1, 2, 0.0), base::CallerError);
  EXPECT_THROW(wilson(1, 2, 1.0), base::CallerError);
  EXPECT_THROW(normalQuantile(0.0), base::CallerError);
}

TEST(Wilson, CoversTheTruthAboutAsOftenAsItSays) {
  constexpr int experiments = 4000;
  constexpr std::uint64_t shots = 200;
  constexpr double truth = 0.13;
  int covered = 0;
  for (std::uint32_t trial = 0; trial < experiments; ++trial) {
    std::uint64_t hits = 0;
    for (std::uint64_t shot = 0; shot < shots; ++shot) {
      hits += uniform2({5, 6, trial}, shot)[0] < truth ? 1 : 0;
    }
    const Interval interval = wilson(hits, shots, 0.9);
    covered += interval.low <= truth && truth <= interval.high ? 1 : 0;
  }
  // Three per cent allow for the steps of the binomial distribution and six standard deviations.
  EXPECT_NEAR(covered / static_cast<double>(experiments), 0.9, 0.03);
}

RC_GTEST_PROP(Wilson, HoldsTheProportionAndMirrors, ()) {
  const auto trials = *rc::gen::inRange<std::uint64_t>(1, 1000000000000ULL);
  const auto hits = *rc::gen::inRange<std::uint64_t>(0, trials + 1);
  const Interval interval = wilson(hits, trials);
  const Interval mirrored = wilson(trials - hits, trials);
  const double p = static_cast<double>(hits) / static_cast<double>(trials);
  RC_ASSERT(0.0 <= interval.low && interval.low <= p && p <= interval.high && interval.high <= 1.0);
  RC_ASSERT(std::abs(interval.low - (1.0 - mirrored.high)) < 1e-14);
}

RC_GTEST_PROP(Wilson, WidensWithConfidence, ()) {
  const auto trials = *rc::gen::inRange<std::uint64_t>(1, 100000);
  const auto hits = *rc::gen::inRange<std::uint64_t>(0, trials + 1);
  const Interval narrow = wilson(hits, trials, 0.8);
  const Interval wide = wilson(hits, trials, 0.99);
  RC_ASSERT(wide.low <= narrow.low && narrow.high <= wide.high);
}

}  // namespace
}  // namespace lorica::stats
