#include "lorica/shotline/shot_generator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"
#include "lorica/stats/sobol.h"
#include "spherical_rectangle.h"
#include "unit_circle.h"

namespace lorica::shotline {

using geometry::Mat3d;
using geometry::Vec3d;
using geometry::Vec3f;
using raycast::Ray;

namespace {

// How numbers are drawn: functions of the shot number alone.

struct RandomNumbers {
  stats::ShotKey key;
  std::array<double, 2> two(std::uint64_t shot) const { return stats::uniform2(key, shot); }
  std::array<double, 4> four(std::uint64_t shot) const { return stats::uniform4(key, shot); }
};

struct SobolNumbers {
  stats::SobolPoints points;
  std::array<double, 2> two(std::uint64_t shot) const { return points.point2(shot); }
  std::array<double, 4> four(std::uint64_t shot) const { return points.point4(shot); }
};

/// Cell by cell, all shifted by the same random part of a cell in each trial.
struct GridNumbers {
  /// The draw of Philox that the shift comes from; draws of shots lie far below.
  static constexpr std::uint32_t shiftDraw = stats::drawLimit - 1;
  GridNumbers(const stats::ShotKey& key, std::uint64_t cells)
      : side(cells), shift(stats::uniform2(key, 0, shiftDraw)) {}
  std::array<double, 2> two(std::uint64_t shot) const {
    const auto n = static_cast<double>(side);
    const std::uint64_t row = shot / side;
    const std::uint64_t column = shot % side;
    return {(static_cast<double>(column) + shift[0]) / n, (static_cast<double>(row) + shift[1]) / n};
  }
  std::uint64_t side;
  std::array<double, 2> shift;
};

/// Columns: two across an axis, then the axis.
Mat3d axesAround(const Vec3d& axis) {
  Mat3d axes;
  axes.col(2) = axis;
  axes.col(0) = axis.unitOrthogonal();
  axes.col(1) = axis.cross(axes.col(0));
  return axes;
}

/// The same with the first column level, so that a rectangle stands upright.
Mat3d uprightAxes(const Vec3d& axis) {
  const Vec3d level = Vec3d::UnitY().cross(axis);
  if (level.norm() < 1e-9) {
    return axesAround(axis);
  }
  Mat3d axes;
  axes.col(2) = axis;
  axes.col(0) = level.normalized();
  axes.col(1) = axis.cross(axes.col(0));
  return axes;
}

/// Shots of far sources start beyond the body and what it wears.
double startDistance(double radius) {
  return 2.0 * radius + 1.0;
}

// What the numbers become: one kind of shots each.

struct ConeShots {
  ConeShots(const PointSource& source, double halfAngle)
      : origin(source.position.cast<float>()), axes(axesAround((source.target - source.position).normalized())) {
    // 1 - cos by half angles, which keeps the digits of narrow cones.
    const double half = std::sin(halfAngle / 2.0);
    widestDrop = 2.0 * half * half;
  }
  Ray ray(const std::array<double, 2>& u) const {
    // Uniform in solid angle: uniform in the cosine and around the axis.
    const double drop = u[0] * widestDrop;  // 1 - cos(theta)
    const double sine = std::sqrt(std::max(0.0, drop * (2.0 - drop)));
    const auto [cosine, sineAround] = pointOnCircle(u[1]);
    const Vec3d local(sine * cosine, sine * sineAround, 1.0 - drop);
    return {origin, Vec3d(axes * local).cast<float>()};
  }
  Vec3f origin;
  Mat3d axes;
  double widestDrop = 0.0;
};

struct RectangleShots {
  explicit RectangleShots(const PointSource& source)
      : origin(source.position.cast<float>()),
        axes(uprightAxes((source.target - source.position).normalized())),
        rectangle(source.width, source.height, (source.target - source.position).norm()) {}
  Ray ray(const std::array<double, 2>& u) const {
    return {origin, Vec3d(axes * rectangle.point(u).normalized()).cast<float>()};
  }
  Vec3f origin;
  Mat3d axes;
  SphericalRectangle rectangle;
};

struct ThesisShots {
  explicit ThesisShots(const PointSource& source)
      : origin(source.position.cast<float>()), aim(source.target - source.position) {}
  Ray ray(const std::array<double, 4>& u) const {
    const Vec3d factor(20.0 * u[0] - 10.0, 20.0 * u[1] - 10.0, 20.0 * u[2] - 10.0);
    return {origin, aim.cwiseProduct(factor).cast<float>()};
  }
  Vec3f origin;
  Vec3d aim;
};

struct BeamShots {
  explicit BeamShots(const ParallelBeam& beam, bool square)
      : axes(uprightAxes(towards(beam.azimuth, beam.elevation))),
        direction(Vec3d(-axes.col(2)).cast<float>()),
        start(beam.centre + startDistance(beam.radius) * axes.col(2)),
        radius(beam.radius),
        overSquare(square) {}
  Ray ray(const std::array<double, 2>& u) const {
    double x = 2.0 * u[0] - 1.0;
    double y = 2.0 * u[1] - 1.0;
    if (!overSquare) {
      const auto [cosine, sine] = pointOnCircle(u[1]);
      const double r = std::sqrt(u[0]);
      x = r * cosine;
      y = r * sine;
    }
    return {Vec3d(start + radius * (x * axes.col(0) + y * axes.col(1))).cast<float>(), direction};
  }
  Mat3d axes;
  Vec3f direction;
  Vec3d start;
  double radius;
  bool overSquare;
};

struct BandShots {
  explicit BandShots(const DirectionBand& band)
      : centre(band.centre),
        radius(band.radius),
        firstTurn(band.azimuth.from / (2.0 * std::numbers::pi)),
        turns((band.azimuth.to - band.azimuth.from) / (2.0 * std::numbers::pi)),
        lowest(std::sin(band.elevation.from)),
        rise(std::sin(band.elevation.to) - std::sin(band.elevation.from)) {}
  Ray ray(const std::array<double, 4>& u) const {
    // Uniform in solid angle: uniform in the sine of the elevation and around.
    const double up = std::clamp(lowest + u[0] * rise, -1.0, 1.0);
    const double level = std::sqrt(std::max(0.0, 1.0 - up * up));
    const auto [ahead, left] = pointOnCircle(firstTurn + u[1] * turns);
    const Mat3d axes = axesAround(Vec3d(left * level, up, ahead * level).normalized());
    const auto [cosine, sine] = pointOnCircle(u[3]);
    const double r = radius * std::sqrt(u[2]);
    const Vec3d start = centre + startDistance(radius) * axes.col(2) + r * (cosine * axes.col(0) + sine * axes.col(1));
    return {start.cast<float>(), Vec3d(-axes.col(2)).cast<float>()};
  }
  Vec3d centre;
  double radius;
  double firstTurn;
  double turns;
  double lowest;
  double rise;
};

template <class Shots, class Numbers>
struct Made final : ShotGenerator::Maker {
  Made(Shots s, Numbers n) : shots(std::move(s)), numbers(std::move(n)) {}
  void make(std::uint64_t first, std::span<Ray> rays) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if constexpr (requires { shots.ray(numbers.two(first)); }) {
        rays[i] = shots.ray(numbers.two(first + i));
      } else {
        rays[i] = shots.ray(numbers.four(first + i));
      }
    }
  }
  Shots shots;
  Numbers numbers;
};

