#include "source_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/base/units.h"

namespace lorica::viewport {

using geometry::Vec3d;
using study::SourceType;

namespace {

constexpr double sphereShare = 1.2;   ///< radius of spheres and bands, of the ball around the body
constexpr double compassShare = 1.1;  ///< likewise, of the compass
constexpr int listedMost = 60;

Vec3d out(double azimuth, double elevation) {
  return shotline::towards(base::radians(azimuth), base::radians(elevation));
}

/// Directions across an axis, the first of them level.
std::pair<Vec3d, Vec3d> across(const Vec3d& axis) {
  const Vec3d level = Vec3d::UnitY().cross(axis);
  const Vec3d first = level.norm() < 1e-9 ? axis.unitOrthogonal() : Vec3d(level.normalized());
  return {first, axis.cross(first)};
}

Polyline circle(const Vec3d& centre, const Vec3d& axis, double radius) {
  constexpr int steps = 72;
  const auto [u, v] = across(axis);
  Polyline line;
  for (int i = 0; i <= steps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / steps;
    line.emplace_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return line;
}

/// From one angle to another in steps of at most 5 degrees.
std::vector<double> stepsOf(double from, double to) {
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / 5.0)));
  std::vector<double> angles;
  for (int i = 0; i <= count; ++i) {
    angles.push_back(from + (to - from) * i / count);
  }
  return angles;
}

Polyline parallelOf(const Vec3d& centre, double radius, double elevation, double from, double to) {
  Polyline line;
  for (const double azimuth : stepsOf(from, to)) {
    line.emplace_back(centre + radius * out(azimuth, elevation));
  }
  return line;
}

Polyline meridianOf(const Vec3d& centre, double radius, double azimuth, double from, double to) {
  Polyline line;
  for (const double elevation : stepsOf(from, to)) {
    line.emplace_back(centre + radius * out(azimuth, elevation));
  }
  return line;
}

void addArrow(SourceShape& shape, const Vec3d& from, const Vec3d& to) {
  const Vec3d along = (to - from).normalized();
  const double barb = 0.12 * (to - from).norm();
  const auto [u, v] = across(along);
  shape.lines.push_back({from, to});
  shape.lines.push_back({to - barb * (along - 0.5 * u), to, to - barb * (along + 0.5 * u)});
  shape.lines.push_back({to - barb * (along - 0.5 * v), to, to - barb * (along + 0.5 * v)});
}

void addPoint(SourceShape& shape, const study::Source& source, const Vec3d& aim, double radius) {
  shape.balls.push_back(source.position);
  shape.lines.push_back({source.position, aim});
  const Vec3d axis = aim - source.position;
  const double distance = axis.norm();
  if (distance < 1e-9 || source.sampler == study::Sampler::thesis) {
    return;
  }
  Polyline window;
  if (source.sampler == study::Sampler::rectangle) {
    const auto [u, v] = across(-axis / distance);
    const Vec3d w = 0.5 * source.width * u;
    const Vec3d h = 0.5 * source.height * v;
    window = {aim - w - h, aim + w - h, aim + w + h, aim - w + h, aim - w - h};
  } else {
    // A cone that would reach too far to the side bounds nothing: it is drawn as far as it goes.
    const double reach = source.sampler == study::Sampler::disk ? source.radius : std::min(radius, 3.0 * distance);
    window = circle(aim, axis / distance, reach);
  }
  for (const double share : {0.0, 0.25, 0.5, 0.75}) {
    const std::size_t corner = static_cast<std::size_t>(share * static_cast<double>(window.size() - 1));
    shape.lines.push_back({source.position, window[corner]});
  }
  shape.lines.push_back(std::move(window));
}

void addBeam(SourceShape& shape, const study::Source& source, const Vec3d& aim, double radius) {
  const Vec3d axis = out(source.azimuth.from, source.elevation.from);
  const auto [u, v] = across(axis);
  const Vec3d middle = aim + 1.6 * radius * axis;
  if (source.sequence == study::Sequence::grid) {
    const double cells = source.cell > 0.0 ? std::ceil(2.0 * radius / source.cell) : 1.0;
    // More lines than can be told apart are no grid to the eye.
    const int lines = static_cast<int>(std::min(cells, 12.0));
    for (int i = 0; i <= lines; ++i) {
      const double at = radius * (2.0 * i / lines - 1.0);
      shape.lines.push_back({middle + at * u - radius * v, middle + at * u + radius * v});
      shape.lines.push_back({middle + at * v - radius * u, middle + at * v + radius * u});
    }
  } else {
    shape.lines.push_back(circle(middle, axis, radius));
  }
  for (const double x : {-0.6, 0.0, 0.6}) {
    for (const double y : {-0.6, 0.0, 0.6}) {
      const Vec3d from = middle + radius * (x * u + y * v);
      addArrow(shape, from, from - 0.45 * radius * axis);
    }
  }
}

void addBand(SourceShape& shape, const study::DegreeRange& azimuth, const study::DegreeRange& elevation,
             const Vec3d& aim, double radius, double lines) {
  const double reach = sphereShare * radius;
  const auto inner = [lines](const study::DegreeRange& range) {
    std::vector<double> angles{range.from};
    for (double angle = std::ceil(range.from / lines) * lines; angle < range.to; angle += lines) {
      angles.push_back(angle);
    }
    angles.push_back(range.to);
    return angles;
  };
  for (const double level : inner(elevation)) {
    shape.lines.push_back(parallelOf(aim, reach, level, azimuth.from, azimuth.to));
  }
  for (const double around : inner(azimuth)) {
    shape.lines.push_back(meridianOf(aim, reach, around, elevation.from, elevation.to));
  }
}

