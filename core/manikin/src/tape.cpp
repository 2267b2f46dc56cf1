#include "tape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lorica::manikin {

double hullGirth(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  // Andrew's monotone chain: the lower half, then the upper one.
  std::vector<Eigen::Vector2d> hull;
  const auto grow = [&](const Eigen::Vector2d& p, std::size_t floor) {
    const auto turnsRight = [&] {
      const Eigen::Vector2d u = hull.back() - hull[hull.size() - 2];
      const Eigen::Vector2d v = p - hull.back();
      return u.x() * v.y() - u.y() * v.x() <= 0.0;
    };
    while (hull.size() >= floor + 2 && turnsRight()) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const auto& p : points) {
    grow(p, 0);
  }
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p < points.rend(); ++p) {
    grow(*p, lower);
  }
  double girth = 0.0;
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    girth += (hull[i + 1] - hull[i]).norm();
  }
  return girth;
}

TapeReading tapeAround(const std::function<double(const geometry::Vec3d&)>& field, const geometry::Vec3d& inside) {
  constexpr int rays = 120;
  constexpr double close = 1e-5;
  std::vector<Eigen::Vector2d> outline;
  outline.reserve(rays);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = -low;
  for (int r = 0; r < rays; ++r) {
    const double angle = 2.0 * std::numbers::pi * r / rays;
    const geometry::Vec3d direction(std::cos(angle), 0.0, std::sin(angle));
    double reach = 0.0;
    for (int step = 0; step < 200; ++step) {
      const double value = field(inside + reach * direction);
      if (value > -close) {
        break;
      }
      reach += std::max(-0.8 * value, close);
    }
    const geometry::Vec3d end = inside + reach * direction;
    outline.emplace_back(end.x(), end.z());
    low = low.cwiseMin(outline.back());
    high = high.cwiseMax(outline.back());
  }
  return {hullGirth(std::move(outline)), high.x() - low.x(), high.y() - low.y()};
}

}  // namespace lorica::manikin
