#pragma once

#include <span>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

struct Welded {
  TriangleMesh mesh;                    ///< first of the equal vertices kept, in their old order
  std::vector<std::uint32_t> sourceOf;  ///< for each kept vertex, its index in the input
  std::size_t droppedTriangles = 0;     ///< triangles that used one welded vertex twice
};

/// Joins vertices at exactly the same position (0 and -0 are the same), as files split them by normals or texture
/// coordinates. Vertices with different `group` values stay apart; an empty span means one group.
/// \pre group is empty or has one entry per vertex
/// Cost: one hash lookup per vertex; the arrays of `mesh` become those of the result.
Welded weld(TriangleMesh mesh, std::span<const std::uint32_t> group = {});

}  // namespace lorica::geometry
