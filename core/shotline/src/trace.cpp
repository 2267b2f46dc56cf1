#include "lorica/shotline/trace.h"

#include <algorithm>

namespace lorica::shotline {

ShotCounter::ShotCounter(const TargetLayout& layout)
    : layout_(&layout),
      tally_(layout),
      seen_(layout.regions + layout.pieces() + layout.organs * layout.models, 0),
      armorOrder_(layout.systems, never),
      firstOrganOrder_(layout.models, never),
      firstClassOrder_(layout.models * layout.classes, never) {}

void ShotCounter::touch(std::uint32_t target, std::uint32_t order) {
  if (seen_[target] == 0) {
    seen_[target] = 1;
    touched_.push_back({target, order});
  }
}

void ShotCounter::count(std::span<const raycast::Hit> hits) {
  ++tally_.shots_;
  if (hits.empty()) {
    return;
  }
  const auto regions = static_cast<std::uint32_t>(layout_->regions);
  const auto pieces = static_cast<std::uint32_t>(layout_->pieces());
  for (std::uint32_t order = 0; order < hits.size(); ++order) {
    const raycast::Hit& hit = hits[order];
    if (hit.mesh == 0) {
      skinOrder_ = std::min(skinOrder_, order);
      touch(layout_->regionOfTriangle[hit.triangle], order);
    } else {
      touch(regions + hit.mesh - 1, order);
      if (hit.mesh <= pieces) {
        std::uint32_t& first = armorOrder_[layout_->pieceSystem[hit.mesh - 1]];
        first = std::min(first, order);
      } else {
        const std::size_t slot = hit.mesh - 1 - pieces;
        std::uint32_t& first = firstOrganOrder_[slot / layout_->organs];
        first = std::min(first, order);
        if (layout_->classes > 0) {
          touchClass(slot, order);
        }
      }
    }
  }
  if (skinOrder_ != never) {
    ++tally_.body_.any;
    for (std::size_t s = 0; s < layout_->systems; ++s) {
      tally_.bodyShielded_[s] += armorOrder_[s] < skinOrder_ ? 1 : 0;
    }
  }
  const std::uint64_t body = skinOrder_ != never ? 1 : 0;
  for (std::size_t s = 0; s < layout_->systems; ++s) {
    if (armorOrder_[s] != never) {
      Count& any = tally_.anyArmor_[s];
      ++any.any;
      any.first += armorOrder_[s] < skinOrder_ ? 1 : 0;
      any.withBody += body;
    }
    for (std::size_t m = 0; m < layout_->models; ++m) {
      if (firstOrganOrder_[m] != never) {
        Count& any = tally_.anyOrgan_[m * layout_->systems + s];
        ++any.any;
        ++any.first;
        any.shielded += armorOrder_[s] < firstOrganOrder_[m] ? 1 : 0;
        any.withBody += body;
      }
    }
  }
  for (const Touched& touched : touched_) {
    seen_[touched.target] = 0;
    if (touched.target < regions) {
      countSkin(touched);
    } else if (touched.target < regions + pieces) {
      countPiece(touched.target - regions, touched.order);
    } else {
      countOrgan(touched.target - regions - pieces, touched.order);
    }
  }
  countClasses();
  touched_.clear();
  std::fill(armorOrder_.begin(), armorOrder_.end(), never);
  std::fill(firstOrganOrder_.begin(), firstOrganOrder_.end(), never);
  skinOrder_ = never;
}

void ShotCounter::touchClass(std::size_t slot, std::uint32_t order) {
  const std::uint32_t organClass = layout_->organClass[slot % layout_->organs];
  if (organClass > 0) {
    std::uint32_t& first = firstClassOrder_[slot / layout_->organs * layout_->classes + organClass - 1];
    first = std::min(first, order);
  }
}

void ShotCounter::countClasses() {
  for (std::size_t c = 0; c < firstClassOrder_.size(); ++c) {
    const std::uint32_t order = firstClassOrder_[c];
    if (order == never) {
      continue;
    }
    for (std::size_t s = 0; s < layout_->systems; ++s) {
      Count& count = tally_.classes_[c * layout_->systems + s];
      ++count.any;
      count.first += firstOrganOrder_[c / layout_->classes] == order ? 1 : 0;
      count.withBody += skinOrder_ != never ? 1 : 0;
      count.shielded += armorOrder_[s] < order ? 1 : 0;
    }
    firstClassOrder_[c] = never;
  }
}

void ShotCounter::countSkin(const Touched& touched) {
  for (std::size_t s = 0; s < layout_->systems; ++s) {
    Count& count = tally_.regions_[touched.target * layout_->systems + s];
    const bool shielded = armorOrder_[s] < touched.order;
    ++count.any;
    ++count.withBody;
    count.shielded += shielded ? 1 : 0;
    count.first += !shielded && touched.order == skinOrder_ ? 1 : 0;
  }
}

void ShotCounter::countPiece(std::uint32_t piece, std::uint32_t order) {
  Count& count = tally_.pieces_[piece];
  ++count.any;
  count.withBody += skinOrder_ != never ? 1 : 0;
  count.first += order < skinOrder_ ? 1 : 0;
  count.shielded += armorOrder_[layout_->pieceSystem[piece]] < order ? 1 : 0;
}

void ShotCounter::countOrgan(std::uint32_t slot, std::uint32_t order) {
  const bool first = firstOrganOrder_[slot / layout_->organs] == order;
  for (std::size_t s = 0; s < layout_->systems; ++s) {
    Count& count = tally_.organs_[slot * layout_->systems + s];
    ++count.any;
    count.first += first ? 1 : 0;
    count.withBody += skinOrder_ != never ? 1 : 0;
    count.shielded += armorOrder_[s] < order ? 1 : 0;
  }
}

TraceResult trace(const raycast::Scene& scene, const TargetLayout& layout, const ShotGenerator& shots,
                  const ShotRange& range, base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(scene.meshes() == layout.meshes(), "the scene's meshes stand as the layout says");
  ShotCounter total(layout);
  const raycast::CastCounts counts = observeShots(scene, shots, range, threads, progress, total);
  return {total.tally(), counts};
}

TraceResult trace(const raycast::Scene& scene, const TargetLayout& layout, const ShotGenerator& shots,
                  std::uint64_t count, base::Threads threads, const base::Progress& progress) {
  return trace(scene, layout, shots, ShotRange{0, count}, threads, progress);
}

}  // namespace lorica::shotline
