#include "lorica/stats/tests.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "lorica/base/error.h"

namespace lorica::stats {
namespace {

using Sample = std::vector<double>;

struct ThesisRow {
  const char* name;
  Sample fixed;    // Table 2: static models, five trials, per cent
  Sample dynamic;  // Table 3
};

const std::vector<ThesisRow>& thesisRows() {
  static const std::vector<ThesisRow> rows{
      {"body", {3.85, 3.84, 3.85, 3.83, 3.82}, {3.84, 3.87, 3.82, 3.84, 3.87}},
      {"armor", {11.03, 11.05, 10.73, 10.99, 10.5}, {11.12, 10.42, 10.61, 10.57, 11.1}},
      {"organs", {10.57, 11.01, 10.92, 10.86, 11.27}, {10.87, 10.93, 10.98, 11.44, 10.55}},
      {"lungs", {6.86, 7.39, 7.14, 7.02, 7.2}, {5.83, 5.98, 6.07, 6.3, 5.67}},
      {"liver", {1.44, 1.17, 1.39, 1.45, 1.41}, {1.98, 1.62, 1.94, 2.06, 1.92}},
      {"large intestine", {1.35, 1.37, 1.36, 1.37, 1.58}, {1.69, 1.65, 1.72, 1.66, 1.63}},
      {"kidneys", {0.06, 0.02, 0.06, 0.04, 0.07}, {0.29, 0.19, 0.2, 0.18, 0.24}},
      {"trachea", {0.34, 0.29, 0.29, 0.37, 0.39}, {0.44, 0.45, 0.49, 0.61, 0.48}},
      {"stomach", {0.47, 0.63, 0.56, 0.51, 0.52}, {0.35, 0.36, 0.3, 0.34, 0.37}},
      {"small intestine", {0.06, 0.15, 0.12, 0.1, 0.1}, {0.29, 0.34, 0.26, 0.29, 0.24}},
  };
  return rows;
}

const ThesisRow& thesisRow(const std::string& name) {
  return *std::find_if(thesisRows().begin(), thesisRows().end(),
                       [&](const ThesisRow& row) { return row.name == name; });
}

TEST(Welch, GivesTheStatisticsOfTheThesisTables2And3) {
  const std::vector<std::pair<std::string, double>> expected{
      {"lungs", -8.29},   {"small intestine", 7.94}, {"kidneys", 7.68}, {"liver", 5.85},
      {"stomach", -6.54}, {"large intestine", 5.69}, {"trachea", 4.31}};
  for (const auto& [name, statistic] : expected) {
    const ThesisRow& row = thesisRow(name);
    EXPECT_NEAR(welch(row.dynamic, row.fixed)->statistic, statistic, 0.005) << name;
  }
}

TEST(Welch, TellsSevenOrgansOfTheThesisApartAndNotBodyArmorOrOrgansAfterHolm) {
  Sample pValues;
  for (const ThesisRow& row : thesisRows()) {
    pValues.push_back(welch(row.dynamic, row.fixed)->pValue);
  }
  const Sample adjusted = holm(pValues);
  for (std::size_t i = 0; i < adjusted.size(); ++i) {
    EXPECT_EQ(adjusted[i] < 0.05, i >= 3) << thesisRows()[i].name << ' ' << adjusted[i];
  }
}

TEST(Welch, SaysNothingWhenNeitherSampleVaries) {
  EXPECT_FALSE(welch(Sample{0, 0, 0, 0, 0}, Sample{0, 0, 0, 0, 0}).has_value());
  EXPECT_FALSE(welch(Sample{1, 1}, Sample{2, 2}).has_value());
  EXPECT_TRUE(welch(Sample{1, 1}, Sample{2, 3}).has_value());
}

TEST(Welch, HasPooledFreedomForEqualSpreadsAndThatOfTheOneSampleThatVaries) {
  EXPECT_DOUBLE_EQ(welch(Sample{1, 2, 3, 4}, Sample{7, 8, 9, 10})->degreesOfFreedom, 6.0);
  EXPECT_DOUBLE_EQ(welch(Sample{1, 2, 3, 4}, Sample{7, 7, 7})->degreesOfFreedom, 3.0);
}

TEST(Welch, FindsTheClosedFormTailOfTwoDegreesOfFreedom) {
  // Two and two values of equal spread: 2 degrees of freedom, p = 1 - t / sqrt(2 + t^2).
  for (const double shift : {0.0, 0.3, 2.0, 50.0}) {
    const TTest test = *welch(Sample{shift, shift + 1.0}, Sample{0.0, 1.0});
    const double t = shift / std::sqrt(0.5);
    EXPECT_NEAR(test.statistic, t, 1e-12 * (1.0 + t));
    EXPECT_NEAR(test.pValue, 1.0 - t / std::sqrt(2.0 + t * t), 1e-12);
  }
}

TEST(PairedT, FindsTheClosedFormTailOfOneDegreeOfFreedom) {
  // Differences 1 and 3: mean 2, standard error 1, one degree of freedom.
  const TTest test = *pairedT(Sample{5.0, 9.0}, Sample{4.0, 6.0});
  EXPECT_DOUBLE_EQ(test.statistic, 2.0);
  EXPECT_EQ(test.degreesOfFreedom, 1.0);
  EXPECT_NEAR(test.pValue, 1.0 - 2.0 / std::numbers::pi * std::atan(2.0), 1e-14);
}

TEST(PairedT, SeesWhatTheCommonSpreadOfTheShotsHides) {
  const Sample first{10.1, 20.2, 30.1, 40.2, 50.1};
  const Sample second{10.0, 20.0, 30.0, 40.0, 50.0};
  EXPECT_LT(pairedT(first, second)->pValue, 0.01);
  EXPECT_GT(welch(first, second)->pValue, 0.9);
}

TEST(PairedT, SaysNothingWhenAllDifferencesAreEqual) {
  EXPECT_FALSE(pairedT(Sample{1, 2, 3}, Sample{2, 3, 4}).has_value());
}

TEST(TTests, RefuseSamplesTheyCannotUse) {
  const double nan = std::nan("");
  EXPECT_THROW(welch(Sample{1}, Sample{1, 2}), base::CallerError);
  EXPECT_THROW(pairedT(Sample{1, 2, 3}, Sample{1, 2}), base::CallerError);
  EXPECT_THROW(pairedT(Sample{1, nan}, Sample{1, 2}), base::CallerError);
}

double exactMcNemar(int b, int c) {
  double choose = 1.0;
  double tail = 0.0;
  for (int k = 0; k <= std::min(b, c); ++k) {
    tail += choose;
    choose *= static_cast<double>(b + c - k) / (k + 1.0);
  }
  return std::min(1.0, 2.0 * tail * std::exp2(-(b + c)));
}

TEST(McNemarTest, ExactTailIsTheSumOfTheBinomialTerms) {
  for (int b = 0; b < 25; ++b) {
    for (int c = 0; c < 25; ++c) {
      EXPECT_NEAR(mcNemar(static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(c)).exactP, exactMcNemar(b, c),
                  1e-13);
    }
  }
}

TEST(McNemarTest, ChiSquareHasTheContinuityCorrection) {
  const McNemar result = mcNemar(59, 6);
  EXPECT_DOUBLE_EQ(result.chiSquare, 52.0 * 52.0 / 65.0);
  EXPECT_EQ(mcNemar(3, 4).chiSquare, 0.0);
  EXPECT_EQ(mcNemar(4, 4).chiSquareP, 1.0);
  // 3.841458820694124 is the 95th percentile of chi-square with one degree of freedom.
  EXPECT_NEAR(std::erfc(std::sqrt(0.5 * 3.841458820694124)), 0.05, 1e-15);
}

TEST(McNemarTest, BothFormsAgreeForManyDiscordantShots) {
  const McNemar result = mcNemar(500'700'000, 500'650'000);
  EXPECT_NEAR(result.exactP, result.chiSquareP, 1e-5);
  EXPECT_GT(result.exactP, 0.05);
  EXPECT_EQ(mcNemar(0, 1'000'000'000'000).exactP, 0.0);
}

TEST(McNemarTest, IsSymmetricAndSureOfNothingWithoutDisagreement) {
  EXPECT_EQ(mcNemar(0, 0).exactP, 1.0);
  EXPECT_EQ(mcNemar(3, 11).exactP, mcNemar(11, 3).exactP);
}

TEST(Holm, AdjustsAsItsDefinitionByHand) {
  // Sorted 0.01 x 4, 0.02 x 3, 0.03 x 2, 0.9 x 1; each at least the one before it.
  const Sample adjusted = holm(Sample{0.03, 0.01, 0.9, 0.02});
  EXPECT_DOUBLE_EQ(adjusted[0], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.04);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.9);
  EXPECT_DOUBLE_EQ(adjusted[3], 0.06);
  EXPECT_TRUE(holm({}).empty());
  EXPECT_THROW(holm(Sample{1.5}), base::CallerError);
}

RC_GTEST_PROP(Holm, NeverLowersAPValueNorChangesTheirOrder, ()) {
  const auto thousandths = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 1001));
  Sample p(thousandths.size());
  std::transform(thousandths.begin(), thousandths.end(), p.begin(), [](int value) { return value / 1000.0; });
  const Sample adjusted = holm(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    RC_ASSERT(adjusted[i] >= p[i] && adjusted[i] <= 1.0);
    for (std::size_t j = 0; j < p.size(); ++j) {
      RC_ASSERT(p[i] > p[j] || adjusted[i] <= adjusted[j]);
    }
  }
}

RC_GTEST_PROP(Welch, ChangesSignWithTheOrderOfTheSamples, ()) {
  const auto gen = rc::gen::suchThat(rc::gen::container<std::vector<int>>(rc::gen::inRange(-1000, 1000)),
                                     [](const std::vector<int>& v) { return v.size() > 1; });
  const std::vector<int> a = *gen;
  const std::vector<int> b = *gen;
  const Sample first(a.begin(), a.end());
  const Sample second(b.begin(), b.end());
  const auto forth = welch(first, second);
  const auto back = welch(second, first);
  RC_ASSERT(forth.has_value() == back.has_value());
  if (forth) {
    RC_ASSERT(forth->statistic == -back->statistic);
    RC_ASSERT(forth->pValue == back->pValue);
    RC_ASSERT(forth->pValue >= 0.0 && forth->pValue <= 1.0);
    RC_ASSERT(forth->degreesOfFreedom <= static_cast<double>(a.size() + b.size() - 2) * (1.0 + 1e-12));
  }
}

}  // namespace
}  // namespace lorica::stats
