#include "spherical_rectangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "unit_circle.h"

namespace lorica::shotline {

SphericalRectangle::SphericalRectangle(double width, double height, double distance)
    : halfWidth_(0.5 * width), halfHeight_(0.5 * height), distance_(distance) {
  // Normals of the planes through the origin and the edges; their angles are the inner angles of the rectangle on the
  // sphere, all four equal because the axis runs through its middle.
  const double level = std::hypot(distance_, halfHeight_);
  const double upright = std::hypot(distance_, halfWidth_);
  slope_ = halfHeight_ / level;
  const double cosine = -(halfWidth_ / upright) * slope_;
  const double inner = std::acos(cosine);
  turn_ = 2.0 * std::numbers::pi - 2.0 * inner;
  // 4 * inner - 2 * pi by the arcsine, which keeps the digits of small ones.
  solidAngle_ = 4.0 * std::asin(-cosine);
}

geometry::Vec3d SphericalRectangle::point(const std::array<double, 2>& u) const {
  const auto [cosine, sine] = pointOnCircle((u[0] * solidAngle_ + turn_) / (2.0 * std::numbers::pi));
  const double fu = (cosine - 1.0) * slope_ / sine;  // b0 = b1 here
  const double cu = std::clamp(std::copysign(1.0 / std::sqrt(fu * fu + slope_ * slope_), fu), -1.0, 1.0);
  const double xu = std::clamp(cu * distance_ / std::sqrt(std::max(1e-300, 1.0 - cu * cu)), -halfWidth_, halfWidth_);
  const double d2 = xu * xu + distance_ * distance_;
  const double h1 = halfHeight_ / std::sqrt(d2 + halfHeight_ * halfHeight_);
  const double hv = h1 * (2.0 * u[1] - 1.0);
  const double yv =
      std::clamp(hv * std::sqrt(d2) / std::sqrt(std::max(1e-300, 1.0 - hv * hv)), -halfHeight_, halfHeight_);
  return {xu, yv, distance_};
}

}  // namespace lorica::shotline
