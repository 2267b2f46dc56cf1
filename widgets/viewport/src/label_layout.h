#pragma once

#include <Eigen/Core>
#include <vector>

namespace lorica::viewport {

/// A label as it lies on the screen, pixels.
struct LabelBox {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  int rank = 0;  ///< those of a higher rank are placed first; of one rank, the first in the list
};

/// Which labels are to be seen so that no two lie over each other: each that has room beside those before it.
std::vector<bool> withoutOverlaps(const std::vector<LabelBox>& labels);

}  // namespace lorica::viewport
