#include "lorica/shotline/partition.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lorica/base/error.h"

namespace lorica::shotline {

using geometry::Vec3d;

double Passage::normalThickness() const {
  return thickness() * std::cos(obliquityIn);
}

namespace {

/// Angle between the ray and the normal of the triangle it meets.
double obliquity(const raycast::Ray& ray, const raycast::Hit& hit, const raycast::Scene& scene) {
  const raycast::MeshIndex mesh{hit.mesh};
  const geometry::Triangle& corners = scene.topology(mesh).triangles[hit.triangle];
  const geometry::Vec3f* positions = scene.positions(mesh);
  const Vec3d a = positions[corners[0]].cast<double>();
  const Vec3d normal = (positions[corners[1]].cast<double>() - a).cross(positions[corners[2]].cast<double>() - a);
  const Vec3d direction = ray.direction.cast<double>();
  // By the arctangent, which keeps the digits of small angles.
  return std::atan2(normal.cross(direction).norm(), std::abs(normal.dot(direction)));
}

/// How a shot stands to one mesh on its way.
struct Walk {
  int winding = 0;  ///< of the closed parts
  std::size_t passage = 0;
  bool open = false;  ///< `passage` has not ended
};

}  // namespace

std::vector<Passage> passagesOf(const raycast::Ray& ray, std::span<const raycast::Hit> hits,
                                const raycast::Scene& scene) {
  const double length = ray.direction.cast<double>().norm();
  const auto closed = [&](const raycast::Hit& hit) {
    return static_cast<bool>(scene.topology(raycast::MeshIndex{hit.mesh}).closed[hit.component]);
  };
  // A shot has no end, so it leaves every closed part: what it leaves more often than it enters, it starts in.
  std::map<std::uint32_t, Walk> walks;
  for (const raycast::Hit& hit : hits) {
    Walk& walk = walks[hit.mesh];
    walk.winding -= closed(hit) ? hit.sign() : 0;
  }
  std::vector<Passage> passages;
  for (auto& [mesh, walk] : walks) {
    if (walk.winding != 0) {
      walk.passage = passages.size();
      walk.open = true;
      passages.push_back({mesh, true, true, 0.0, 0.0, 0.0, 0.0});
    }
  }
  for (const raycast::Hit& hit : hits) {
    Walk& walk = walks[hit.mesh];
    const double at = hit.t * length;
    if (!closed(hit)) {
      const double angle = obliquity(ray, hit, scene);
      passages.push_back({hit.mesh, false, false, at, at, angle, angle});
      continue;
    }
    const int before = walk.winding;
    walk.winding += hit.sign();
    if (before == 0) {
      walk.passage = passages.size();
      walk.open = true;
      passages.push_back({hit.mesh, true, false, at, at, obliquity(ray, hit, scene), 0.0});
    } else if (walk.winding == 0 && walk.open) {
      passages[walk.passage].exit = at;
      passages[walk.passage].obliquityOut = obliquity(ray, hit, scene);
      walk.open = false;
    }
  }
  std::stable_sort(passages.begin(), passages.end(), [](const Passage& a, const Passage& b) {
    return a.enter != b.enter ? a.enter < b.enter : a.mesh < b.mesh;
  });
  return passages;
}

std::vector<Segment> partition(std::span<const Passage> passages, OverlapPolicy policy,
                               std::span<const std::size_t> ranks) {
  LORICA_CHECK(ranks.size() == passages.size() || policy != OverlapPolicy::priority, "a rank for every passage");
  std::vector<double> cuts;
  for (const Passage& passage : passages) {
    if (passage.exit > passage.enter) {
      cuts.push_back(passage.enter);
      cuts.push_back(passage.exit);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<Segment> segments;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    Segment segment{cuts[c], cuts[c + 1], {}};
    for (std::size_t p = 0; p < passages.size(); ++p) {
      if (passages[p].enter <= segment.from && passages[p].exit >= segment.to) {
        segment.owners.push_back(p);
      }
    }
    if (policy != OverlapPolicy::allClaim && segment.owners.size() > 1) {
      // Passages stand in the order they are entered, so the first of equal rank is the outermost.
      const auto owner = policy == OverlapPolicy::outermost
                             ? segment.owners.begin()
                             : std::min_element(segment.owners.begin(), segment.owners.end(),
                                                [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
      segment.owners = {*owner};
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

}  // namespace lorica::shotline
