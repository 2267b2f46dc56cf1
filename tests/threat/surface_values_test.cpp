#include "lorica/threat/surface_values.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "fields.h"
#include "lorica/base/error.h"
#include "lorica/geometry/primitives.h"

namespace lorica::threat {
namespace {

using geometry::Vec3d;

constexpr float none = std::numeric_limits<float>::quiet_NaN();

TEST(SurfaceValues, ShareOfATriangleIsThatOfAFineCount) {
  Numbers numbers;
  for (int round = 0; round < 50; ++round) {
    const std::array<double, 3> corners{numbers.next(), numbers.next(), numbers.next()};
    const double threshold = numbers.next();
    // The middles of the small triangles of a fine division.
    constexpr int n = 400;
    int above = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j + i < n; ++j) {
        for (const double third : {1.0, 2.0}) {
          const double a = (i + third / 3.0) / n;
          const double b = (j + third / 3.0) / n;
          if (a + b < 1.0) {
            above += corners[0] * (1.0 - a - b) + corners[1] * a + corners[2] * b > threshold ? 1 : 0;
          }
        }
      }
    }
    EXPECT_NEAR(shareOfTriangleAbove(corners, threshold), above / double(n) / n, 0.005);
  }
  EXPECT_EQ(shareOfTriangleAbove({1.0, 1.0, 1.0}, 1.0), 0.0);
  EXPECT_EQ(shareOfTriangleAbove({1.0, 1.0, 1.0}, 0.5), 1.0);
  EXPECT_EQ(shareOfTriangleAbove({1.0, 1.0, 2.0}, 1.0), 1.0);
}

TEST(SurfaceValues, MeanMaxAndShareOfALinearFieldOnASquareAreExact) {
  const geometry::Positions square{{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}};
  const std::vector<geometry::Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  const std::vector<float> values{0.0F, 4.0F, 4.0F, 0.0F};
  const SurfaceStatistics statistics = surfaceStatistics(square, triangles, values, 3.0);
  EXPECT_DOUBLE_EQ(statistics.area, 4.0);
  EXPECT_DOUBLE_EQ(statistics.areaWithValue, 4.0);
  EXPECT_EQ(statistics.max, 4.0F);
  EXPECT_EQ(statistics.maxVertex, 1U);
  EXPECT_DOUBLE_EQ(statistics.mean.value(), 2.0);
  EXPECT_DOUBLE_EQ(statistics.shareAbove.value(), 0.25);
}

TEST(SurfaceValues, TrianglesWithoutAValueCountNowhere) {
  const geometry::Positions square{{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}};
  const std::vector<geometry::Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  const SurfaceStatistics half = surfaceStatistics(square, triangles, std::vector<float>{1, none, 1, 1}, 0.5);
  EXPECT_DOUBLE_EQ(half.area, 4.0);
  EXPECT_DOUBLE_EQ(half.areaWithValue, 2.0);
  EXPECT_DOUBLE_EQ(half.mean.value(), 1.0);
  EXPECT_DOUBLE_EQ(half.shareAbove.value(), 1.0);
  const SurfaceStatistics nothing = surfaceStatistics(square, triangles, std::vector<float>(4, none), 0.5);
  EXPECT_FALSE(nothing.max || nothing.mean || nothing.shareAbove);
}

