#include "lorica/shotline/tally.h"

#include "lorica/base/error.h"

namespace lorica::shotline {

namespace {

void add(Count& sum, const Count& more) {
  sum.any += more.any;
  sum.first += more.first;
  sum.shielded += more.shielded;
  sum.withBody += more.withBody;
}

void add(std::vector<Count>& sums, const std::vector<Count>& more) {
  LORICA_CHECK(sums.size() == more.size(), "tallies of one layout");
  for (std::size_t i = 0; i < sums.size(); ++i) {
    add(sums[i], more[i]);
  }
}

}  // namespace

Tally::Tally(const TargetLayout& layout)
    : systems_(layout.systems),
      organsPerModel_(layout.organs),
      classCount_(layout.classes),
      bodyShielded_(layout.systems),
      regions_(layout.regions * layout.systems),
      organs_(layout.organs * layout.models * layout.systems),
      anyOrgan_(layout.models * layout.systems),
      classes_(layout.models * layout.classes * layout.systems),
      pieces_(layout.pieces()),
      anyArmor_(layout.systems) {}

Count Tally::body(std::size_t system) const {
  Count count = body_;
  count.shielded = bodyShielded_[system];
  count.first = count.any - count.shielded;
  count.withBody = count.any;
  return count;
}

void Tally::add(const Tally& other) {
  if (systems_ == 0) {
    *this = other;
    return;
  }
  LORICA_CHECK(systems_ == other.systems_, "tallies of one layout");
  shots_ += other.shots_;
  shotline::add(body_, other.body_);
  for (std::size_t s = 0; s < systems_; ++s) {
    bodyShielded_[s] += other.bodyShielded_[s];
  }
  shotline::add(regions_, other.regions_);
  shotline::add(organs_, other.organs_);
  shotline::add(anyOrgan_, other.anyOrgan_);
  shotline::add(classes_, other.classes_);
  shotline::add(pieces_, other.pieces_);
  shotline::add(anyArmor_, other.anyArmor_);
}

template <class Self, class Use>
void Tally::forEachCount(Self& tally, const Use& use) {
  use(tally.body_);
  for (auto* counts :
       {&tally.regions_, &tally.organs_, &tally.anyOrgan_, &tally.classes_, &tally.pieces_, &tally.anyArmor_}) {
    for (auto& count : *counts) {
      use(count);
    }
  }
}

std::vector<std::uint64_t> Tally::numbers() const {
  std::vector<std::uint64_t> numbers{shots_};
  numbers.insert(numbers.end(), bodyShielded_.begin(), bodyShielded_.end());
  forEachCount(*this, [&](const Count& count) {
    numbers.insert(numbers.end(), {count.any, count.first, count.shielded, count.withBody});
  });
  return numbers;
}

std::optional<Tally> Tally::fromNumbers(const TargetLayout& layout, std::span<const std::uint64_t> numbers) {
  Tally tally(layout);
  if (numbers.size() != tally.numbers().size()) {
    return std::nullopt;
  }
  std::size_t next = 0;
  tally.shots_ = numbers[next++];
  for (std::uint64_t& shielded : tally.bodyShielded_) {
    shielded = numbers[next++];
  }
  bool sound = true;
  forEachCount(tally, [&](Count& count) {
    count = {numbers[next], numbers[next + 1], numbers[next + 2], numbers[next + 3]};
    next += 4;
    sound = sound && count.any <= tally.shots_ && count.first <= count.any && count.shielded <= count.any &&
            count.withBody <= count.any;
  });
  for (const std::uint64_t shielded : tally.bodyShielded_) {
    sound = sound && shielded <= tally.body_.any;
  }
  return sound ? std::optional(std::move(tally)) : std::nullopt;
}

}  // namespace lorica::shotline
