#pragma once

#include <span>

#include "lorica/parenting/body_rig.h"

namespace lorica::parenting {

/// A point nearer to the skin than this (metres) lies on it, on neither side.
inline constexpr double onSkin = 1e-5;

/// Points on the wrong side of the rest skin.
struct Strays {
  std::size_t points = 0;   ///< how many were looked at
  std::size_t strayed = 0;  ///< how many are on the wrong side
  double farthest = 0.0;    ///< metres from the skin of the farthest of those
};

/// Points that should be inside and are not: an organ's. Inside is told by signed winding; meaningless for a skin that
/// does not close. Cost: one ray and one narrow nearest-point query per point,
/// a wide one per stray.
Strays outsideSkin(std::span<const geometry::Vec3f> points, const BodyRig& body, base::Threads threads);

/// Points that should be outside and are not: an armor piece's.
Strays insideSkin(std::span<const geometry::Vec3f> points, const BodyRig& body, base::Threads threads);

}  // namespace lorica::parenting
