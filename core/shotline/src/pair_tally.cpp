#include "lorica/shotline/pair_tally.h"

#include <algorithm>

namespace lorica::shotline {

namespace {

void addUp(std::vector<std::uint64_t>& sums, const std::vector<std::uint64_t>& more) {
  LORICA_CHECK(sums.size() == more.size(), "tallies of one layout");
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] += more[i];
  }
}

}  // namespace

PairTally::PairTally(const TargetLayout& layout)
    : organs_(layout.organs), models_(layout.models), systems_(layout.systems), pieces_(layout.pieces()) {
  const std::size_t targets = 1 + organs_ * models_;
  onlyProtected_.resize(targets * systems_ * systems_);
  onlyHit_.resize(organs_ * models_ * models_);
  soleGuard_.resize(targets * pieces_);
}

void PairTally::add(const PairTally& other) {
  if (systems_ == 0) {
    *this = other;
    return;
  }
  addUp(onlyProtected_, other.onlyProtected_);
  addUp(onlyHit_, other.onlyHit_);
  addUp(soleGuard_, other.soleGuard_);
}

std::vector<std::uint64_t> PairTally::numbers() const {
  std::vector<std::uint64_t> numbers = onlyProtected_;
  numbers.insert(numbers.end(), onlyHit_.begin(), onlyHit_.end());
  numbers.insert(numbers.end(), soleGuard_.begin(), soleGuard_.end());
  return numbers;
}

std::optional<PairTally> PairTally::fromNumbers(const TargetLayout& layout, std::span<const std::uint64_t> numbers,
                                                std::uint64_t shots) {
  PairTally tally(layout);
  const bool sound = numbers.size() == tally.numbers().size() &&
                     std::all_of(numbers.begin(), numbers.end(), [&](std::uint64_t n) { return n <= shots; });
  if (!sound) {
    return std::nullopt;
  }
  for (std::vector<std::uint64_t>* counts : {&tally.onlyProtected_, &tally.onlyHit_, &tally.soleGuard_}) {
    std::copy_n(numbers.begin(), counts->size(), counts->begin());
    numbers = numbers.subspan(counts->size());
  }
  return tally;
}

PairCounter::PairCounter(const TargetLayout& layout)
    : layout_(&layout),
      tally_(layout),
      pieceOrder_(layout.pieces(), never),
      targetOrder_(1 + layout.organs * layout.models, never),
      guarded_(layout.systems, 0) {}

void PairCounter::see(std::uint64_t /*shot*/, const raycast::Ray& /*ray*/, std::span<const raycast::Hit> hits) {
  const std::size_t pieces = layout_->pieces();
  for (std::uint32_t order = 0; order < hits.size(); ++order) {
    const std::uint32_t mesh = hits[order].mesh;
    std::uint32_t& first = mesh == 0        ? targetOrder_[0]
                           : mesh <= pieces ? pieceOrder_[mesh - 1]
                                            : targetOrder_[mesh - pieces];
    first = std::min(first, order);
  }
  for (std::size_t target = 0; target < targetOrder_.size(); ++target) {
    if (targetOrder_[target] != never) {
      compare(target, targetOrder_[target]);
    }
  }
  compareModels();
  std::fill(pieceOrder_.begin(), pieceOrder_.end(), never);
  std::fill(targetOrder_.begin(), targetOrder_.end(), never);
}

void PairCounter::compare(std::size_t target, std::uint32_t order) {
  const std::size_t systems = layout_->systems;
  std::fill(guarded_.begin(), guarded_.end(), 0);
  for (std::size_t piece = 0; piece < pieceOrder_.size(); ++piece) {
    if (pieceOrder_[piece] < order) {
      char& guards = guarded_[layout_->pieceSystem[piece]];
      guards = static_cast<char>(guards == 0 ? 1 : 2);
    }
  }
  for (std::size_t piece = 0; piece < pieceOrder_.size(); ++piece) {
    if (pieceOrder_[piece] < order && guarded_[layout_->pieceSystem[piece]] == 1) {
      ++tally_.soleGuard_[target * pieceOrder_.size() + piece];
    }
  }
  for (std::size_t a = 0; a < systems; ++a) {
    for (std::size_t b = 0; b < systems; ++b) {
      tally_.onlyProtected_[(target * systems + a) * systems + b] += guarded_[a] != 0 && guarded_[b] == 0 ? 1 : 0;
    }
  }
}

void PairCounter::compareModels() {
  const std::size_t models = layout_->models;
  for (std::size_t organ = 0; organ < layout_->organs; ++organ) {
    for (std::size_t a = 0; a < models; ++a) {
      for (std::size_t b = 0; b < models; ++b) {
        const bool inA = targetOrder_[tally_.organTarget(organ, a)] != never;
        const bool inB = targetOrder_[tally_.organTarget(organ, b)] != never;
        tally_.onlyHit_[(organ * models + a) * models + b] += inA && !inB ? 1 : 0;
      }
    }
  }
}

CountAndCompare::CountAndCompare(const TargetLayout& layout, bool compare)
    : layout_(&layout), compare_(compare), counts_(layout), pairs_(layout) {}

}  // namespace lorica::shotline
