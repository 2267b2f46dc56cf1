#pragma once

/// \file
/// Keyed random numbers: a number is a function of (seed, source, trial, shot, draw) and of nothing else, so any thread
/// or rank may compute any shot in any order. Philox 4x32-10 of J. K. Salmon, M. A. Moraes, R. O. Dror and D. E. Shaw,
/// "Parallel random numbers: as easy as 1, 2, 3", SC'11 (2011). Everything here is pure and thread-safe; one call of
/// philox() costs about 20 multiplications.

#include <array>
#include <cstdint>
#include <string_view>

#include "lorica/base/error.h"

namespace lorica::stats {

/// Ten rounds of Philox 4x32: a bijection of counters, chosen by the key.
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t multiplier0 = 0xD2511F53U;
  constexpr std::uint64_t multiplier1 = 0xCD9E8D57U;
  constexpr std::uint32_t golden = 0x9E3779B9U;     // fraction of the golden ratio
  constexpr std::uint32_t rootThree = 0xBB67AE85U;  // fraction of the square root of 3
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = multiplier0 * counter[0];
    const std::uint64_t product1 = multiplier1 * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(product0)};
    key[0] += golden;
    key[1] += rootThree;
  }
  return counter;
}

/// What a stream of shots is named by.
struct ShotKey {
  std::uint64_t seed = 1;
  std::uint32_t source = 0;  ///< sourceId() of the source's name
  std::uint32_t trial = 0;   ///< from 0
  bool operator==(const ShotKey&) const = default;
};

/// One more than the largest shot number, and the number of draws of two per shot.
inline constexpr std::uint64_t shotLimit = std::uint64_t{1} << 56;
inline constexpr std::uint32_t drawLimit = 256;

/// Random bits of one draw. The key of Philox is the seed (low word first); its counter is, low word first, the low 32
/// bits of the shot; the next 24 bits of the shot under 8 bits of the draw; the trial; the source.
/// \pre shot < shotLimit, draw < drawLimit
constexpr std::array<std::uint32_t, 4> shotBits(const ShotKey& key, std::uint64_t shot, std::uint32_t draw = 0) {
  LORICA_CHECK(shot < shotLimit && draw < drawLimit, "shot or draw number beyond the counter");
  return philox(
      {static_cast<std::uint32_t>(shot), static_cast<std::uint32_t>(shot >> 32) | draw << 24, key.trial, key.source},
      {static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)});
}

/// The upper 53 of 64 bits as a multiple of 2^-53 in [0, 1).
constexpr double unitInterval(std::uint32_t high, std::uint32_t low) {
  return static_cast<double>((std::uint64_t{high} << 32 | low) >> 11) * 0x1p-53;
}

/// Two independent numbers, uniform in [0, 1) with 53 bits, of one draw of a shot.
/// \pre as shotBits
constexpr std::array<double, 2> uniform2(const ShotKey& key, std::uint64_t shot, std::uint32_t draw = 0) {
  const std::array<std::uint32_t, 4> bits = shotBits(key, shot, draw);
  return {unitInterval(bits[1], bits[0]), unitInterval(bits[3], bits[2])};
}

/// Four such numbers: those of `draw` and of `draw + 1`.
/// \pre shot < shotLimit, draw + 1 < drawLimit
constexpr std::array<double, 4> uniform4(const ShotKey& key, std::uint64_t shot, std::uint32_t draw = 0) {
  const std::array<double, 2> first = uniform2(key, shot, draw);
  const std::array<double, 2> second = uniform2(key, shot, draw + 1);
  return {first[0], first[1], second[0], second[1]};
}

/// 32-bit FNV-1a hash of a source's name (Fowler, Noll, Vo): the same name gives the same shots in every study.
std::uint32_t sourceId(std::string_view name);

}  // namespace lorica::stats
