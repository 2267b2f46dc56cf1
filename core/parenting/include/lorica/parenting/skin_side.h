#pragma once

#include <span>

#include "lorica/parenting/body_rig.h"

namespace lorica::parenting {

/// How points lie against the rest skin.
struct SkinSide {
  std::size_t points = 0;
  std::size_t inside = 0;
  std::size_t outside = 0;
  double deepestInside = 0.0;    ///< metres from the skin of the deepest point inside
  double farthestOutside = 0.0;  ///< metres from the skin of the farthest point outside
};

/// Inside is told by signed winding. Meaningless for a skin that does not close.
/// Cost: one ray and one nearest-point query per point.
SkinSide sideOfSkin(std::span<const geometry::Vec3f> points, const BodyRig& body, base::Threads threads);

}  // namespace lorica::parenting
