#pragma once

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

/// How often the mesh winds around a point: 1 inside a closed outward mesh, 0 outside, between for open meshes.
/// Sum of solid angles (Van Oosterom and Strackee 1983) in double precision over 4 pi. Cost: every triangle, so for
/// single points and as an oracle; many points are the ray tracer's work.
double windingNumber(const TriangleMesh& mesh, const Vec3d& point);

}  // namespace lorica::geometry
