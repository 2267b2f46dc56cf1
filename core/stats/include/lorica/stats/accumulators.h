#pragma once

/// \file
/// Sums that can be made in pieces: merging the pieces of a sample equals accumulating it whole, up to rounding. Merged
/// in a fixed order the result is the same bit for bit.

#include <cmath>
#include <cstdint>

#include "lorica/base/error.h"

namespace lorica::stats {

/// Mean and variance in one pass (B. P. Welford 1962; merged after T. F. Chan, G. H. Golub and R. J. LeVeque 1979).
class Moments {
 public:
  void add(double value) {
    ++count_;
    const double offset = value - mean_;
    mean_ += offset / static_cast<double>(count_);
    squares_ += offset * (value - mean_);
  }

  void merge(const Moments& other) {
    if (other.count_ == 0) {
      return;
    }
    if (count_ == 0) {
      *this = other;
      return;
    }
    const double mine = static_cast<double>(count_);
    const double theirs = static_cast<double>(other.count_);
    const double offset = other.mean_ - mean_;
    mean_ += offset * (theirs / (mine + theirs));
    squares_ += other.squares_ + offset * offset * (mine * theirs / (mine + theirs));
    count_ += other.count_;
  }

  std::uint64_t count() const { return count_; }
  /// \pre count() > 0
  double mean() const {
    LORICA_CHECK(count_ > 0, "an empty sample has no mean");
    return mean_;
  }
  /// Unbiased, with count - 1.
  /// \pre count() > 1
  double variance() const {
    LORICA_CHECK(count_ > 1, "a variance needs two values");
    return squares_ / static_cast<double>(count_ - 1);
  }
  /// \pre count() > 1
  double standardDeviation() const { return std::sqrt(variance()); }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  // sum of squared offsets from the mean
};

}  // namespace lorica::stats
