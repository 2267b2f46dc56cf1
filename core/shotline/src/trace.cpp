#include "lorica/shotline/trace.h"

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <numeric>

#include "lorica/base/error.h"

namespace lorica::shotline {

using geometry::Vec3f;

ShotCounter::ShotCounter(const TargetLayout& layout)
    : layout_(&layout),
      tally_(layout),
      seen_(layout.regions + layout.pieces() + layout.organs * layout.models, 0),
      armorOrder_(layout.systems, never),
      firstOrganOrder_(layout.models, never) {}

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
        std::uint32_t& first = firstOrganOrder_[(hit.mesh - 1 - pieces) / layout_->organs];
        first = std::min(first, order);
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
  touched_.clear();
  std::fill(armorOrder_.begin(), armorOrder_.end(), never);
  std::fill(firstOrganOrder_.begin(), firstOrganOrder_.end(), never);
  skinOrder_ = never;
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

namespace {

/// Spreads the low 10 bits to every second place.
std::uint32_t spread(std::uint32_t v) {
  v = (v | (v << 8U)) & 0x00FF00FFU;
  v = (v | (v << 4U)) & 0x0F0F0F0FU;
  v = (v | (v << 2U)) & 0x33333333U;
  return (v | (v << 1U)) & 0x55555555U;
}

/// Buffers of one block of shots.
struct Block {
  std::vector<raycast::Ray> rays;
  std::vector<raycast::Ray> sorted;
  std::vector<std::uint32_t> keys;
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> scratch;
};

/// One stable pass of a radix sort: by 11 bits of the keys, from `shift` up.
void radixPass(const std::vector<std::uint32_t>& keys, const std::vector<std::uint32_t>& from,
               std::vector<std::uint32_t>& to, unsigned shift) {
  constexpr std::uint32_t buckets = 2048;
  std::array<std::uint32_t, buckets + 1> start{};
  for (const std::uint32_t i : from) {
    ++start[((keys[i] >> shift) & (buckets - 1)) + 1];
  }
  for (std::size_t b = 0; b < buckets; ++b) {
    start[b + 1] += start[b];
  }
  for (const std::uint32_t i : from) {
    to[start[(keys[i] >> shift) & (buckets - 1)]++] = i;
  }
}

/// Puts rays in an order in which neighbours run through the same part of the scene: by what of the narrowest axis
/// they fall into, then in Morton order along the other two. Which order shots are traced in changes no count.
void sortForCoherence(Block& block) {
  Vec3f low = Vec3f::Constant(std::numeric_limits<float>::infinity());
  Vec3f high = -low;
  for (const raycast::Ray& ray : block.rays) {
    low = low.cwiseMin(ray.direction);
    high = high.cwiseMax(ray.direction);
  }
  Eigen::Index narrow = 0;
  const Vec3f span = (high - low).cwiseMax(1e-30F);
  span.minCoeff(&narrow);
  const Eigen::Index u = (narrow + 1) % 3;
  const Eigen::Index v = (narrow + 2) % 3;
  Vec3f steps = Vec3f::Constant(1023.0F);
  steps[narrow] = 3.0F;
  const Vec3f scale = steps.cwiseQuotient(span);
  const std::size_t count = block.rays.size();
  block.keys.resize(count);
  block.order.resize(count);
  block.scratch.resize(count);
  block.sorted.resize(count);
  std::iota(block.scratch.begin(), block.scratch.end(), 0U);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f cell = (block.rays[i].direction - low).cwiseProduct(scale);
    block.keys[i] = spread(static_cast<std::uint32_t>(cell[u])) | (spread(static_cast<std::uint32_t>(cell[v])) << 1U) |
                    (static_cast<std::uint32_t>(cell[narrow]) << 20U);
  }
  radixPass(block.keys, block.scratch, block.order, 0);
  radixPass(block.keys, block.order, block.scratch, 11);
  for (std::size_t i = 0; i < count; ++i) {
    block.sorted[i] = block.rays[block.scratch[i]];
  }
}

}  // namespace

TraceResult trace(const raycast::Scene& scene, const TargetLayout& layout, const ShotGenerator& shots,
                  std::uint64_t count, base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(scene.meshes() == layout.meshes(), "the scene's meshes stand as the layout says");
  // Large blocks run more coherent rays, small ones keep all threads busy to the end.
  const auto crew = static_cast<std::uint64_t>(threads.count > 0 ? threads.count : base::machineThreads());
  const std::uint64_t block = std::clamp<std::uint64_t>(count / (8 * crew), 1024, 65536);
  const std::uint64_t blocks = (count + block - 1) / block;
  TraceResult result{Tally(layout), {}};
  std::mutex merging;
  std::uint64_t done = 0;
  base::parallelFor(blocks, 1, threads, [&](std::size_t begin, std::size_t end) {
    raycast::Caster caster(scene);
    ShotCounter counter(layout);
    Block buffers;
    for (std::size_t b = begin; b < end; ++b) {
      progress.check();
      buffers.rays.clear();
      for (std::uint64_t shot = b * block; shot < std::min(count, (b + 1) * block); ++shot) {
        buffers.rays.push_back(shots.shot(shot));
      }
      sortForCoherence(buffers);
      caster.castMany(buffers.sorted, [&](std::size_t, std::span<const raycast::Hit> hits) { counter.count(hits); });
    }
    const std::lock_guard lock(merging);
    result.tally.add(counter.tally());
    result.counts.add(caster.counts());
    progress.report(static_cast<double>(done += end - begin) / static_cast<double>(blocks));
  });
  return result;
}

}  // namespace lorica::shotline
