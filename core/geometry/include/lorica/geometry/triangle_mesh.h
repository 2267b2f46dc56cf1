#pragma once

#include <vector>

#include "lorica/geometry/vectors.h"

namespace lorica::geometry {

/// Indexed triangles. Every index is below positions.size(): readers check, everybody else relies on it.
struct TriangleMesh {
  Positions positions;
  std::vector<Triangle> triangles;

  /// Corner `k` (0..2) of triangle `t`, in double precision.
  Vec3d corner(std::size_t t, int k) const {
    return positions[triangles[t][static_cast<std::size_t>(k)]].cast<double>();
  }
};

/// Appends `part` to `mesh`, its indices shifted.
void append(TriangleMesh& mesh, const TriangleMesh& part);

}  // namespace lorica::geometry
