#pragma once

#include <memory>
#include <vector>

#include "lorica/geometry/mesh_audit.h"

namespace lorica::raycast {

/// What the ray tracer knows of a mesh beside its vertex positions. It does not change with the pose, so poses and
/// models of one structure share it.
struct MeshTopology {
  std::vector<geometry::Triangle> triangles;
  std::vector<std::uint32_t> componentOf;  ///< per triangle
  std::vector<bool> closed;                ///< per component
  std::vector<bool> openEdge;              ///< per triangle side, 3 * t + k
  bool hasOpenEdges = false;
  std::vector<std::uint32_t> ringStart;  ///< per vertex, its first place in `ring`; one more at the end
  std::vector<std::uint32_t> ring;       ///< triangles around each vertex, rising
  std::size_t vertices = 0;
};

/// Cost: one sort of the edges.
std::shared_ptr<const MeshTopology> makeTopology(const geometry::TriangleMesh& mesh);

}  // namespace lorica::raycast
