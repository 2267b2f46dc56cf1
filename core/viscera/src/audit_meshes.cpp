#include "audit_meshes.h"

#include <algorithm>

#include "lorica/geometry/measures.h"

namespace lorica::viscera {

AuditMesh::AuditMesh(const geometry::Positions& points, std::shared_ptr<const raycast::MeshTopology> connected)
    : topology(std::move(connected)),
      positions(points),
      scene(raycast::SceneUse::manyFrames),
      box(geometry::bounds(points)) {
  scene.add(points, topology);
  scene.build();
}

void insideIntervals(std::span<const raycast::Hit> hits, const raycast::MeshTopology& topology,
                     std::vector<Interval>& intervals) {
  intervals.clear();
  int winding = 0;
  double begin = 0.0;
  for (const raycast::Hit& hit : hits) {
    if (!topology.closed[hit.component]) {
      continue;
    }
    const int before = winding;
    winding += hit.sign();
    if (before < 1 && winding >= 1) {
      begin = hit.t;
    } else if (before >= 1 && winding < 1) {
      intervals.push_back({begin, hit.t});
    }
  }
}

double length(std::span<const Interval> intervals) {
  double sum = 0.0;
  for (const Interval& i : intervals) {
    sum += i.end - i.begin;
  }
  return sum;
}

double commonLength(std::span<const Interval> a, std::span<const Interval> b) {
  double sum = 0.0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    sum += std::max(0.0, std::min(a[i].end, b[j].end) - std::max(a[i].begin, b[j].begin));
    if (a[i].end < b[j].end) {
      ++i;
    } else {
      ++j;
    }
  }
  return sum;
}

}  // namespace lorica::viscera
