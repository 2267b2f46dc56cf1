#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "lorica/geometry/vectors.h"

namespace lorica::threat {

struct Neighbour {
  double distance = 0.0;  ///< metres
  std::uint32_t point = 0;
  auto operator<=>(const Neighbour&) const = default;
};

/// Nearest points of a set. Const functions are thread-safe.
class PointTree {
 public:
  /// \pre there are points
  explicit PointTree(std::shared_ptr<const geometry::Positions> points);
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;
  ~PointTree();

  /// The `count` nearest, or all when there are fewer, by distance, then index. Of several equally far ones at the end
  /// any may be taken.
  void nearest(const geometry::Vec3d& place, std::size_t count, std::vector<Neighbour>& found) const;
  /// All points within `radius`, likewise sorted.
  void within(const geometry::Vec3d& place, double radius, std::vector<Neighbour>& found) const;

  const std::shared_ptr<const geometry::Positions>& points() const { return points_; }

 private:
  struct Locator;
  void add(const geometry::Vec3d& place, std::uint32_t point, std::vector<Neighbour>& found) const;

  std::shared_ptr<const geometry::Positions> points_;
  std::unique_ptr<Locator> locator_;  ///< none where it would cost more than it saves
};

}  // namespace lorica::threat
