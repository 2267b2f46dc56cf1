#include "lorica/shotline/source.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"
#include "spherical_rectangle.h"
#include "unit_circle.h"

namespace lorica::shotline {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

Measure measure(const PointSource& point) {
  switch (point.sampler) {
    case Sampler::cone:
    case Sampler::disk:
      return {Basis::solidAngle, solidAngle(point.halfAngle)};
    case Sampler::rectangle:
      return {Basis::solidAngle, solidAngle(point.width, point.height, (point.target - point.position).norm())};
    case Sampler::thesis:
      break;
  }
  return {};
}

}  // namespace

Measure measureOf(const Source& source) {
  const auto disk = [](double radius) { return std::numbers::pi * radius * radius; };
  if (const auto* point = std::get_if<PointSource>(&source.shape)) {
    return measure(*point);
  }
  if (const auto* beam = std::get_if<ParallelBeam>(&source.shape)) {
    const bool grid = source.sequence == Sequence::grid;
    return {Basis::area, grid ? 4.0 * beam->radius * beam->radius : disk(beam->radius)};
  }
  if (const auto* band = std::get_if<DirectionBand>(&source.shape)) {
    return {Basis::area, disk(band->radius)};
  }
  return {};
}

bool isDrawn(const Source& source) {
  return !std::holds_alternative<ShotList>(source.shape);
}

bool independentShots(const Source& source) {
  return source.sequence == Sequence::random && isDrawn(source);
}

Vec3d towards(double azimuth, double elevation) {
  const auto [ahead, left] = pointOnCircle(azimuth / (2.0 * std::numbers::pi));
  const auto [level, up] = pointOnCircle(elevation / (2.0 * std::numbers::pi));
  return {left * level, up, ahead * level};
}

double boundingHalfAngle(const Vec3d& position, const Vec3d& target,
                         std::span<const std::span<const Vec3f>> posedSkins) {
  LORICA_CHECK(position != target, "a source stands off its target");
  const Vec3d axis = (target - position).normalized();
  double widest = 0.0;
  for (const std::span<const Vec3f> skin : posedSkins) {
    for (const Vec3f& vertex : skin) {
      const Vec3d there = vertex.cast<double>() - position;
      // atan2 keeps its digits where the cosine of a narrow cone has lost them.
      widest = std::max(widest, std::atan2(axis.cross(there).norm(), axis.dot(there)));
    }
  }
  LORICA_CHECK(widest > 0.0, "a cone needs something to bound");
  // A touch wider than the outermost vertex, for the rounding of rays to single precision.
  const double padded = widest * (1.0 + 1e-6);
  return padded < std::numbers::pi / 2.0 ? padded : std::numbers::pi;
}

namespace {

template <class Distance>
double paddedLargest(std::span<const std::span<const Vec3f>> posedSkins, const Distance& distance) {
  double largest = 0.0;
  for (const std::span<const Vec3f> skin : posedSkins) {
    for (const Vec3f& vertex : skin) {
      largest = std::max(largest, distance(vertex.cast<double>()));
    }
  }
  LORICA_CHECK(largest > 0.0, "a disk needs something to bound");
  return largest * (1.0 + 1e-6) + 1e-6;
}

}  // namespace

double boundingRadius(const Vec3d& centre, std::span<const std::span<const Vec3f>> posedSkins) {
  return paddedLargest(posedSkins, [&](const Vec3d& p) { return (p - centre).norm(); });
}

double boundingRadius(const Vec3d& centre, const Vec3d& axis, std::span<const std::span<const Vec3f>> posedSkins) {
  return paddedLargest(posedSkins, [&](const Vec3d& p) { return axis.cross(p - centre).norm(); });
}

double solidAngle(double halfAngle) {
  const double s = std::sin(halfAngle / 2.0);
  return 4.0 * std::numbers::pi * s * s;
}

double solidAngle(double width, double height, double distance) {
  return SphericalRectangle(width, height, distance).solidAngle();
}

}  // namespace lorica::shotline
