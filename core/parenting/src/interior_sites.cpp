#include "lorica/parenting/interior_sites.h"

#include <atomic>
#include <limits>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::parenting {

using geometry::RigidTransform;
using geometry::Vec3d;

namespace {

std::vector<Vec3d> gridPoints(const geometry::Box3d& box, double spacing) {
  std::vector<Vec3d> points;
  if (box.isEmpty()) {
    return points;
  }
  // Centred in the box, so that a body and its mirror image get mirrored sites.
  std::array<int, 3> count{};
  Vec3d start;
  double total = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = std::max(1.0, std::floor(box.sizes()[axis] / spacing));
    total *= cells;
    LORICA_CHECK(total <= 1e8, "a grid of at most 1e8 sites; take a wider spacing");
    count[static_cast<std::size_t>(axis)] = static_cast<int>(cells);
    start[axis] = box.center()[axis] - 0.5 * (cells - 1.0) * spacing;
  }
  for (int j = 0; j < count[1]; ++j) {
    for (int k = 0; k < count[2]; ++k) {
      for (int i = 0; i < count[0]; ++i) {
        points.emplace_back(start + spacing * Vec3d(i, j, k));
      }
    }
  }
  return points;
}

}  // namespace

InteriorSites placeInteriorSites(const raycast::Scene& scene, raycast::MeshIndex skinMesh, double spacing,
                                 const ParentingOptions& options, base::Threads threads,
                                 const base::Progress& progress) {
  LORICA_CHECK(spacing > 0.0, "a spacing in metres");
  const std::span restSkin(scene.positions(skinMesh), scene.topology(skinMesh).vertices);
  const std::vector<Vec3d> points = gridPoints(geometry::bounds(restSkin), spacing);
  std::vector<SiteBinding> bound(points.size());
  std::vector<char> inside(points.size(), 0);
  std::atomic<std::size_t> done{0};
  base::parallelFor(points.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    progress.check();
    raycast::Caster caster(scene);
    for (std::size_t i = begin; i < end; ++i) {
      inside[i] = raycast::windingNumber(caster, skinMesh, points[i]) >= 1 ? 1 : 0;
      if (inside[i] != 0) {
        bound[i] = bindToSkin(points[i], caster, scene, skinMesh, options);
      }
    }
    progress.report(static_cast<double>(done += end - begin) / static_cast<double>(points.size()));
  });
  InteriorSites result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (bound[i].site) {
      result.sites.push_back(std::move(*bound[i].site));
    } else {
      result.unbound += inside[i] != 0 ? 1 : 0;
    }
  }
  return result;
}

SiteMotion carrySites(const std::vector<SkinSite>& sites, std::span<const geometry::Triangle> triangles,
                      std::span<const geometry::Vec3f> posedSkin, base::Threads threads) {
  SiteMotion motion;
  motion.carry.resize(sites.size());
  std::vector<char> sound(sites.size(), 1);
  base::parallelFor(sites.size(), 512, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto carried = carry(sites[i], triangles, posedSkin);
      sound[i] = carried ? 1 : 0;
      motion.carry[i] = carried.value_or(RigidTransform{});
    }
  });
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (sound[i] != 0) {
      continue;
    }
    motion.collapsed.push_back(static_cast<std::uint32_t>(i));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < sites.size(); ++other) {
      const double distance = (sites[other].rest - sites[i].rest).squaredNorm();
      if (sound[other] != 0 && distance < nearest) {
        nearest = distance;
        motion.carry[i] = motion.carry[other];
      }
    }
  }
  return motion;
}

std::size_t nearestSite(const std::vector<SkinSite>& sites, const Vec3d& point) {
  LORICA_CHECK(!sites.empty(), "there is a site");
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < sites.size(); ++i) {
    if ((sites[i].rest - point).squaredNorm() < (sites[nearest].rest - point).squaredNorm()) {
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace lorica::parenting
