#pragma once

/// \file
/// Counts of the shots on which two armor systems, or two models of the organs, disagree, and of those that one piece
/// alone protects against. Whole numbers: parts add up to the whole in any order.

#include "lorica/shotline/trace.h"

namespace lorica::shotline {

/// Targets of comparisons: 0 is the body, 1 + model * organs + organ an organ.
class PairTally {
 public:
  PairTally() = default;
  explicit PairTally(const TargetLayout& layout);

  static std::size_t bodyTarget() { return 0; }
  std::size_t organTarget(std::size_t organ, std::size_t model) const { return 1 + model * organs_ + organ; }

  /// Shots that cross the target and are protected under one system and not under the other.
  std::uint64_t onlyProtected(std::size_t target, std::size_t under, std::size_t notUnder) const {
    return onlyProtected_[(target * systems_ + under) * systems_ + notUnder];
  }
  /// Shots that cross an organ in one model and not in the other.
  std::uint64_t onlyHit(std::size_t organ, std::size_t in, std::size_t notIn) const {
    return onlyHit_[(organ * models_ + in) * models_ + notIn];
  }
  /// Shots that cross the target and before it this piece, and no other of the piece's system.
  std::uint64_t soleGuard(std::size_t target, std::size_t piece) const { return soleGuard_[target * pieces_ + piece]; }

  void add(const PairTally& other);
  bool operator==(const PairTally&) const = default;

  /// All counts one after another, for fromNumbers().
  std::vector<std::uint64_t> numbers() const;
  /// The tally of such numbers; none when there are not as many as the layout asks for, or when one is above `shots`.
  static std::optional<PairTally> fromNumbers(const TargetLayout& layout, std::span<const std::uint64_t> numbers,
                                              std::uint64_t shots);

 private:
  friend class PairCounter;
  std::size_t organs_ = 0;
  std::size_t models_ = 0;
  std::size_t systems_ = 0;
  std::size_t pieces_ = 0;
  std::vector<std::uint64_t> onlyProtected_;
  std::vector<std::uint64_t> onlyHit_;
  std::vector<std::uint64_t> soleGuard_;
};

/// Observer of observeShots() that fills a PairTally.
class PairCounter {
 public:
  /// \pre layout outlives the counter
  explicit PairCounter(const TargetLayout& layout);

  PairCounter fresh() const { return PairCounter(*layout_); }
  void see(std::uint64_t shot, const raycast::Ray& ray, std::span<const raycast::Hit> hits);
  void add(const PairCounter& other) { tally_.add(other.tally_); }
  const PairTally& tally() const { return tally_; }

 private:
  void compare(std::size_t target, std::uint32_t order);
  void compareModels();

  static constexpr std::uint32_t never = UINT32_MAX;
  const TargetLayout* layout_;
  PairTally tally_;
  std::vector<std::uint32_t> pieceOrder_;   ///< of each piece's first crossing in a shot
  std::vector<std::uint32_t> targetOrder_;  ///< of each target's
  std::vector<char> guarded_;               ///< per system, for one target
};

/// Counts and compares at once, so that the shots are traced once.
class CountAndCompare {
 public:
  CountAndCompare(const TargetLayout& layout, bool compare);
  CountAndCompare fresh() const { return {*layout_, compare_}; }
  void see(std::uint64_t shot, const raycast::Ray& ray, std::span<const raycast::Hit> hits) {
    counts_.count(hits);
    if (compare_ && !hits.empty()) {
      pairs_.see(shot, ray, hits);
    }
  }
  void add(const CountAndCompare& other) {
    counts_.add(other.counts_);
    pairs_.add(other.pairs_);
  }
  const Tally& tally() const { return counts_.tally(); }
  const PairTally& pairs() const { return pairs_.tally(); }

 private:
  const TargetLayout* layout_;
  bool compare_;
  ShotCounter counts_;
  PairCounter pairs_;
};

}  // namespace lorica::shotline
