#include "lorica/shotline/open_patches.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "lorica/base/error.h"
#include "lorica/stats/intervals.h"

namespace lorica::shotline {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

/// Expected shots from which on a triangle that has none is one that cannot be reached: exp(-3) is a twentieth.
constexpr double missedForCertain = 3.0;

/// The middle of a half disk lies this share of its radius off the middle of the disk: shots around a place lie so far
/// off when it is at a straight rim of what they reach, and nearer when it is within.
constexpr double rimOffset = 0.4244;

struct Pool {
  std::uint64_t hits = 0;
  std::uint64_t open = 0;
  std::uint64_t through = 0;
  double area = 0.0;
  double radius = 0.0;           ///< of the farthest middle
  Vec3d offset = Vec3d::Zero();  ///< sum over the shots, from the seed's middle
};

/// The triangles of a mesh with their counts, and who is beside whom.
class Surface {
 public:
  Surface(const raycast::MeshTopology& mesh, std::span<const Vec3f> positions, std::span<const std::uint64_t> hits,
          std::span<const std::uint64_t> open, std::span<const std::uint64_t> through)
      : mesh_(mesh), hits_(hits), open_(open), through_(through), visited_(mesh.triangles.size(), 0) {
    for (const geometry::Triangle& corners : mesh.triangles) {
      const Vec3d a = positions[corners[0]].cast<double>();
      const Vec3d b = positions[corners[1]].cast<double>();
      const Vec3d c = positions[corners[2]].cast<double>();
      middles_.emplace_back((a + b + c) / 3.0);
      areas_.push_back(0.5 * (b - a).cross(c - a).norm());
    }
  }

  std::size_t size() const { return areas_.size(); }
  double area(std::uint32_t t) const { return areas_[t]; }
  const Vec3d& middle(std::uint32_t t) const { return middles_[t]; }
  std::uint64_t hits(std::uint32_t t) const { return hits_[t]; }
  std::uint64_t open(std::uint32_t t) const { return open_[t]; }
  std::uint64_t through(std::uint32_t t) const { return through_[t]; }

  /// Calls `use` for every triangle that has a corner in common with `t`, itself among them.
  template <class Use>
  void forNeighbours(std::uint32_t t, const Use& use) const {
    for (const std::uint32_t corner : mesh_.triangles[t]) {
      for (std::uint32_t i = mesh_.ringStart[corner]; i < mesh_.ringStart[corner + 1]; ++i) {
        use(mesh_.ring[i]);
      }
    }
  }

  /// The triangle and the rings around it until they hold enough shots; nothing when they never do.
  std::optional<Pool> pool(std::uint32_t seed, const PatchRule& rule) {
    Pool made;
    made.hits = hits_[seed];
    made.open = open_[seed];
    made.through = through_[seed];
    made.area = areas_[seed];
    ++stamp_;
    visited_[seed] = stamp_;
    ring_.assign(1, seed);
    while (made.hits < rule.minShots && !ring_.empty()) {
      next_.clear();
      for (const std::uint32_t t : ring_) {
        forNeighbours(t, [&](std::uint32_t near) {
          const Vec3d offset = middles_[near] - middles_[seed];
          const double distance = offset.norm();
          if (visited_[near] != stamp_ && distance <= rule.radius) {
            visited_[near] = stamp_;
            next_.push_back(near);
            made.radius = std::max(made.radius, distance);
            made.offset += static_cast<double>(hits_[near]) * offset;
            made.hits += hits_[near];
            made.open += open_[near];
            made.through += through_[near];
            made.area += areas_[near];
          }
        });
      }
      ring_.swap(next_);
    }
    return made.hits < rule.minShots ? std::nullopt : std::optional(made);
  }

