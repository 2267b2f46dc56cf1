#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::armor {

/// Depth where there is no skin.
inline constexpr double kNothing = -std::numeric_limits<double>::infinity();

/// Largest z of the skin over a grid of x and y, grown by a ball, so that what stays above it keeps its distance.
class DepthMap {
 public:
  DepthMap(std::span<const geometry::Vec3d> points, std::span<const geometry::Triangle> triangles,
           const geometry::Box3d& box, double clearance);

  /// The highest of the four grid points around; nothing (-infinity) beside the skin.
  double at(double x, double y) const {
    const int i = static_cast<int>(std::floor((x - box_.min().x()) / kCell));
    const int j = static_cast<int>(std::floor((y - box_.min().y()) / kCell));
    return std::max({value(i, j), value(i + 1, j), value(i, j + 1), value(i + 1, j + 1)});
  }

 private:
  static constexpr double kCell = 0.004;

  double value(int i, int j) const {
    return i < 0 || j < 0 || i >= columns_ || j >= rows_ ? kNothing : depth_[place(i, j)];
  }
  /// Where a grid point's depth is kept; the point lies within the grid.
  std::size_t place(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i);
  }
  void raise(const geometry::Vec3d& a, const geometry::Vec3d& b, const geometry::Vec3d& c);
  void grow(double radius);

  geometry::Box3d box_;
  int columns_;
  int rows_;
  std::vector<double> depth_;
};

}  // namespace lorica::armor
