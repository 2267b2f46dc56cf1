#include "lorica/parenting/skin_side.h"

#include <algorithm>

namespace lorica::parenting {

namespace {

Strays strays(std::span<const geometry::Vec3f> points, const BodyRig& body, bool shouldBeInside,
              base::Threads threads) {
  std::vector<double> distance(points.size(), -1.0);
  base::parallelFor(points.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    raycast::Caster caster(body.restScene());
    for (std::size_t i = begin; i < end; ++i) {
      const geometry::Vec3d point = points[i].cast<double>();
      // A ray from a point of the skin decides nothing, and would be traced again against every triangle.
      if (raycast::closestPoint(body.restScene(), point, onSkin)) {
        continue;
      }
      const bool inside = raycast::windingNumber(caster, body.skinMesh(), point) >= 1;
      if (inside != shouldBeInside) {
        const auto nearest = raycast::closestPoint(body.restScene(), point);
        distance[i] = nearest ? nearest->distance : 0.0;
      }
    }
  });
  Strays result;
  result.points = points.size();
  for (const double d : distance) {
    result.strayed += d >= 0.0 ? 1 : 0;
    result.farthest = std::max(result.farthest, d);
  }
  return result;
}

}  // namespace

Strays outsideSkin(std::span<const geometry::Vec3f> points, const BodyRig& body, base::Threads threads) {
  return strays(points, body, true, threads);
}

Strays insideSkin(std::span<const geometry::Vec3f> points, const BodyRig& body, base::Threads threads) {
  return strays(points, body, false, threads);
}

}  // namespace lorica::parenting