TEST(SurfaceValues, PeakTimeAndIntegralOfAPulseAreKnown) {
  // A triangle over time that peaks with 6 at 2 s: its area over 4 s is 12.
  const auto pulse = [](const Vec3d& p, double t) { return p.x() * (3.0 - std::abs(t - 2.0) * 1.5); };
  const auto sampler = FieldSampler(std::make_shared<const ThreatField>(
      latticeField({{planes(0.0, 1.0, 3), planes(0.0, 1.0, 2), planes(0.0, 1.0, 2)}}, {0.0, 1.0, 2.0, 4.0}, pulse)));
  const geometry::Positions places{{2.0F, 0.5F, 0.5F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}, {9.0F, 0.0F, 0.0F}};
  const Exposure seen = exposure(sampler, 0, places);
  EXPECT_FLOAT_EQ(seen.peak[0], 6.0F);
  EXPECT_DOUBLE_EQ(seen.peakTime[0], 2.0);
  EXPECT_FLOAT_EQ(seen.integral[0], 2.0F * (0.75F + 2.25F + 3.0F));
  EXPECT_FLOAT_EQ(seen.peak[1], 3.0F);
  EXPECT_DOUBLE_EQ(seen.peakTime[2], 0.0) << "of equal values the first time counts";
  EXPECT_TRUE(std::isnan(seen.peak[3]) && std::isnan(seen.peakTime[3]) && std::isnan(seen.integral[3]));
}

TEST(SurfaceValues, IntegralCountsWhatIsAboveZero) {
  // From 2 down to -2 over 4 s: above zero for 2 s with a mean of 1.
  const FieldSampler sampler(std::make_shared<const ThreatField>(
      pointField({{0, 0, 0}}, {0.0, 4.0, 5.0, 7.0}, [](auto&&, double t) { return t < 4.5 ? 2.0 - t : t - 6.0; })));
  EXPECT_FLOAT_EQ(exposure(sampler, 0, geometry::Positions{{0, 0, 0}}).integral[0], 2.0F + 0.5F);
}

TEST(SurfaceValues, ExposureIsWhatSamplingAtEachTimeGives) {
  Numbers numbers;
  const std::vector<double> times{0.0, 0.25, 0.5, 2.0};
  ThreatField field = pointField(numbers.places(300, 0.0, 1.0), times,
                                 [](const Vec3d& p, double t) { return std::sin(9.0 * p.x() - 3.0 * t) + p.y(); });
  // One step with points of its own.
  field.steps[2].points = std::make_shared<const geometry::Positions>(numbers.places(300, 0.0, 1.0));
  const FieldSampler sampler(std::make_shared<const ThreatField>(field));
  const geometry::Positions places = numbers.places(200, -0.3, 1.3);
  const Exposure seen = exposure(sampler, 0, places, {2});
  for (std::size_t v = 0; v < places.size(); ++v) {
    std::optional<double> peak;
    for (const double time : times) {
      const std::optional<double> here = sampler.value(places[v].cast<double>(), time, 0);
      peak = here && (!peak || *here > *peak) ? here : peak;
    }
    ASSERT_EQ(peak.has_value(), !std::isnan(seen.peak[v]));
    if (peak) {
      EXPECT_FLOAT_EQ(seen.peak[v], static_cast<float>(*peak));
    }
  }
}

TEST(SurfaceValues, DoNotDependOnTheNumberOfThreads) {
  Numbers numbers;
  const FieldSampler sampler(std::make_shared<const ThreatField>(
      pointField(numbers.places(2000, 0.0, 1.0), {0.0, 1.0}, [](const Vec3d& p, double t) { return p.norm() * t; })));
  const geometry::Positions places = numbers.places(3000, 0.0, 1.0);
  const Exposure one = exposure(sampler, 0, places, {1});
  const Exposure four = exposure(sampler, 0, places, {4});
  // By their bits: what is not a number equals nothing.
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  for (std::size_t v = 0; v < places.size(); ++v) {
    EXPECT_EQ(bits(one.peak[v]), bits(four.peak[v]));
    EXPECT_EQ(bits(one.integral[v]), bits(four.integral[v]));
  }
}

TEST(SurfaceValues, StopWhenCancelled) {
  base::Task task;
  task.cancel();
  const FieldSampler sampler(
      std::make_shared<const ThreatField>(pointField({{0, 0, 0}}, {0.0}, [](auto&&, double) { return 1.0; })));
  EXPECT_THROW(exposure(sampler, 0, geometry::Positions{{0, 0, 0}}, {}, base::Progress(task)), base::Cancelled);
}

}  // namespace
}  // namespace lorica::threat
