#include "lorica/stats/sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "lorica/stats/accumulators.h"

namespace lorica::stats {
namespace {

/// Whether each box of 2^-a times 2^-b holds one of 2^(a + b) points.
bool isNet(const std::vector<std::array<double, 2>>& points, unsigned a, unsigned b) {
  std::set<std::pair<int, int>> boxes;
  for (const auto& p : points) {
    boxes.emplace(static_cast<int>(std::ldexp(p[0], static_cast<int>(a))),
                  static_cast<int>(std::ldexp(p[1], static_cast<int>(b))));
  }
  return boxes.size() == points.size();
}

TEST(SobolPoints, FillEveryElementaryBoxOnceInBothPairsOfDimensions) {
  constexpr unsigned bits = 10;
  const SobolPoints sobol({1, 42, 3});
  for (const std::uint64_t start : {std::uint64_t{0}, std::uint64_t{5} << bits, (std::uint64_t{1} << 32) + 1024}) {
    std::vector<std::array<double, 2>> first;
    std::vector<std::array<double, 2>> second;
    for (std::uint64_t i = 0; i < (1U << bits); ++i) {
      const auto p = sobol.point4(start + i);
      first.push_back({p[0], p[1]});
      second.push_back({p[2], p[3]});
      EXPECT_EQ(first.back(), sobol.point2(start + i));
    }
    for (unsigned a = 0; a <= bits; ++a) {
      EXPECT_TRUE(isNet(first, a, bits - a)) << start << ", " << a;
    }
    // Dimensions 3 and 4 have a quality parameter t of up to 3; each by itself is perfect.
    EXPECT_TRUE(isNet(second, bits, 0));
    EXPECT_TRUE(isNet(second, 0, bits));
  }
}

TEST(SobolPoints, AreEachUniformOverSeedsAndTrials) {
  constexpr int count = 20000;
  for (const std::uint64_t shot : {0, 1, 77}) {
    std::array<Moments, 4> moments;
    double product = 0.0;
    for (int trial = 0; trial < count; ++trial) {
      const auto p = SobolPoints({9, 1, static_cast<std::uint32_t>(trial)}).point4(shot);
      for (std::size_t d = 0; d < 4; ++d) {
        moments[d].add(p[d]);
      }
      product += (p[0] - 0.5) * (p[1] - 0.5);
    }
    for (const Moments& m : moments) {
      EXPECT_NEAR(m.mean(), 0.5, 5 * std::sqrt(1.0 / 12 / count));
      EXPECT_NEAR(m.variance(), 1.0 / 12, 0.003);
    }
    EXPECT_NEAR(product / count, 0.0, 5.0 / 12 / std::sqrt(count)) << "dimensions are scrambled apart";
  }
}

/// Share of points inside a disk: a discontinuous integrand, as hits are.
double diskShare(const auto& point, int count) {
  int inside = 0;
  for (int i = 0; i < count; ++i) {
    const auto p = point(static_cast<std::uint64_t>(i));
    inside += std::hypot(p[0] - 0.45, p[1] - 0.55) < 0.3 ? 1 : 0;
  }
  return inside / static_cast<double>(count);
}

TEST(SobolPoints, AreRightOnAverageAndFarSteadierThanRandomOnes) {
  constexpr int count = 4096;
  Moments sobol;
  Moments random;
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    const ShotKey key{3, 8, trial};
    const SobolPoints points(key);
    sobol.add(diskShare([&](std::uint64_t i) { return points.point2(i); }, count));
    random.add(diskShare([&](std::uint64_t i) { return uniform2(key, i); }, count));
  }
  const double share = 3.14159265358979 * 0.09;
  EXPECT_NEAR(sobol.mean(), share, 5 * sobol.standardDeviation() / std::sqrt(200.0));
  EXPECT_LT(sobol.standardDeviation(), 0.25 * random.standardDeviation());
}

}  // namespace
}  // namespace lorica::stats
