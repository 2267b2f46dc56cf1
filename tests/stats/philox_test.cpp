#include "lorica/stats/philox.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>
#include <set>
#include <vector>

namespace lorica::stats {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Known answers published with Random123, the authors' own implementation (kat_vectors, philox4x32 10).
static_assert(philox({0, 0, 0, 0}, {0, 0}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
static_assert(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
              Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
static_assert(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
              Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});

TEST(Philox, GivesThePublishedAnswersAtRunTimeToo) {
  const Words zero{0, 0, 0, 0};
  EXPECT_EQ(philox(zero, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
}

TEST(ShotStream, PutsSeedIntoTheKeyAndEverythingElseIntoTheCounterAsDocumented) {
  const ShotKey key{0x299f31d0'a4093822, 0x03707344, 0x13198a2e};
  // Counter words 0 and 1 of the published answer: the shot is 0xa308d3'243f6a88, the draw 0x85.
  EXPECT_EQ(shotBits(key, 0xa308d3'243f6a88, 0x85), (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(ShotStream, UsesTheUpper53BitsOfEachPairOfWords) {
  const ShotKey key{0x299f31d0'a4093822, 0x03707344, 0x13198a2e};
  const std::array<double, 2> u = uniform2(key, 0xa308d3'243f6a88, 0x85);
  EXPECT_EQ(u[0], static_cast<double>(0x94fdcceb'd16cfe09 >> 11) / 9007199254740992.0);
  EXPECT_EQ(u[1], static_cast<double>(0x24126ea1'5001e420 >> 11) / 9007199254740992.0);
}

TEST(ShotStream, ReachesZeroAndTheLargestDoubleBelowOneButNeverOne) {
  EXPECT_EQ(unitInterval(0, 0x7ff), 0.0);
  EXPECT_EQ(unitInterval(0xffffffff, 0xffffffff), std::nextafter(1.0, 0.0));
}

TEST(ShotStream, ChangesWithEveryPartOfItsName) {
  const ShotKey key{7, 11, 13};
  std::set<std::array<double, 2>> seen{uniform2(key, 17, 3)};
  seen.insert(uniform2({8, 11, 13}, 17, 3));
  seen.insert(uniform2({7 + (std::uint64_t{1} << 32), 11, 13}, 17, 3));
  seen.insert(uniform2({7, 12, 13}, 17, 3));
  seen.insert(uniform2({7, 11, 14}, 17, 3));
  seen.insert(uniform2(key, 18, 3));
  seen.insert(uniform2(key, 17 + (std::uint64_t{1} << 32), 3));
  seen.insert(uniform2(key, 17, 4));
  EXPECT_EQ(seen.size(), 8U);
}

TEST(ShotStream, DrawsOfFourAreTwoConsecutiveDrawsOfTwo) {
  const ShotKey key{7, 11, 13};
  const std::array<double, 4> four = uniform4(key, 17, 5);
  const std::array<double, 2> first = uniform2(key, 17, 5);
  const std::array<double, 2> second = uniform2(key, 17, 6);
  EXPECT_EQ(four, (std::array<double, 4>{first[0], first[1], second[0], second[1]}));
}

TEST(ShotStream, RefusesShotsAndDrawsThatWouldShareACounter) {
  EXPECT_NO_THROW(shotBits({}, shotLimit - 1, drawLimit - 1));
  EXPECT_THROW(shotBits({}, shotLimit), base::CallerError);
  EXPECT_THROW(shotBits({}, 0, drawLimit), base::CallerError);
  EXPECT_THROW(uniform4({}, 0, drawLimit - 1), base::CallerError);
}

TEST(ShotStream, FillsTheSquareEvenly) {
  // Chi-square over 32 x 32 cells: 1023 degrees of freedom, standard deviation 45.2; six of them are allowed.
  constexpr int side = 32;
  constexpr int shots = 400000;
  std::vector<int> cells(side * side);
  for (std::uint64_t shot = 0; shot < shots; ++shot) {
    const std::array<double, 2> u = uniform2({1, sourceId("front"), 0}, shot);
    ++cells[static_cast<std::size_t>(u[0] * side) * side + static_cast<std::size_t>(u[1] * side)];
  }
  const double expected = static_cast<double>(shots) / (side * side);
  double chiSquare = 0.0;
  for (const int count : cells) {
    chiSquare += (count - expected) * (count - expected) / expected;
  }
  EXPECT_NEAR(chiSquare, side * side - 1.0, 6.0 * std::sqrt(2.0 * (side * side - 1.0)));
}

TEST(ShotStream, NeighbouringTrialsAndShotsAreUncorrelated) {
  constexpr int shots = 200000;
  double trials = 0.0;
  double neighbours = 0.0;
  for (std::uint64_t shot = 0; shot < shots; ++shot) {
    const double here = uniform2({1, 2, 0}, shot)[0] - 0.5;
    trials += here * (uniform2({1, 2, 1}, shot)[0] - 0.5);
    neighbours += here * (uniform2({1, 2, 0}, shot + 1)[0] - 0.5);
  }
  // The standard deviation of a sum of such products is sqrt(shots) / 12.
  EXPECT_LT(std::abs(trials), 5.0 * std::sqrt(shots) / 12.0);
  EXPECT_LT(std::abs(neighbours), 5.0 * std::sqrt(shots) / 12.0);
}

TEST(SourceId, IsThePublishedFnv1a) {
  EXPECT_EQ(sourceId(""), 0x811c9dc5U);
  EXPECT_EQ(sourceId("a"), 0xe40c292cU);
  EXPECT_EQ(sourceId("foobar"), 0xbf9cf968U);
}

RC_GTEST_PROP(ShotStream, StaysInTheUnitInterval, (std::uint64_t seed, std::uint32_t source, std::uint32_t trial)) {
  const std::uint64_t shot = *rc::gen::inRange<std::uint64_t>(0, shotLimit);
  const std::uint32_t draw = *rc::gen::inRange<std::uint32_t>(0, drawLimit - 1);
  for (const double u : uniform4({seed, source, trial}, shot, draw)) {
    RC_ASSERT(u >= 0.0 && u < 1.0);
  }
}

}  // namespace
}  // namespace lorica::stats
