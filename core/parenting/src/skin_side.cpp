#include "lorica/parenting/skin_side.h"

#include <algorithm>

namespace lorica::parenting {

SkinSide sideOfSkin(std::span<const geometry::Vec3f> points, const BodyRig& body, base::Threads threads) {
  std::vector<double> depth(points.size(), 0.0);  // positive inside
  std::vector<char> inside(points.size(), 0);
  base::parallelFor(points.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    raycast::Caster caster(body.restScene());
    for (std::size_t i = begin; i < end; ++i) {
      const geometry::Vec3d point = points[i].cast<double>();
      inside[i] = raycast::windingNumber(caster, body.skinMesh(), point) >= 1 ? 1 : 0;
      const auto nearest = raycast::closestPoint(body.restScene(), point);
      depth[i] = nearest ? nearest->distance : 0.0;
    }
  });
  SkinSide side;
  side.points = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (inside[i] != 0) {
      ++side.inside;
      side.deepestInside = std::max(side.deepestInside, depth[i]);
    } else {
      ++side.outside;
      side.farthestOutside = std::max(side.farthestOutside, depth[i]);
    }
  }
  return side;
}

}  // namespace lorica::parenting
