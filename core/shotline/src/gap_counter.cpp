#include "lorica/shotline/gap_counter.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "lorica/base/error.h"

namespace lorica::shotline {

namespace {

template <class Number>
void addShared(Number& sum, Number more) {
  std::atomic_ref<Number>(sum).fetch_add(more, std::memory_order_relaxed);
}

SurfaceCounts emptyCounts(std::size_t triangles, std::size_t systems) {
  return {std::vector<std::uint64_t>(triangles), std::vector<std::uint64_t>(triangles * systems)};
}

}  // namespace

GapCounter::GapCounter(const raycast::Scene& scene, const TargetLayout& layout,
                       std::span<const WatchedStructure> watched)
    : skin_(&scene.topology(raycast::MeshIndex{0})),
      layout_(&layout),
      counts_(std::make_shared<std::vector<GapCounts>>()),
      entries_(std::make_shared<std::vector<std::uint64_t>>(skin_->triangles.size())),
      watchedOfMesh_(layout.meshes(), none),
      seen_(watched.size(), 0),
      armored_(layout.systems, 0) {
  LORICA_CHECK(scene.meshes() == layout.meshes(), "the scene's meshes stand as the layout says");
  const std::size_t skinTriangles = skin_->triangles.size();
  for (const WatchedStructure& structure : watched) {
    const std::size_t mesh =
        structure.organ ? 1 + layout.pieces() + structure.model * layout.organs + *structure.organ : 0;
    LORICA_CHECK(mesh < layout.meshes() && watchedOfMesh_[mesh] == none, "each structure is watched once");
    watchedOfMesh_[mesh] = static_cast<std::uint32_t>(counts_->size());
    GapCounts counts;
    counts.skin = emptyCounts(skinTriangles, layout.systems);
    counts.towards.resize(3 * skinTriangles * layout.systems);
    if (structure.organ) {
      counts.own = emptyCounts(scene.topology(raycast::MeshIndex{mesh}).triangles.size(), layout.systems);
    }
    counts_->push_back(std::move(counts));
  }
}

void GapCounter::see(std::uint64_t /*shot*/, const raycast::Ray& ray, std::span<const raycast::Hit> hits) {
  if (hits.empty()) {
    return;
  }
  const auto closedSkin = [&](const raycast::Hit& hit) { return hit.mesh == 0 && skin_->closed[hit.component]; };
  // A shot has no end: what it leaves more often than it enters, it starts in.
  int winding = 0;
  for (const raycast::Hit& hit : hits) {
    winding -= closedSkin(hit) ? hit.sign() : 0;
  }
  const auto pieces = static_cast<std::uint32_t>(layout_->pieces());
  Crossing crossing;
  for (const raycast::Hit& hit : hits) {
    if (hit.mesh > 0 && hit.mesh <= pieces) {
      armored_[layout_->pieceSystem[hit.mesh - 1]] = 1;
      continue;
    }
    const std::uint32_t watched = watchedOfMesh_[hit.mesh];
    if (hit.mesh == 0) {
      const int before = winding;
      winding += closedSkin(hit) ? hit.sign() : 0;
      if (!closedSkin(hit) || before == 0) {
        crossing.skinTriangle = hit.triangle;
        addShared<std::uint64_t>((*entries_)[hit.triangle], 1);
      }
      if (watched != none && seen_[watched] == 0) {
        seen_[watched] = 1;
        record(watched, ray, {hit.triangle, std::nullopt});
      }
    } else if (watched != none && seen_[watched] == 0) {
      seen_[watched] = 1;
      crossing.ownTriangle = hit.triangle;
      record(watched, ray, crossing);
    }
  }
  std::fill(seen_.begin(), seen_.end(), 0);
  std::fill(armored_.begin(), armored_.end(), 0);
}

void GapCounter::record(std::size_t watched, const raycast::Ray& ray, const Crossing& crossing) {
  GapCounts& counts = (*counts_)[watched];
  const auto addTo = [&](SurfaceCounts& surface, std::uint32_t triangle) {
    addShared<std::uint64_t>(surface.hits[triangle], 1);
    for (std::size_t s = 0; s < layout_->systems; ++s) {
      if (armored_[s] == 0) {
        addShared<std::uint64_t>(surface.open[s * surface.hits.size() + triangle], 1);
      }
    }
  };
  if (crossing.ownTriangle) {
    addTo(counts.own, *crossing.ownTriangle);
  }
  if (!crossing.skinTriangle) {
    addShared<std::uint64_t>(counts.offSkin, 1);
    return;
  }
  addTo(counts.skin, *crossing.skinTriangle);
  const geometry::Vec3d towards = -ray.direction.cast<double>().normalized() * directionUnit;
  for (std::size_t s = 0; s < layout_->systems; ++s) {
    std::int64_t* sums = &counts.towards[3 * (s * counts.skin.hits.size() + *crossing.skinTriangle)];
    for (int k = 0; armored_[s] == 0 && k < 3; ++k) {
      addShared<std::int64_t>(sums[k], std::llround(towards[k]));
    }
  }
}

}  // namespace lorica::shotline
