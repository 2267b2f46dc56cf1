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

}  // namespace lorica::shotline
