#include "lorica/stats/sobol.h"

namespace lorica::stats {

namespace {

constexpr std::size_t dimensions = 4;
/// The draw of Philox that the scrambling is keyed by; draws of shots lie far below.
constexpr std::uint32_t scrambleDraw = drawLimit - 1;

constexpr std::uint32_t reversed(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0xFF00FF00U) >> 8) | ((x & 0x00FF00FFU) << 8);
  x = ((x & 0xF0F0F0F0U) >> 4) | ((x & 0x0F0F0F0FU) << 4);
  x = ((x & 0xCCCCCCCCU) >> 2) | ((x & 0x33333333U) << 2);
  return ((x & 0xAAAAAAAAU) >> 1) | ((x & 0x55555555U) << 1);
}

using Directions = std::array<std::uint32_t, 32>;

/// Direction numbers from a primitive polynomial of a degree with inner coefficients `a`, and its first odd numbers.
constexpr Directions directionsOf(std::size_t degree, std::uint32_t a, std::array<std::uint32_t, 3> m) {
  Directions v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (i < degree) {
      v[i] = m[i] << (31 - i);
      continue;
    }
    v[i] = v[i - degree] ^ (v[i - degree] >> degree);
    for (std::size_t k = 1; k < degree; ++k) {
      if (((a >> (degree - 1 - k)) & 1U) != 0) {
        v[i] ^= v[i - k];
      }
    }
  }
  return v;
}

constexpr Directions vanDerCorput() {
  Directions v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = 1U << (31 - i);
  }
  return v;
}

/// Exclusive ors of the direction numbers for each value of each byte of the shot number.
using Bytes = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr Bytes bytesOf(const Directions& v) {
  Bytes bytes{};
  for (std::size_t byte = 0; byte < 4; ++byte) {
    for (std::uint32_t value = 1; value < 256; ++value) {
      for (std::size_t bit = 0; bit < 8; ++bit) {
        if (((value >> bit) & 1U) != 0) {
          bytes[byte][value] ^= v[8 * byte + bit];
        }
      }
    }
  }
  return bytes;
}

constexpr std::array<Bytes, dimensions> tables{bytesOf(vanDerCorput()), bytesOf(directionsOf(1, 0, {1, 0, 0})),
                                               bytesOf(directionsOf(2, 1, {1, 3, 0})),
                                               bytesOf(directionsOf(3, 1, {1, 3, 1}))};

std::uint32_t sobol(std::uint32_t shot, std::size_t dimension) {
  const Bytes& bytes = tables[dimension];
  return bytes[0][shot & 255U] ^ bytes[1][(shot >> 8) & 255U] ^ bytes[2][(shot >> 16) & 255U] ^ bytes[3][shot >> 24];
}

/// Flips each binary digit by a hash of the seed and of the digits before it.
std::uint32_t scrambled(std::uint32_t digits, std::uint32_t seed) {
  std::uint32_t x = reversed(digits);
  x += seed;
  // Even multipliers: a bit is changed by lower ones only, which are the digits before it.
  x ^= x * 0x6C50B47CU;
  x ^= x * 0xB82F1E52U;
  x ^= x * 0xC7AFE638U;
  x ^= x * 0x8D22F6E6U;
  return reversed(x);
}

/// The middle of the interval of size 2^-32 that the digits name.
double unit(std::uint32_t digits) {
  return (static_cast<double>(digits) + 0.5) * 0x1p-32;
}

double coordinate(std::uint64_t shot, std::size_t dimension, std::uint32_t seed) {
  return unit(scrambled(sobol(static_cast<std::uint32_t>(shot), dimension), seed));
}

}  // namespace

SobolPoints::SobolPoints(const ShotKey& key) : key_(key), first_(shotBits(key, 0, scrambleDraw)) {}

SobolPoints::Seeds SobolPoints::seedsOf(std::uint64_t shot) const {
  return shot >> 32 == 0 ? first_ : shotBits(key_, shot >> 32, scrambleDraw);
}

std::array<double, 2> SobolPoints::point2(std::uint64_t shot) const {
  LORICA_CHECK(shot < shotLimit, "shot number beyond the counter");
  const Seeds seeds = seedsOf(shot);
  return {coordinate(shot, 0, seeds[0]), coordinate(shot, 1, seeds[1])};
}

std::array<double, 4> SobolPoints::point4(std::uint64_t shot) const {
  LORICA_CHECK(shot < shotLimit, "shot number beyond the counter");
  const Seeds seeds = seedsOf(shot);
  return {coordinate(shot, 0, seeds[0]), coordinate(shot, 1, seeds[1]), coordinate(shot, 2, seeds[2]),
          coordinate(shot, 3, seeds[3])};
}

}  // namespace lorica::stats
