#pragma once

#include <functional>

#include "lorica/base/parallel.h"
#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

/// Surface where `field` is zero, sampled on a grid of cubes of edge `cell` metres that covers `box`; the field is
/// negative inside. Topologically consistent marching cubes (VTK's flying edges): a surface that stays inside the box
/// comes out closed and manifold, facing outwards, without triangles that have no area.
/// Cost: one call of the field per grid point.
/// \pre cell > 0 and the grid has at most 2^28 points
TriangleMesh isosurface(const std::function<double(const Vec3d&)>& field, const Box3d& box, double cell);

/// The same for a field that is about a distance: a block of 8 x 8 x 8 cells whose middle is further from the surface,
/// by the field's word, than `reach` half diagonals is not looked into. Calls the field from several threads.
/// \pre reach >= 1; a field that overstates distances needs more
TriangleMesh isosurface(const std::function<double(const Vec3d&)>& field, const Box3d& box, double cell, double reach,
                        base::Threads threads);

}  // namespace lorica::geometry