 private:
  const raycast::MeshTopology& mesh_;
  std::span<const std::uint64_t> hits_;
  std::span<const std::uint64_t> open_;
  std::span<const std::uint64_t> through_;
  std::vector<Vec3d> middles_;
  std::vector<double> areas_;
  std::vector<std::uint32_t> visited_;  ///< the last walk that came by
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> ring_;
  std::vector<std::uint32_t> next_;
};

bool surelyOpen(std::uint64_t open, std::uint64_t hits, const PatchRule& rule) {
  return hits >= rule.minShots && stats::wilson(open, hits).low > rule.openShare;
}

/// Whether a triangle without a shot was missed by chance alone: few were to be expected, and they lie all around.
bool missedByChance(const Pool& pool, double area) {
  const auto shots = static_cast<double>(pool.hits);
  return shots * area < missedForCertain * pool.area && pool.offset.norm() < rimOffset * pool.radius * shots;
}

/// Of each triangle the share of it that is open; nothing for triangles of no patch.
std::vector<std::optional<double>> openShares(Surface& surface, const PatchRule& rule) {
  geometry::Box3d reach;
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    if (surface.open(t) > 0) {
      reach.extend(surface.middle(t));
    }
  }
  std::vector<std::optional<double>> shares(surface.size());
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    if (reach.isEmpty() || reach.exteriorDistance(surface.middle(t)) > rule.radius) {
      continue;
    }
    const std::optional<Pool> pool = surface.pool(t, rule);
    if (!pool || !surelyOpen(pool->open, pool->hits, rule)) {
      continue;
    }
    if (surface.hits(t) > 0) {
      shares[t] = static_cast<double>(surface.open(t)) / static_cast<double>(surface.through(t));
    } else if (surface.through(t) == 0 && missedByChance(*pool, surface.area(t))) {
      shares[t] = static_cast<double>(pool->open) / static_cast<double>(pool->through);
    }
  }
  return shares;
}

OpenPatch measure(const Surface& surface, std::vector<std::uint32_t> triangles,
                  const std::vector<std::optional<double>>& shares) {
  OpenPatch patch;
  std::sort(triangles.begin(), triangles.end());
  patch.triangles = std::move(triangles);
  for (const std::uint32_t t : patch.triangles) {
    const double area = surface.area(t) * *shares[t];
    patch.area += area;
    patch.extent += surface.area(t);
    patch.centre += area * surface.middle(t);
    patch.hits += surface.hits(t);
    patch.open += surface.open(t);
  }
  patch.centre /= patch.area > 0.0 ? patch.area : 1.0;
  return patch;
}

}  // namespace

std::vector<OpenPatch> openPatches(const raycast::MeshTopology& mesh, std::span<const Vec3f> positions,
                                   std::span<const std::uint64_t> hits, std::span<const std::uint64_t> open,
                                   const PatchRule& rule, std::span<const std::uint64_t> through) {
  LORICA_CHECK(through.empty() || through.size() == hits.size(), "a count of all shots per triangle, or none");
  LORICA_CHECK(positions.size() == mesh.vertices && hits.size() == mesh.triangles.size() &&
                   open.size() == mesh.triangles.size() && rule.minShots > 0,
               "a position per vertex and counts per triangle");
  Surface surface(mesh, positions, hits, open, through.empty() ? hits : through);
  const std::vector<std::optional<double>> shares = openShares(surface, rule);
  std::vector<OpenPatch> patches;
  std::vector<bool> taken(surface.size(), false);
  for (std::uint32_t seed = 0; seed < surface.size(); ++seed) {
    if (taken[seed] || !shares[seed]) {
      continue;
    }
    std::vector<std::uint32_t> triangles{seed};
    taken[seed] = true;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      surface.forNeighbours(triangles[i], [&](std::uint32_t near) {
        if (!taken[near] && shares[near]) {
          taken[near] = true;
          triangles.push_back(near);
        }
      });
    }
    OpenPatch patch = measure(surface, std::move(triangles), shares);
    if (surelyOpen(patch.open, patch.hits, rule)) {
      patches.push_back(std::move(patch));
    }
  }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const OpenPatch& a, const OpenPatch& b) { return a.area > b.area; });
  return patches;
}

}  // namespace lorica::shotline
