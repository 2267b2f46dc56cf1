#include "depth_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lorica::armor {

using geometry::Vec3d;

DepthMap::DepthMap(std::span<const Vec3d> points, std::span<const geometry::Triangle> triangles,
                   const geometry::Box3d& box, double clearance)
    : box_(box),
      columns_(static_cast<int>(std::ceil(box.sizes().x() / kCell)) + 1),
      rows_(static_cast<int>(std::ceil(box.sizes().y() / kCell)) + 1),
      depth_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNothing) {
  for (const geometry::Triangle& t : triangles) {
    raise(points[t[0]], points[t[1]], points[t[2]]);
  }
  grow(clearance);
}

void DepthMap::raise(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto [lowX, highX] = std::minmax({a.x(), b.x(), c.x()});
  const auto [lowY, highY] = std::minmax({a.y(), b.y(), c.y()});
  if (highX < box_.min().x() || lowX > box_.max().x() || highY < box_.min().y() || lowY > box_.max().y()) {
    return;
  }
  const double whole = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
  if (std::abs(whole) < 1e-14) {
    return;
  }
  const auto first = [](double low, double origin) {
    return std::max(0, static_cast<int>(std::ceil((low - origin) / kCell)));
  };
  const auto last = [](double high, double origin, int count) {
    return std::min(count - 1, static_cast<int>(std::floor((high - origin) / kCell)));
  };
  for (int j = first(lowY, box_.min().y()); j <= last(highY, box_.min().y(), rows_); ++j) {
    const double y = box_.min().y() + j * kCell;
    for (int i = first(lowX, box_.min().x()); i <= last(highX, box_.min().x(), columns_); ++i) {
      const double x = box_.min().x() + i * kCell;
      const double v = ((x - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (y - a.y())) / whole;
      const double w = ((b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y())) / whole;
      if (v >= -1e-9 && w >= -1e-9 && v + w <= 1.0 + 1e-9) {
        double& depth = depth_[place(i, j)];
        depth = std::max(depth, a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z()));
      }
    }
  }
}

void DepthMap::grow(double radius) {
  const std::vector<double> skin = std::exchange(depth_, std::vector<double>(depth_.size(), kNothing));
  const int reach = static_cast<int>(std::floor(radius / kCell));
  for (int dj = -reach; dj <= reach; ++dj) {
    for (int di = -reach; di <= reach; ++di) {
      const double rest = radius * radius - kCell * kCell * (di * di + dj * dj);
      if (rest < 0.0) {
        continue;
      }
      const double lift = std::sqrt(rest);
      for (int j = std::max(0, -dj); j < std::min(rows_, rows_ - dj); ++j) {
        for (int i = std::max(0, -di); i < std::min(columns_, columns_ - di); ++i) {
          double& depth = depth_[place(i, j)];
          depth = std::max(depth, skin[place(i + di, j + dj)] + lift);
        }
      }
    }
  }
}

}  // namespace lorica::armor
