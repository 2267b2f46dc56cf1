#include "coarse_triangles.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace lorica::viewport {

std::vector<geometry::Triangle> coarseTriangles(std::span<const geometry::Vec3f> positions,
                                                std::span<const geometry::Triangle> triangles,
                                                const CoarseOptions& options) {
  const std::size_t wanted =
      std::max(options.least, static_cast<std::size_t>(options.share * static_cast<double>(triangles.size())));
  if (triangles.size() <= wanted) {
    return {triangles.begin(), triangles.end()};
  }
  const float* vertices = positions.front().data();
  const float extent = meshopt_simplifyScale(vertices, positions.size(), sizeof(geometry::Vec3f));
  if (!(extent > 0.0F)) {
    return {triangles.begin(), triangles.end()};
  }
  std::vector<geometry::Triangle> coarse(triangles.size());
  const std::size_t indices = meshopt_simplify(coarse.front().data(), triangles.front().data(), 3 * triangles.size(),
                                               vertices, positions.size(), sizeof(geometry::Vec3f), 3 * wanted,
                                               static_cast<float>(options.tolerance) / extent, 0U, nullptr);
  coarse.resize(indices / 3);
  coarse.shrink_to_fit();
  return coarse;
}

}  // namespace lorica::viewport
