#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"
#include "lorica/raycast/caster.h"

namespace lorica::viscera {

/// One mesh in one pose, alone in a scene of its own: an organ's columns cross only the organs near it.
struct AuditMesh {
  AuditMesh(const geometry::Positions& positions, std::shared_ptr<const raycast::MeshTopology> topology);

  std::shared_ptr<const raycast::MeshTopology> topology;
  std::span<const geometry::Vec3f> positions;
  raycast::Scene scene;
  geometry::Box3d box;

  bool closed(std::size_t triangle) const { return topology->closed[topology->componentOf[triangle]]; }
};

/// A stretch of a ray, in lengths of its direction.
struct Interval {
  double begin = 0.0;
  double end = 0.0;
};

/// Where a ray that starts outside is inside the closed components of the only mesh of a scene: their winding is 1 or
/// more. \param hits of that ray, in order
void insideIntervals(std::span<const raycast::Hit> hits, const raycast::MeshTopology& topology,
                     std::vector<Interval>& intervals);

double length(std::span<const Interval> intervals);
/// Length of what two lists of disjoint, rising intervals have in common.
double commonLength(std::span<const Interval> a, std::span<const Interval> b);

}  // namespace lorica::viscera