struct Listed final : ShotGenerator::Maker {
  explicit Listed(ShotList l) : list(std::move(l)) {}
  void make(std::uint64_t first, std::span<Ray> rays) const override {
    LORICA_CHECK(first + rays.size() <= list.rays->size(), "a shot beyond the list");
    std::copy_n(list.rays->begin() + static_cast<std::ptrdiff_t>(first), rays.size(), rays.begin());
  }
  ShotList list;
};

using MakerPointer = std::shared_ptr<const ShotGenerator::Maker>;

template <class Shots>
MakerPointer drawn(Shots shots, Sequence sequence, const stats::ShotKey& key) {
  if (sequence == Sequence::sobol) {
    return std::make_shared<Made<Shots, SobolNumbers>>(std::move(shots), SobolNumbers{stats::SobolPoints(key)});
  }
  LORICA_CHECK(sequence == Sequence::random, "a grid belongs to a parallel beam");
  return std::make_shared<Made<Shots, RandomNumbers>>(std::move(shots), RandomNumbers{key});
}

MakerPointer makerOf(const PointSource& point, Sequence sequence, const stats::ShotKey& key) {
  LORICA_CHECK(point.position != point.target, "a source stands off its target");
  switch (point.sampler) {
    case Sampler::rectangle:
      return drawn(RectangleShots(point), sequence, key);
    case Sampler::thesis:
      LORICA_CHECK(sequence == Sequence::random, "Eq 15 takes random numbers");
      return drawn(ThesisShots(point), sequence, key);
    case Sampler::cone:
    case Sampler::disk:
      break;
  }
  return drawn(ConeShots(point, point.halfAngle), sequence, key);
}

MakerPointer makerOf(const ParallelBeam& beam, Sequence sequence, const stats::ShotKey& key) {
  LORICA_CHECK(beam.radius > 0.0, "a beam has a width");
  if (sequence == Sequence::grid) {
    LORICA_CHECK(beam.gridSide > 0, "a grid has cells");
    return std::make_shared<Made<BeamShots, GridNumbers>>(BeamShots(beam, true), GridNumbers(key, beam.gridSide));
  }
  return drawn(BeamShots(beam, false), sequence, key);
}

MakerPointer makerOf(const DirectionBand& band, Sequence sequence, const stats::ShotKey& key) {
  LORICA_CHECK(band.radius > 0.0, "a beam has a width");
  return drawn(BandShots(band), sequence, key);
}

MakerPointer makerOf(const ShotList& list, Sequence sequence, const stats::ShotKey& /*key*/) {
  LORICA_CHECK(sequence == Sequence::random, "listed shots are as they are");
  return std::make_shared<Listed>(list);
}

}  // namespace

ShotGenerator::ShotGenerator(const Source& source, std::uint64_t seed, std::uint32_t trial)
    : measure_(measureOf(source)) {
  const stats::ShotKey key{seed, stats::sourceId(source.name), trial};
  maker_ = std::visit([&](const auto& shape) { return makerOf(shape, source.sequence, key); }, source.shape);
}

Ray ShotGenerator::shot(std::uint64_t number) const {
  Ray ray;
  maker_->make(number, {&ray, 1});
  return ray;
}

void ShotGenerator::shots(std::uint64_t first, std::span<Ray> rays) const {
  maker_->make(first, rays);
}

double ShotGenerator::weight(std::uint64_t count) const {
  return count == 0 ? 0.0 : measure_.total / static_cast<double>(count);
}

}  // namespace lorica::shotline
