#include "lorica/stats/accumulators.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <vector>

namespace lorica::stats {
namespace {

Moments of(const std::vector<double>& values) {
  Moments moments;
  for (const double value : values) {
    moments.add(value);
  }
  return moments;
}

TEST(Moments, GiveMeanAndUnbiasedVariance) {
  const Moments moments = of({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0});
  EXPECT_EQ(moments.count(), 8U);
  EXPECT_DOUBLE_EQ(moments.mean(), 5.0);
  EXPECT_DOUBLE_EQ(moments.variance(), 32.0 / 7.0);
}

TEST(Moments, KeepSmallSpreadOnALargeMean) {
  const Moments moments = of({1e9 + 4.0, 1e9 + 7.0, 1e9 + 13.0, 1e9 + 16.0});
  EXPECT_DOUBLE_EQ(moments.variance(), 30.0);
}

TEST(Moments, OfEqualValuesHaveNoVarianceAtAll) {
  EXPECT_EQ(of({0.1, 0.1, 0.1, 0.1, 0.1}).variance(), 0.0);
}

TEST(Moments, RefuseWhatASampleTooSmallDoesNotHave) {
  EXPECT_THROW(Moments().mean(), base::CallerError);
  EXPECT_THROW(of({1.0}).variance(), base::CallerError);
}

RC_GTEST_PROP(Moments, MergedPiecesEqualTheWhole, ()) {
  const auto raw = *rc::gen::suchThat(rc::gen::container<std::vector<int>>(rc::gen::inRange(-100000, 100000)),
                                      [](const std::vector<int>& v) { return v.size() > 1; });
  const auto cut = static_cast<std::ptrdiff_t>(*rc::gen::inRange<std::size_t>(0, raw.size() + 1));
  const std::vector<double> values(raw.begin(), raw.end());
  Moments merged = of({values.begin(), values.begin() + cut});
  merged.merge(of({values.begin() + cut, values.end()}));
  const Moments whole = of(values);
  RC_ASSERT(merged.count() == whole.count());
  RC_ASSERT(std::abs(merged.mean() - whole.mean()) <= 1e-15 * 1e5 * 16);
  RC_ASSERT(std::abs(merged.variance() - whole.variance()) <= 1e-13 * (whole.variance() + 1.0) * 16);
}

}  // namespace
}  // namespace lorica::stats
