#pragma once

/// \file
/// Where shots reach a structure, with and without armor before it: counts per triangle of the skin and of the
/// structure, the raw material of heat maps and of the search for gaps (lorica/shotline/open_patches.h).

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lorica/raycast/caster.h"
#include "lorica/shotline/tally.h"

namespace lorica::shotline {

/// Shots on the triangles of one surface. Unprotected shots are counted under each system.
struct SurfaceCounts {
  std::vector<std::uint64_t> hits;  ///< per triangle
  std::vector<std::uint64_t> open;  ///< system by system, per triangle

  std::span<const std::uint64_t> openUnder(std::size_t system) const {
    return std::span(open).subspan(system * hits.size(), hits.size());
  }
};

/// Counts of one watched structure. Whole numbers: shots may be added in any order.
struct GapCounts {
  /// Of the skin, where shots that reach the structure enter it: the last time from outside before the structure's
  /// first crossing, so that an arm in the way counts as what is before the trunk. For the body itself, its first
  /// crossing.
  SurfaceCounts skin;
  /// Of the structure, its first crossing; empty for the body.
  SurfaceCounts own;
  /// Sums of unit vectors against the unprotected shots of each skin triangle, in units of 2^-26: system by system,
  /// triangle by triangle, x y z.
  std::vector<std::int64_t> towards;
  /// Shots that reach the structure without entering the skin before: it stands out, or the shot starts inside.
  std::uint64_t offSkin = 0;
};

/// What is watched: the body (no organ), or an organ in one model.
struct WatchedStructure {
  std::optional<std::size_t> organ;
  std::size_t model = 0;
};

/// Observer of observeShots() that fills GapCounts. All observers of a run share one set of counts, added to
/// atomically, so memory grows neither with the shots nor with the threads, and the sums depend on neither.
class GapCounter {
 public:
  static constexpr double directionUnit = 67108864.0;

  /// \pre scene and layout outlive the counter, and the scene's meshes stand as the layout says
  GapCounter(const raycast::Scene& scene, const TargetLayout& layout, std::span<const WatchedStructure> watched);

  GapCounter fresh() const { return *this; }
  void see(std::uint64_t shot, const raycast::Ray& ray, std::span<const raycast::Hit> hits);
  void add(const GapCounter& /*other*/) {}
  /// One per watched structure. \pre no shots are being observed
  const std::vector<GapCounts>& counts() const { return *counts_; }
  /// Per triangle of the skin, shots that enter it from outside through that one, whatever they reach; a shot may enter
  /// more than once. \pre no shots are being observed
  const std::vector<std::uint64_t>& entries() const { return *entries_; }

 private:
  struct Crossing {
    std::optional<std::uint32_t> skinTriangle;
    std::optional<std::uint32_t> ownTriangle;
  };
  void record(std::size_t watched, const raycast::Ray& ray, const Crossing& crossing);

  static constexpr std::uint32_t none = UINT32_MAX;
  const raycast::MeshTopology* skin_;
  const TargetLayout* layout_;
  std::shared_ptr<std::vector<GapCounts>> counts_;
  std::shared_ptr<std::vector<std::uint64_t>> entries_;
  std::vector<std::uint32_t> watchedOfMesh_;  ///< per mesh; none for those that are not watched
  std::vector<char> seen_;                    ///< per watched structure, within one shot
  std::vector<char> armored_;                 ///< per system, within one shot
};

}  // namespace lorica::shotline
