#include "lorica/shotline/point_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"

namespace lorica::shotline {

using geometry::Vec3d;
using geometry::Vec3f;

double boundingHalfAngle(const Vec3d& position, const Vec3d& target,
                         std::span<const std::span<const Vec3f>> posedSkins) {
  LORICA_CHECK(position != target, "a source stands off its target");
  const Vec3d axis = (target - position).normalized();
  double widest = 0.0;
  for (const std::span<const Vec3f> skin : posedSkins) {
    for (const Vec3f& vertex : skin) {
      const Vec3d towards = vertex.cast<double>() - position;
      // atan2 keeps its digits where the cosine of a narrow cone has lost them.
      widest = std::max(widest, std::atan2(axis.cross(towards).norm(), axis.dot(towards)));
    }
  }
  LORICA_CHECK(widest > 0.0, "a cone needs something to bound");
  // A touch wider than the outermost vertex, for the rounding of rays to single precision.
  const double padded = widest * (1.0 + 1e-6);
  return padded < std::numbers::pi / 2.0 ? padded : std::numbers::pi;
}

namespace {

/// Cosine and sine of a full turn times `u`, u in [0, 1). Made of additions and multiplications alone: the maths
/// library picks other instructions on other processors and gives other last digits there, and shots must not.
std::array<double, 2> pointOnCircle(double u) {
  // The nearest multiple of a quarter turn, and what is left: at most an eighth of a turn to either side.
  const double quarters = std::floor(4.0 * u + 0.5);
  const double x = 2.0 * std::numbers::pi * (u - 0.25 * quarters);
  const double x2 = x * x;
  // Taylor series; the first terms left out are below 1e-16 here.
  const double s =
      x * (1.0 + x2 * (-1.0 / 6 +
                       x2 * (1.0 / 120 + x2 * (-1.0 / 5040 + x2 * (1.0 / 362880 + x2 * (-1.0 / 39916800 +
                                                                                        x2 * (1.0 / 6227020800.0)))))));
  const double c =
      1.0 + x2 * (-0.5 + x2 * (1.0 / 24 +
                               x2 * (-1.0 / 720 +
                                     x2 * (1.0 / 40320 + x2 * (-1.0 / 3628800 + x2 * (1.0 / 479001600 +
                                                                                      x2 * (-1.0 / 87178291200.0)))))));
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace

double solidAngle(double halfAngle) {
  const double s = std::sin(halfAngle / 2.0);
  return 4.0 * std::numbers::pi * s * s;
}

ShotGenerator::ShotGenerator(const PointSource& source, std::uint64_t seed, std::uint32_t trial)
    : source_(source), key_{seed, stats::sourceId(source.name), trial}, origin_(source.position.cast<float>()) {
  // 1 - cos by half angles, which keeps the digits of narrow cones.
  const double half = std::sin(source.halfAngle / 2.0);
  widestDrop_ = 2.0 * half * half;
  LORICA_CHECK(source.position != source.target, "a source stands off its target");
  axes_.col(2) = (source.target - source.position).normalized();
  axes_.col(0) = axes_.col(2).unitOrthogonal();
  axes_.col(1) = axes_.col(2).cross(axes_.col(0));
}

raycast::Ray ShotGenerator::shot(std::uint64_t number) const {
  if (source_.sampler == Sampler::thesis) {
    const auto u = stats::uniform4(key_, number);
    const Vec3d factor(20.0 * u[0] - 10.0, 20.0 * u[1] - 10.0, 20.0 * u[2] - 10.0);
    const Vec3d direction = (source_.target - source_.position).cwiseProduct(factor);
    return {origin_, direction.cast<float>()};
  }
  const auto u = stats::uniform2(key_, number);
  // Uniform in solid angle: uniform in the cosine and around the axis.
  const double drop = u[0] * widestDrop_;  // 1 - cos(theta)
  const double sine = std::sqrt(std::max(0.0, drop * (2.0 - drop)));
  const auto [cosine, sineAround] = pointOnCircle(u[1]);
  const Vec3d local(sine * cosine, sine * sineAround, 1.0 - drop);
  return {origin_, Vec3d(axes_ * local).cast<float>()};
}

}  // namespace lorica::shotline
