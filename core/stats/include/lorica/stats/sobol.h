#pragma once

/// \file
/// Sobol points, randomised: evenly spread, and each one uniform by itself. A point is a function of (seed, source,
/// trial, shot) and of nothing else. Direction numbers of the first four dimensions as S. Joe and F. Y. Kuo,
/// "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30 (2008); scrambled in
/// nested binary digits (A. B. Owen, 1995) by the hash of S. Laine and T. Karras (2011) with the multipliers of B.
/// Burley, "Practical hash-based Owen scrambling", J. Comput. Graph. Tech. 9 (2020). Any 2^k shots that start at a
/// multiple of 2^k fill the first two dimensions, and the next two, as a (0, k, 2)-net.

#include <array>
#include <cstdint>

#include "lorica/stats/philox.h"

namespace lorica::stats {

/// The Sobol points of one trial. Immutable, thread-safe; a point costs some 50 operations.
class SobolPoints {
 public:
  explicit SobolPoints(const ShotKey& key);

  /// The first two dimensions, in (0, 1), 32 bits each. After 2^32 shots another scrambling begins.
  /// \pre shot < shotLimit
  std::array<double, 2> point2(std::uint64_t shot) const;
  /// All four. \pre shot < shotLimit
  std::array<double, 4> point4(std::uint64_t shot) const;

 private:
  using Seeds = std::array<std::uint32_t, 4>;
  Seeds seedsOf(std::uint64_t shot) const;

  ShotKey key_;
  Seeds first_;  ///< of the first 2^32 shots
};

}  // namespace lorica::stats
