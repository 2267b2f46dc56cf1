#pragma once

/// \file
/// What kind of surface a mesh is: does it close, how many pieces has it, which way do they face.

#include <vector>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

/// A connected component of a mesh: triangles joined by common vertices.
struct Component {
  std::size_t triangles = 0;
  bool closed = false;        ///< every edge is used as often in one direction as in the other
  double signedVolume = 0.0;  ///< m3; meaningful when closed
};

struct MeshAudit {
  std::vector<Component> components;       ///< in the order of their first triangle
  std::vector<std::uint32_t> componentOf;  ///< per triangle
  std::vector<bool> openEdge;              ///< per triangle and side (3 * t + k, side k from corner k to k + 1)
  std::size_t boundaryEdges = 0;           ///< edges used once
  std::size_t oddEdges = 0;                ///< edges used more than twice, or twice in the same direction
  std::size_t degenerateTriangles = 0;     ///< triangles without area
  bool closed() const;                     ///< all components are closed, and there is one at least
};

/// Cost: linear. \pre mesh is welded, else seams read as boundaries
MeshAudit audit(const TriangleMesh& mesh);

/// Turns closed components that are inside out, unless they lie inside another one of the same mesh that faces
/// outwards, where they bound a cavity. Returns how many were turned; `mesh` and `audit` stay in step.
std::size_t turnInsideOutComponents(TriangleMesh& mesh, MeshAudit& audit);

}  // namespace lorica::geometry
