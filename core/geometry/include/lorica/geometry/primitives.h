#pragma once

/// \file
/// Closed meshes of simple shapes: parts of generated models, and shapes with known answers for tests.

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

/// Icosahedron refined `subdivisions` times (20 * 4^n triangles) with its vertices on the ellipsoid.
TriangleMesh ellipsoid(const Vec3d& centre, const Vec3d& semiAxes, int subdivisions);

/// Axis-aligned box of 12 triangles.
TriangleMesh box(const Vec3d& low, const Vec3d& high);

}  // namespace lorica::geometry
