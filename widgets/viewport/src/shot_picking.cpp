#include "shot_picking.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace lorica::viewport {

namespace {

using Eigen::Vector2d;
using Eigen::Vector4d;

constexpr double alike = 0.5;  // pixels that no hand tells apart

Vector4d clipOf(const ScreenView& view, const geometry::Vec3d& place) {
  return view.toClip * place.homogeneous();
}

Vector2d pixelOf(const ScreenView& view, const Vector4d& clip) {
  return (0.5 * (clip.head<2>() / clip.w() + Vector2d::Ones())).cwiseProduct(view.size);
}

/// Distance from a place to a line on the screen, and how far from the camera the line is there.
struct Nearness {
  double pixels;
  double depth;
};

std::optional<Nearness> nearness(const DrawnShot& shot, const ScreenView& view, const Vector2d& place) {
  Vector4d a = clipOf(view, shot.from);
  Vector4d b = clipOf(view, shot.to);
  // What lies behind the near plane is cut off, as it is where it is drawn.
  const double nearA = a.z() + a.w();
  const double nearB = b.z() + b.w();
  if (nearA <= 0.0 && nearB <= 0.0) {
    return std::nullopt;
  }
  if (nearA <= 0.0) {
    a += nearA / (nearA - nearB) * (b - a);
  } else if (nearB <= 0.0) {
    b += nearB / (nearB - nearA) * (a - b);
  }
  const Vector2d start = pixelOf(view, a);
  const Vector2d along = pixelOf(view, b) - start;
  const double length = along.squaredNorm();
  const double share = length > 0.0 ? std::clamp((place - start).dot(along) / length, 0.0, 1.0) : 0.0;
  // Depth is even along the line on the screen.
  return Nearness{(start + share * along - place).norm(), a.z() / a.w() + share * (b.z() / b.w() - a.z() / a.w())};
}

}  // namespace

Vector2d ScreenView::pixel(const geometry::Vec3d& place) const {
  return pixelOf(*this, clipOf(*this, place));
}

std::optional<std::size_t> shotAt(std::span<const DrawnShot> shots, const ScreenView& view, const Vector2d& place,
                                  double tolerance) {
  std::optional<std::size_t> found;
  Nearness best{tolerance, 0.0};
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const std::optional<Nearness> here = nearness(shots[i], view, place);
    if (!here || here->pixels > tolerance) {
      continue;
    }
    const bool nearer = here->pixels < best.pixels - alike;
    const bool before = here->pixels <= best.pixels + alike && here->depth < best.depth;
    if (!found || nearer || before) {
      found = i;
      best = *here;
    }
  }
  return found;
}

}  // namespace lorica::viewport
