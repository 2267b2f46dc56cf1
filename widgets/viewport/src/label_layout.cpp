#include "label_layout.h"

#include <algorithm>
#include <numeric>

namespace lorica::viewport {

std::vector<bool> withoutOverlaps(const std::vector<LabelBox>& labels) {
  std::vector<std::size_t> order(labels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return labels[a].rank > labels[b].rank; });
  std::vector<bool> seen(labels.size(), false);
  for (const std::size_t one : order) {
    seen[one] = std::none_of(order.begin(), order.end(), [&](std::size_t other) {
      const Eigen::Vector2d apart = (labels[one].middle - labels[other].middle).cwiseAbs();
      const Eigen::Vector2d reach = 0.5 * (labels[one].size + labels[other].size);
      return seen[other] && apart.x() < reach.x() && apart.y() < reach.y();
    });
  }
  return seen;
}

}  // namespace lorica::viewport
