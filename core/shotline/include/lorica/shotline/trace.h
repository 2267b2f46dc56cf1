#pragma once

/// \file
/// Shoots a posed scene and counts.

#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/raycast/caster.h"
#include "lorica/shotline/point_source.h"
#include "lorica/shotline/tally.h"

namespace lorica::shotline {

/// Counts one shot's crossings into a tally. One per thread.
class ShotCounter {
 public:
  /// \pre layout outlives the counter
  explicit ShotCounter(const TargetLayout& layout);

  /// \param hits of one shot in complete order, at a scene whose meshes stand as the layout says
  void count(std::span<const raycast::Hit> hits);
  const Tally& tally() const { return tally_; }

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

  const TargetLayout* layout_;
  Tally tally_;
  std::vector<char> seen_;  ///< per target, within one shot
  std::vector<Touched> touched_;
  std::vector<std::uint32_t> armorOrder_;       ///< per system, order of its first crossing
  std::vector<std::uint32_t> firstOrganOrder_;  ///< per model
  std::uint32_t skinOrder_ = never;
};

struct TraceResult {
  Tally tally;
  raycast::CastCounts counts;
};

/// Traces shots 0 to `shots` - 1 of a trial. Result does not depend on the number of threads; memory does not grow with
/// the number of shots.
/// \pre scene is built and its meshes stand as the layout says
/// \throw base::Cancelled
TraceResult trace(const raycast::Scene& scene, const TargetLayout& layout, const ShotGenerator& shots,
                  std::uint64_t count, base::Threads threads, const base::Progress& progress = {});

}  // namespace lorica::shotline
