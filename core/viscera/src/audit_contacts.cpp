#include "audit_contacts.h"

#include <algorithm>

namespace lorica::viscera {

using geometry::Vec3d;

namespace {

const raycast::MeshIndex only{0};

/// Touching points of the vertices [begin, end) of one organ.
std::vector<ContactPoint> touching(const AuditMesh& organ, const AuditMesh& other, const std::vector<double>& areas,
                                   double contactDistance, std::size_t begin, std::size_t end) {
  geometry::Box3d near = other.box;
  near.min().array() -= contactDistance;
  near.max().array() += contactDistance;
  raycast::Caster caster(other.scene);
  std::vector<ContactPoint> points;
  for (std::size_t v = begin; v < end; ++v) {
    const Vec3d place = organ.positions[v].cast<double>();
    if (areas[v] == 0.0 || !near.contains(place)) {
      continue;
    }
    if (const auto found = raycast::closestPoint(other.scene, place, contactDistance)) {
      const bool inside = raycast::windingNumber(caster, only, place) >= 1;
      points.push_back({static_cast<std::uint32_t>(v), areas[v], inside ? 0.0 : found->distance});
    }
  }
  return points;
}

}  // namespace

std::vector<ContactSide> findContacts(const std::vector<AuditMesh>& organs,
                                      const std::vector<std::vector<double>>& areas, double contactDistance,
                                      base::Threads threads, const base::Progress& progress) {
  std::vector<ContactSide> sides;
  for (std::size_t a = 0; a < organs.size(); ++a) {
    progress.check();
    for (std::size_t b = 0; b < organs.size(); ++b) {
      geometry::Box3d near = organs[b].box;
      near.min().array() -= contactDistance;
      near.max().array() += contactDistance;
      if (a == b || !near.intersects(organs[a].box)) {
        continue;
      }
      constexpr std::size_t grain = 1024;
      const std::size_t vertices = organs[a].positions.size();
      std::vector<std::vector<ContactPoint>> pieces((vertices + grain - 1) / grain);
      base::parallelFor(pieces.size(), 1, threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
          pieces[p] =
              touching(organs[a], organs[b], areas[a], contactDistance, p * grain, std::min(vertices, (p + 1) * grain));
        }
      });
      ContactSide side{a, b, {}};
      for (const std::vector<ContactPoint>& piece : pieces) {
        side.points.insert(side.points.end(), piece.begin(), piece.end());
      }
      if (!side.points.empty()) {
        sides.push_back(std::move(side));
      }
    }
  }
  return sides;
}

void GapSums::add(const GapSums& other) {
  weighted += other.weighted;
  area += other.area;
  largest = std::max(largest, other.largest);
}

GapSums gapSums(const ContactSide& side, std::span<const ContactPoint> points, const std::vector<AuditMesh>& organs) {
  const AuditMesh& other = organs[side.onto];
  raycast::Caster caster(other.scene);
  GapSums sums;
  for (const ContactPoint& point : points) {
    const Vec3d place = organs[side.from].positions[point.vertex].cast<double>();
    const auto found = raycast::closestPoint(other.scene, place);
    double gap = found ? std::max(0.0, found->distance - point.distance) : 0.0;
    if (gap > 0.0 && raycast::windingNumber(caster, only, place) >= 1) {
      gap = 0.0;
    }
    sums.add({gap * point.area, point.area, gap});
  }
  return sums;
}

}  // namespace lorica::viscera
