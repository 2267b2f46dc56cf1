#include "lorica/threat/fragment_paths.h"

#include <algorithm>

namespace lorica::threat {

std::vector<FragmentPath> fragmentPaths(const ThreatField& field) {
  struct Sight {
    std::int64_t id;
    std::size_t step;
    std::size_t point;
  };
  std::vector<Sight> sights;
  for (std::size_t s = 0; s < field.steps.size(); ++s) {
    for (std::size_t p = 0; p < field.steps[s].ids.size(); ++p) {
      sights.push_back({field.steps[s].ids[p], s, p});
    }
  }
  std::stable_sort(sights.begin(), sights.end(), [](const Sight& a, const Sight& b) { return a.id < b.id; });
  std::vector<FragmentPath> paths;
  for (const Sight& sight : sights) {
    if (paths.empty() || paths.back().id != sight.id) {
      paths.push_back({sight.id, {}, {}});
    }
    paths.back().points.emplace_back(field.place(sight.step, sight.point).cast<float>());
    if (field.timed) {
      paths.back().times.push_back(field.steps[sight.step].time);
    }
  }
  return paths;
}

}  // namespace lorica::threat
