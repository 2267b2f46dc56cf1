#pragma once

#include <span>
#include <vector>

#include "lorica/geometry/vectors.h"

namespace lorica::viewport {

struct CoarseOptions {
  double share = 0.05;        ///< of the triangles to keep, if the tolerance allows so few
  std::size_t least = 2000;   ///< triangles to keep at any rate: small meshes cost little, and keep their shading
  double tolerance = 0.0015;  ///< how far the surface may move, metres: below a pixel when a person fills the window
};

/// Fewer triangles over the same vertices that look like the mesh from afar: for drawing while something moves. Edges
/// are collapsed in the order of what it costs (quadric error metric, Garland and Heckbert 1997), so open borders and
/// holes stay. The same triangles every time. Takes about a second per million triangles.
/// \pre every index is below positions.size()
std::vector<geometry::Triangle> coarseTriangles(std::span<const geometry::Vec3f> positions,
                                                std::span<const geometry::Triangle> triangles,
                                                const CoarseOptions& options = {});

}  // namespace lorica::viewport
