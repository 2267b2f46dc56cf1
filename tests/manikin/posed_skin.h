#pragma once

/// \file
/// The skin in a pose as a judge of what is worn on it: distances by closest point and winding, and where it folds.
/// Nothing here is shared with what carries armor.

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <vector>

#include "lorica/geometry/closest_point.h"
#include "lorica/parenting/body_rig.h"
#include "lorica/raycast/caster.h"

namespace lorica::manikin::test {

class PosedSkin {
 public:
  PosedSkin(const parenting::BodyRig& rig, const geometry::Positions& posed)
      : posed_{posed, rig.body().skin.triangles}, tree_(posed_), scene_(raycast::SceneUse::manyRays) {
    mesh_ = scene_.add(posed_.positions, rig.skinTopology());
    scene_.build();
    for (std::uint32_t t = 0; t < posed_.triangles.size(); ++t) {
      middles_.emplace_back((posed_.corner(t, 0) + posed_.corner(t, 1) + posed_.corner(t, 2)) / 3.0);
      normals_.emplace_back(
          (posed_.corner(t, 1) - posed_.corner(t, 0)).cross(posed_.corner(t, 2) - posed_.corner(t, 0)).normalized());
      cells_[cellOf(middles_.back())].push_back(t);
    }
  }

  raycast::Caster caster() const { return raycast::Caster(scene_); }

  /// Metres, negative inside. Where the skin folds through itself its nearest triangle may face the wrong way: the
  /// winding decides.
  double distance(const geometry::Vec3d& p, raycast::Caster& caster) const {
    const geometry::ClosestPoint near = *tree_.closest(p);
    const bool behind = near.pseudoNormal.dot(p - near.point) < 0.0;
    return behind && raycast::windingNumber(caster, mesh_, p) > 0 ? -near.distance : near.distance;
  }

  /// A fold: within kRoom of the point two places of the skin face one another, each before the other and with more
  /// than 120 degrees between their normals, or the skin has passed through itself: some of it lies inside the body.
  /// Armor may lie as far off the skin as kRoom; where other skin comes as near, it meets what is worn there.
  bool folds(const geometry::Vec3d& p, raycast::Caster& caster) const {
    const std::vector<std::uint32_t> near = trianglesNear(p);
    for (const std::uint32_t a : near) {
      for (const std::uint32_t b : near) {
        const geometry::Vec3d way = middles_[b] - middles_[a];
        if (normals_[a].dot(normals_[b]) < -0.5 && way.dot(normals_[a]) > 0.0 && way.dot(normals_[b]) < 0.0) {
          return true;
        }
      }
    }
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t t) {
      return raycast::windingNumber(caster, mesh_, middles_[t] + 0.001 * normals_[t]) > 0;
    });
  }

  static constexpr double kRoom = 0.030;

 private:
  using Cell = std::array<int, 3>;
  static Cell cellOf(const geometry::Vec3d& p) {
    return {static_cast<int>(std::floor(p.x() / kRoom)), static_cast<int>(std::floor(p.y() / kRoom)),
            static_cast<int>(std::floor(p.z() / kRoom))};
  }
  /// Whose middles lie within kRoom.
  std::vector<std::uint32_t> trianglesNear(const geometry::Vec3d& p) const {
    std::vector<std::uint32_t> near;
    const Cell middle = cellOf(p);
    for (int i = 0; i < 27; ++i) {
      const auto cell = cells_.find({middle[0] + i / 9 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i % 3 - 1});
      if (cell != cells_.end()) {
        std::copy_if(cell->second.begin(), cell->second.end(), std::back_inserter(near),
                     [&](std::uint32_t t) { return (middles_[t] - p).norm() < kRoom; });
      }
    }
    return near;
  }

  geometry::TriangleMesh posed_;
  geometry::ClosestPointTree tree_;
  raycast::Scene scene_;
  raycast::MeshIndex mesh_;
  std::vector<geometry::Vec3d> middles_;
  std::vector<geometry::Vec3d> normals_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

}  // namespace lorica::manikin::test