void addListed(SourceShape& shape, const Vec3d& aim, double radius, std::span<const raycast::Ray> rays) {
  const std::size_t step = std::max<std::size_t>(1, rays.size() / listedMost);
  for (std::size_t i = 0; i < rays.size(); i += step) {
    const Vec3d from = rays[i].origin.cast<double>();
    const Vec3d along = rays[i].direction.cast<double>().normalized();
    shape.lines.push_back({from, from + ((aim - from).norm() + radius) * along});
  }
}

/// Where a source is seen at, degrees; of a band its middle.
std::pair<double, double> directionOf(const study::Source& source, const Vec3d& aim) {
  switch (source.type) {
    case SourceType::point: {
      const Vec3d from = source.position - aim;
      return {base::degrees(std::atan2(from.x(), from.z())),
              base::degrees(std::atan2(from.y(), std::hypot(from.x(), from.z())))};
    }
    case SourceType::parallel:
      return {source.azimuth.from, source.elevation.from};
    case SourceType::band:
      return {0.5 * (source.azimuth.from + source.azimuth.to), 0.5 * (source.elevation.from + source.elevation.to)};
    case SourceType::sphere:
    case SourceType::list:
      break;
  }
  return {0.0, 0.0};
}

QString degreesText(double angle) {
  const double tenths = std::round(10.0 * angle) / 10.0;
  // Small angles below zero round to a zero without a sign.
  return QString::number(tenths == 0.0 ? 0.0 : tenths) + u'°';
}

QString azimuthText(int azimuth) {
  switch (azimuth) {
    case 0:
      return QStringLiteral("azimuth 0°, front");
    case 90:
      return QStringLiteral("90°, left");
    case 180:
      return QStringLiteral("180°, back");
    case 270:
      return QStringLiteral("270°, right");
    default:
      return degreesText(azimuth);
  }
}

void addAzimuths(Compass& compass, const Vec3d& aim, double reach) {
  compass.lines.push_back(parallelOf(aim, reach, 0.0, 0.0, 360.0));
  for (int azimuth = 0; azimuth < 360; azimuth += 10) {
    const double length = azimuth % 30 == 0 ? 0.06 : 0.03;
    const Vec3d to = out(azimuth, 0.0);
    compass.lines.push_back({aim + reach * to, aim + (1.0 + length) * reach * to});
    if (azimuth % 30 == 0) {
      compass.labels.push_back({aim + 1.13 * reach * to, azimuthText(azimuth), azimuth % 90 == 0});
    }
  }
  // The sense in which it grows, from the front to the person's left.
  const Vec3d tip = aim + 1.03 * reach * out(24.0, 0.0);
  compass.lines.push_back({aim + 1.05 * reach * out(20.0, 0.0), tip, aim + 1.01 * reach * out(20.0, 0.0)});
  compass.lines.push_back(parallelOf(aim, 1.03 * reach, 0.0, 0.0, 24.0));
}

void addElevations(Compass& compass, const Vec3d& aim, double reach, double azimuth) {
  compass.lines.push_back(meridianOf(aim, reach, azimuth, -90.0, 90.0));
  for (int elevation = -90; elevation <= 90; elevation += 15) {
    const Vec3d to = out(azimuth, elevation);
    compass.lines.push_back({aim + reach * to, aim + 1.04 * reach * to});
    if (elevation != 0 && elevation % 30 == 0) {
      const QString text = elevation == 90 ? QStringLiteral("elevation 90°, above") : degreesText(elevation);
      compass.labels.push_back({aim + 1.1 * reach * to, text, elevation == 90});
    }
  }
}

}  // namespace

SourceShape shapeOf(const study::Source& source, const Vec3d& aim, double radius,
                    std::span<const raycast::Ray> listed) {
  SourceShape shape;
  switch (source.type) {
    case SourceType::point:
      addPoint(shape, source, aim, radius);
      break;
    case SourceType::parallel:
      addBeam(shape, source, aim, radius);
      break;
    case SourceType::band:
      addBand(shape, source.azimuth, source.elevation, aim, radius, 15.0);
      break;
    case SourceType::sphere:
      addBand(shape, {0.0, 360.0}, {-90.0, 90.0}, aim, radius, 30.0);
      break;
    case SourceType::list:
      addListed(shape, aim, radius, listed);
      break;
  }
  return shape;
}

std::optional<Compass> compassOf(const study::Source& source, const Vec3d& aim, double radius, double floor) {
  if (source.type == SourceType::list) {
    return std::nullopt;
  }
  Compass compass;
  const double reach = compassShare * radius;
  const auto [azimuth, elevation] = directionOf(source, aim);
  const Vec3d below(aim.x(), floor, aim.z());
  addAzimuths(compass, below, reach);
  addElevations(compass, aim, reach, azimuth);
  if (source.type == SourceType::point || source.type == SourceType::parallel) {
    const Vec3d to = out(azimuth, elevation);
    compass.strong.push_back({below, below + reach * out(azimuth, 0.0)});
    compass.strong.push_back(meridianOf(aim, reach, azimuth, 0.0, elevation));
    compass.strong.push_back({aim, aim + reach * to});
    compass.labels.push_back(
        {aim + 1.2 * reach * to,
         QStringLiteral("azimuth %1, elevation %2").arg(degreesText(azimuth), degreesText(elevation)), true, true});
  } else if (source.type == SourceType::band) {
    compass.strong.push_back(parallelOf(below, reach, 0.0, source.azimuth.from, source.azimuth.to));
    compass.strong.push_back(meridianOf(aim, reach, azimuth, source.elevation.from, source.elevation.to));
  }
  return compass;
}

}  // namespace lorica::viewport
