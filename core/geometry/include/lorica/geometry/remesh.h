#pragma once

/// \file
/// Even, well-shaped triangles on a given surface (after Botsch and Kobbelt 2004, "A Remeshing Approach to
/// Multiresolution Modeling", section 4, with a length that varies over the surface).

#include <functional>

#include "lorica/base/parallel.h"
#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

struct RemeshOptions {
  /// Wanted length of the edges near a point, metres, positive; should vary slowly against itself.
  std::function<double(const Vec3d&)> edgeLength;
  /// The nearest point of the surface, or one close to it, for a point near it. Called from several threads.
  std::function<Vec3d(const Vec3d&)> project;
  int rounds = 6;  ///< of split, collapse, flip and relax
  base::Threads threads;
};

/// Splits long edges, collapses short ones, flips and relaxes until the edges are near the wanted length (mostly 0.8
/// to 1.33 times). The genus and the orientation stay. The same bytes at any number of threads.
/// \pre mesh is closed and manifold: every edge has two triangles that use it in opposite directions, every vertex one
///      fan of triangles
/// Cost: about 1 us per triangle and round beside the projections (one per vertex and round).
TriangleMesh remeshed(const TriangleMesh& mesh, const RemeshOptions& options);

}  // namespace lorica::geometry
