#include "audit_columns.h"

#include <algorithm>
#include <cmath>

namespace lorica::viscera {

using geometry::Triangle;
using geometry::Vec3d;
using geometry::Vec3f;

namespace {

/// Cells of one grid that the shadow of the organ may touch. Columns stand at (origin + index) * spacing.
struct ShadowMask {
  std::array<double, 2> origin{};  ///< metres, of column (0, 0)
  std::array<std::size_t, 2> size{};
  std::vector<char> touched;
};

std::array<int, 2> across(int axis) {
  return {(axis + 1) % 3, (axis + 2) % 3};
}

ShadowMask shadow(const AuditMesh& organ, const ColumnPlan& plan, const std::array<double, 2>& shift) {
  const std::array<int, 2> side = across(plan.axis);
  ShadowMask mask;
  for (std::size_t s = 0; s < 2; ++s) {
    mask.origin[s] = organ.box.min()[side[s]] + shift[s] * plan.spacing;
    const double room = organ.box.max()[side[s]] - mask.origin[s];
    mask.size[s] = room < 0.0 ? 0 : static_cast<std::size_t>(room / plan.spacing) + 1;
  }
  mask.touched.assign(mask.size[0] * mask.size[1], 0);
  for (std::size_t t = 0; t < organ.topology->triangles.size(); ++t) {
    if (!organ.closed(t)) {
      continue;
    }
    std::array<std::size_t, 2> from{};
    std::array<std::size_t, 2> to{};
    for (std::size_t s = 0; s < 2; ++s) {
      const Triangle& corner = organ.topology->triangles[t];
      const auto [low, high] = std::minmax({organ.positions[corner[0]][side[s]], organ.positions[corner[1]][side[s]],
                                            organ.positions[corner[2]][side[s]]});
      // A little wider than the triangle: the rays are rounded to float.
      const double first = std::ceil((static_cast<double>(low) - mask.origin[s]) / plan.spacing - 1e-3);
      const double past = std::floor((static_cast<double>(high) - mask.origin[s]) / plan.spacing + 1e-3) + 1.0;
      from[s] = static_cast<std::size_t>(std::clamp(first, 0.0, static_cast<double>(mask.size[s])));
      to[s] = static_cast<std::size_t>(std::clamp(past, 0.0, static_cast<double>(mask.size[s])));
    }
    for (std::size_t j = from[1]; j < to[1]; ++j) {
      for (std::size_t i = from[0]; i < to[0]; ++i) {
        mask.touched[i + mask.size[0] * j] = 1;
      }
    }
  }
  return mask;
}

/// One mesh that a column crosses.
struct Crossed {
  explicit Crossed(const AuditMesh& crossed) : mesh(&crossed), caster(crossed.scene) {}

  const std::vector<Interval>& along(const raycast::Ray& ray) {
    insideIntervals(caster.cast(ray), *mesh->topology, intervals);
    return intervals;
  }
  /// Whether the ray can meet the mesh at all.
  bool mayMeet(const Vec3f& origin, const std::array<int, 2>& side) const {
    return std::all_of(side.begin(), side.end(), [&](int s) {
      const double at = static_cast<double>(origin[s]);
      return at >= mesh->box.min()[s] && at <= mesh->box.max()[s];
    });
  }

  const AuditMesh* mesh;
  raycast::Caster caster;
  std::vector<Interval> intervals;
};

}  // namespace

ColumnPlan planColumns(const AuditMesh& organ, std::size_t columns) {
  Vec3d silhouette = Vec3d::Zero();
  for (std::size_t t = 0; t < organ.topology->triangles.size(); ++t) {
    if (!organ.closed(t)) {
      continue;
    }
    const Triangle& corner = organ.topology->triangles[t];
    const Vec3d a = organ.positions[corner[0]].cast<double>();
    const Vec3d normal =
        (organ.positions[corner[1]].cast<double>() - a).cross(organ.positions[corner[2]].cast<double>() - a);
    // Half the parallelogram's, and half again because every column meets the organ going in and coming out.
    silhouette += normal.cwiseAbs() / 4.0;
  }
  ColumnPlan plan;
  const double least = silhouette.minCoeff(&plan.axis);
  if (!(least > 0.0)) {
    return plan;
  }
  // A long, thin organ across the axes shows little and spans much: the mask of its columns stays within memory.
  constexpr double mostColumns = 4e6;
  const std::array<int, 2> side = across(plan.axis);
  const Vec3d size = organ.box.sizes();
  plan.spacing = std::sqrt(std::max(least / static_cast<double>(columns), size[side[0]] * size[side[1]] / mostColumns));
  return plan;
}

ColumnSums sumColumns(const AuditMesh& organ, const AuditMesh* skin, const std::vector<const AuditMesh*>& partners,
                      const ColumnPlan& plan, const std::array<double, 2>& shift) {
  ColumnSums sums;
  sums.overlapped.assign(partners.size(), 0.0);
  if (plan.spacing == 0.0) {
    return sums;
  }
  const std::array<int, 2> side = across(plan.axis);
  const ShadowMask mask = shadow(organ, plan, shift);
  Crossed self(organ);
  std::optional<Crossed> around;
  geometry::Box3d all = organ.box;
  if (skin != nullptr) {
    around.emplace(*skin);
    all.extend(skin->box);
  }
  std::vector<Crossed> others;
  others.reserve(partners.size());
  for (const AuditMesh* partner : partners) {
    others.emplace_back(*partner);
    all.extend(partner->box);
  }

  raycast::Ray ray{Vec3f::Zero(), Vec3f::Unit(plan.axis)};
  // Rays start outside everything they meet.
  ray.origin[plan.axis] = static_cast<float>(all.min()[plan.axis] - 0.01 * (1.0 + all.diagonal().norm()));
  for (std::size_t j = 0; j < mask.size[1]; ++j) {
    for (std::size_t i = 0; i < mask.size[0]; ++i) {
      if (mask.touched[i + mask.size[0] * j] == 0) {
        continue;
      }
      ray.origin[side[0]] = static_cast<float>(mask.origin[0] + static_cast<double>(i) * plan.spacing);
      ray.origin[side[1]] = static_cast<float>(mask.origin[1] + static_cast<double>(j) * plan.spacing);
      const std::vector<Interval>& own = self.along(ray);
      if (own.empty()) {
        continue;
      }
      sums.inside += length(own);
      if (around) {
        sums.insideBoth += commonLength(own, around->along(ray));
      }
      for (std::size_t p = 0; p < others.size(); ++p) {
        if (others[p].mayMeet(ray.origin, side)) {
          sums.overlapped[p] += commonLength(own, others[p].along(ray));
        }
      }
    }
  }
  const double share = plan.spacing * plan.spacing;
  sums.inside *= share;
  sums.insideBoth *= share;
  for (double& volume : sums.overlapped) {
    volume *= share;
  }
  return sums;
}

}  // namespace lorica::viscera
