#pragma once

/// \file
/// Shoots a posed scene and counts.

#include <algorithm>
#include <mutex>

#include "lorica/base/error.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/raycast/caster.h"
#include "lorica/shotline/shot_generator.h"
#include "lorica/shotline/tally.h"

namespace lorica::shotline {

/// Shots of a trial, by their numbers.
struct ShotRange {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// Some shots of a trial in an order in which neighbours run through the same part of the scene. In which order shots
/// are traced changes no count. Keeps its buffers from one load to the next.
class CoherentBlock {
 public:
  /// \pre range.count < 2^32
  void load(const ShotGenerator& shots, const ShotRange& range);
  std::span<const raycast::Ray> rays() const { return sorted_; }
  /// Number of the shot that ray `i` of rays() is.
  std::uint64_t number(std::size_t i) const { return first_ + order_[i]; }

 private:
  std::uint64_t first_ = 0;
  std::vector<raycast::Ray> rays_;
  std::vector<raycast::Ray> sorted_;
  std::vector<std::uint32_t> keys_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> scratch_;
};

/// How many shots are traced in one go: large blocks run more coherent rays, small ones keep all threads busy.
std::uint64_t blockSize(std::uint64_t shots, base::Threads threads);

/// Shows each shot of the range with all its hits to an observer and adds the observers of all blocks up in `total`.
/// An Observer has `Observer fresh() const`, an empty one; `void see(shot, ray, hits)`; `void add(const Observer&)`,
/// whose result must not depend on the order of the additions. Memory does not grow with the number of shots.
/// \throw base::Cancelled
template <class Observer>
raycast::CastCounts observeShots(const raycast::Scene& scene, const ShotGenerator& shots, const ShotRange& range,
                                 base::Threads threads, const base::Progress& progress, Observer& total) {
  const std::uint64_t block = blockSize(range.count, threads);
  const std::uint64_t blocks = (range.count + block - 1) / block;
  raycast::CastCounts counts;
  std::mutex merging;
  std::uint64_t done = 0;
  base::parallelFor(blocks, 1, threads, [&](std::size_t begin, std::size_t end) {
    raycast::Caster caster(scene);
    Observer observer = total.fresh();
    CoherentBlock rays;
    for (std::uint64_t b = begin; b < end; ++b) {
      progress.check();
      rays.load(shots, {range.first + b * block, std::min(block, range.count - b * block)});
      caster.castMany(rays.rays(), [&](std::size_t i, std::span<const raycast::Hit> hits) {
        observer.see(rays.number(i), rays.rays()[i], hits);
      });
    }
    const std::lock_guard lock(merging);
    total.add(observer);
    counts.add(caster.counts());
    progress.report(static_cast<double>(done += end - begin) / static_cast<double>(blocks));
  });
  return counts;
}

/// Counts shots' crossings into a tally. One per thread.
class ShotCounter {
 public:
  /// \pre layout outlives the counter
  explicit ShotCounter(const TargetLayout& layout);

  /// \param hits of one shot in complete order, at a scene whose meshes stand as the layout says
  void count(std::span<const raycast::Hit> hits);
  const Tally& tally() const { return tally_; }

  ShotCounter fresh() const { return ShotCounter(*layout_); }
  void see(std::uint64_t /*shot*/, const raycast::Ray& /*ray*/, std::span<const raycast::Hit> hits) { count(hits); }
  void add(const ShotCounter& other) { tally_.add(other.tally_); }

 private:
  static constexpr std::uint32_t never = UINT32_MAX;
  struct Touched {
    std::uint32_t target;  ///< region, then piece, then organ slot
    std::uint32_t order;
  };

  void touch(std::uint32_t target, std::uint32_t order);
  void countSkin(const Touched& touched);
  void countPiece(std::uint32_t piece, std::uint32_t order);
  void countOrgan(std::uint32_t slot, std::uint32_t order);
  void touchClass(std::size_t slot, std::uint32_t order);
  void countClasses();

  const TargetLayout* layout_;
  Tally tally_;
  std::vector<char> seen_;  ///< per target, within one shot
  std::vector<Touched> touched_;
  std::vector<std::uint32_t> armorOrder_;       ///< per system, order of its first crossing
  std::vector<std::uint32_t> firstOrganOrder_;  ///< per model
  std::vector<std::uint32_t> firstClassOrder_;  ///< per model, then class
  std::uint32_t skinOrder_ = never;
};

struct TraceResult {
  Tally tally;
  raycast::CastCounts counts;
};

/// Traces a range of shots of a trial. The result does not depend on the number of threads, and those of ranges that
/// make up a whole add up to that of the whole; memory does not grow with the number of shots.
/// \pre scene is built and its meshes stand as the layout says
/// \throw base::Cancelled
TraceResult trace(const raycast::Scene& scene, const TargetLayout& layout, const ShotGenerator& shots,
                  const ShotRange& range, base::Threads threads, const base::Progress& progress = {});
/// Shots 0 to `count` - 1.
TraceResult trace(const raycast::Scene& scene, const TargetLayout& layout, const ShotGenerator& shots,
                  std::uint64_t count, base::Threads threads, const base::Progress& progress = {});

}  // namespace lorica::shotline
