#include "lorica/stats/intervals.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>
#include <numbers>
#include <vector>

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

TEST(StudentQuantile, GivesTheTabulatedPoints) {
  EXPECT_NEAR(studentQuantile(0.975, 1), 12.7062047364, 1e-9);
  EXPECT_NEAR(studentQuantile(0.975, 4), 2.7764451052, 1e-9);
  EXPECT_NEAR(studentQuantile(0.95, 29), 1.6991270265, 1e-9);
}

TEST(RatioInterval, IsTheStudentIntervalOfTheMeanWhenBasesAreEqual) {
  // Shares 0.10, 0.14, 0.12, 0.16: mean 0.13, standard deviation 0.0258198889747.
  const std::vector<TrialCount> trials{{10, 100}, {14, 100}, {12, 100}, {16, 100}};
  const auto interval = ratioInterval(trials);
  ASSERT_TRUE(interval.has_value());
  const double reach = studentQuantile(0.975, 3) * 0.0258198889747 / 2;
  EXPECT_NEAR(interval->low, 0.13 - reach, 1e-12);
  EXPECT_NEAR(interval->high, 0.13 + reach, 1e-12);
}

TEST(RatioInterval, IsSilentWithoutSpreadToMeasureBy) {
  EXPECT_FALSE(ratioInterval({}).has_value());
  EXPECT_FALSE(ratioInterval(std::vector<TrialCount>{{5, 10}}).has_value()) << "one trial";
  EXPECT_FALSE(ratioInterval(std::vector<TrialCount>{{0, 0}, {0, 0}}).has_value()) << "nothing was hit";
  EXPECT_FALSE(ratioInterval(std::vector<TrialCount>{{7, 7}, {9, 9}}).has_value()) << "all was hit, in every trial";
  EXPECT_FALSE(ratioInterval(std::vector<TrialCount>{{1, 3}, {2, 6}}).has_value()) << "every trial says the same";
  EXPECT_TRUE(ratioInterval(std::vector<TrialCount>{{1, 3}, {3, 6}}).has_value());
}

/// How often 2,000 intervals hold the truth. \param interval of a repeat's number
template <class Make>
double shareThatHolds(double truth, const Make& interval) {
  constexpr std::uint32_t repeats = 2000;
  int holds = 0;
  for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
    const std::optional<Interval> made = interval(repeat);
    holds += made && made->low <= truth && truth <= made->high ? 1 : 0;
  }
  return holds / static_cast<double>(repeats);
}

// Of 2,000 repeats at 95 % the standard deviation of the share that holds is 0.5 %; the bounds are four of those, and
// for Wilson one more for its steps at small counts.

TEST(Wilson, HoldsTheTruthAsOftenAsItSays) {
  for (const double truth : {0.03, 0.3, 0.9}) {
    const double share = shareThatHolds(truth, [&](std::uint32_t repeat) {
      std::uint64_t hits = 0;
      for (std::uint64_t shot = 0; shot < 500; ++shot) {
        hits += uniform2({1, 5, repeat}, shot)[0] < truth ? 1 : 0;
      }
      return std::optional(wilson(hits, 500));
    });
    EXPECT_NEAR(share, 0.95, 0.025) << truth;
  }
}

TEST(RatioInterval, HoldsTheTruthAsOftenAsItSays) {
  // Shots of a trial that stand in clusters of 20 which share their luck: Wilson would be far too sure of itself.
  const double truth = 0.3;
  const auto trialsOf = [&](std::uint64_t seed, std::uint32_t repeat, std::uint64_t trials) {
    std::vector<TrialCount> counts(trials);
    for (std::uint64_t t = 0; t < trials; ++t) {
      for (std::uint64_t cluster = 0; cluster < 40; ++cluster) {
        const auto [luck, size] = uniform2({seed, 6, repeat}, t * 40 + cluster);
        const std::uint64_t shots = 15 + static_cast<std::uint64_t>(11 * size);
        counts[t].base += shots;
        counts[t].hits += luck < truth ? shots : 0;
      }
    }
    return counts;
  };
  for (const std::uint64_t trials : {5, 20}) {
    // Ten seeds, so that none is chosen for its luck: the standard deviation of the mean is 0.15 %.
    double held = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      held += 0.1 * shareThatHolds(truth, [&](std::uint32_t r) { return ratioInterval(trialsOf(seed, r, trials)); });
    }
    EXPECT_NEAR(held, 0.95, 0.0065) << trials << " trials";
  }
  const double wilsonHeld = shareThatHolds(truth, [&](std::uint32_t r) {
    TrialCount sum;
    for (const TrialCount& trial : trialsOf(1, r, 20)) {
      sum.hits += trial.hits;
      sum.base += trial.base;
    }
    return std::optional(wilson(sum.hits, sum.base));
  });
  EXPECT_LT(wilsonHeld, 0.6) << "why it is for independent shots only";
}

}  // namespace
}  // namespace lorica::stats
