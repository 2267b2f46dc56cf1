#pragma once

/// \file
/// Shoots a posed scene and counts.

#include <algorithm>
#include <memory>
#include <mutex>
#include <vector>

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

/// Many shots of a trial in an order in which neighbours run through the same part of the scene. In which order shots
/// are traced changes no count. Keeps its buffers from one load to the next.
class CoherentBlock {
 public:
  /// Large blocks run more coherent rays, small ones take less memory (60 bytes a shot).
  static constexpr std::uint64_t mostShots = std::uint64_t{1} << 19;

  /// \pre range.count <= mostShots
  void load(const ShotGenerator& shots, const ShotRange& range, base::Threads threads);
  /// As many as keep all threads busy.
  std::size_t slices() const { return (placed_.size() + shotsPerSlice_ - 1) / shotsPerSlice_; }

 private:
  friend class CoherentSlice;
  struct Placed {
    raycast::Ray ray;
    std::uint32_t key;
    std::uint32_t number;  ///< after the first
  };
  std::uint64_t first_ = 0;
  std::size_t shotsPerSlice_ = 1;
  std::vector<raycast::Ray> rays_;
  std::vector<std::uint32_t> keys_;
  std::vector<std::uint32_t> starts_;  ///< where each part of the rays puts those of each bucket
  std::vector<Placed> placed_;         ///< in the order of the upper bits of their keys
};

/// A slice of a block in its full order: what one thread traces at a time. Keeps its buffers.
class CoherentSlice {
 public:
  /// \pre index < block.slices()
  void load(const CoherentBlock& block, std::size_t index);
  std::span<const raycast::Ray> rays() const { return rays_; }
  /// Number of the shot that ray `i` of rays() is.
  std::uint64_t number(std::size_t i) const { return numbers_[i]; }

 private:
  std::vector<raycast::Ray> rays_;
  std::vector<std::uint64_t> numbers_;
  std::vector<std::uint32_t> keys_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> scratch_;
};

/// Shows each shot of the range with all its hits to an observer and adds the observers of all threads up in `total`.
/// An Observer has `Observer fresh() const`, an empty one; `void see(shot, ray, hits)`; `void add(const Observer&)`.
/// Neither the order of the shots nor that of the additions may change its result. Memory does not grow with the number
/// of shots. \throw base::Cancelled
template <class Observer>
raycast::CastCounts observeShots(const raycast::Scene& scene, const ShotGenerator& shots, const ShotRange& range,
                                 base::Threads threads, const base::Progress& progress, Observer& total) {
  struct Worker {
    raycast::Caster caster;
    Observer observer;
    CoherentSlice slice;
  };
  std::vector<std::unique_ptr<Worker>> idle;
  std::mutex mutex;
  std::uint64_t done = 0;
  const auto take = [&] {
    const std::lock_guard lock(mutex);
    if (idle.empty()) {
      return std::make_unique<Worker>(Worker{raycast::Caster(scene), total.fresh(), {}});
    }
    std::unique_ptr<Worker> worker = std::move(idle.back());
    idle.pop_back();
    return worker;
  };
  const auto giveBack = [&](std::unique_ptr<Worker> worker) {
    const std::lock_guard lock(mutex);
    done += worker->slice.rays().size();
    progress.report(static_cast<double>(done) / static_cast<double>(range.count));
    idle.push_back(std::move(worker));
  };
  CoherentBlock block;
  for (std::uint64_t first = 0; first < range.count; first += CoherentBlock::mostShots) {
    progress.check();
    block.load(shots, {range.first + first, std::min(CoherentBlock::mostShots, range.count - first)}, threads);
    base::parallelFor(block.slices(), 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        progress.check();
        std::unique_ptr<Worker> worker = take();
        const CoherentSlice& slice = worker->slice;
        worker->slice.load(block, s);
        worker->caster.castMany(slice.rays(), [&](std::size_t i, std::span<const raycast::Hit> hits) {
          worker->observer.see(slice.number(i), slice.rays()[i], hits);
        });
        giveBack(std::move(worker));
      }
    });
  }
  raycast::CastCounts counts;
  for (const std::unique_ptr<Worker>& worker : idle) {
    total.add(worker->observer);
    counts.add(worker->caster.counts());
  }
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
