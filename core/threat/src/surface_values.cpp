#include "lorica/threat/surface_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lorica/base/error.h"

namespace lorica::threat {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// Of the part above zero of what runs evenly from `a` to `b`, over a unit of time.
double positiveMean(double a, double b) {
  if (a >= 0.0 && b >= 0.0) {
    return 0.5 * (a + b);
  }
  const double high = std::max(a, b);
  return high <= 0.0 ? 0.0 : 0.5 * high * high / std::abs(a - b);
}

void exposeVertex(const FieldSampler& sampler, std::size_t attribute, const Vec3d& place, std::size_t vertex,
                  Exposure& result) {
  const std::vector<Step>& steps = sampler.field().steps;
  Stencil stencil;
  std::optional<double> before;
  std::optional<double> peak;
  std::optional<double> integral;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    if (s == 0 || !sampler.samePoints(s - 1, s)) {
      stencil = sampler.stencil(place, s);
    }
    const std::optional<double> here = sampler.value(stencil, s, attribute);
    if (here && (!peak || *here > *peak)) {
      peak = here;
      result.peakTime[vertex] = steps[s].time;
    }
    if (here && before) {
      integral = integral.value_or(0.0) + positiveMean(*before, *here) * (steps[s].time - steps[s - 1].time);
    }
    before = here;
  }
  result.peak[vertex] = peak ? static_cast<float>(*peak) : none;
  if (!result.integral.empty()) {
    result.integral[vertex] = integral ? static_cast<float>(*integral) : none;
  }
}

}  // namespace

Exposure exposure(const FieldSampler& sampler, std::size_t attribute, std::span<const Vec3f> positions,
                  base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(attribute < sampler.field().attributes.size(), "an attribute of the field");
  const std::size_t count = positions.size();
  Exposure result;
  result.peak.assign(count, none);
  result.peakTime.assign(count, std::numeric_limits<double>::quiet_NaN());
  result.integral.assign(sampler.field().steps.size() > 1 ? count : 0, none);
  base::parallelFor(count, 64, threads, [&](std::size_t begin, std::size_t end) {
    if (progress.cancelled()) {
      return;
    }
    for (std::size_t v = begin; v < end; ++v) {
      exposeVertex(sampler, attribute, positions[v].cast<double>(), v, result);
    }
  });
  progress.check();
  return result;
}

double shareOfTriangleAbove(std::array<double, 3> corners, double threshold) {
  std::sort(corners.begin(), corners.end());
  const auto& [low, middle, high] = corners;
  if (high <= threshold) {
    return 0.0;
  }
  if (low > threshold) {
    return 1.0;
  }
  if (middle <= threshold) {
    return (high - threshold) / (high - low) * ((high - threshold) / (high - middle));
  }
  return 1.0 - (threshold - low) / (high - low) * ((threshold - low) / (middle - low));
}

SurfaceStatistics surfaceStatistics(std::span<const Vec3f> positions, std::span<const geometry::Triangle> triangles,
                                    std::span<const float> values, std::optional<double> threshold) {
  LORICA_CHECK(values.size() == positions.size(), "a value per position");
  SurfaceStatistics result;
  double integral = 0.0;
  double above = 0.0;
  for (const geometry::Triangle& triangle : triangles) {
    const auto corner = [&](std::size_t k) { return positions[triangle.at(k)].cast<double>(); };
    const double area = 0.5 * Vec3d((corner(1) - corner(0)).cross(corner(2) - corner(0))).norm();
    result.area += area;
    std::array<double, 3> here{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangle.at(k);
      const float value = values[vertex];
      here.at(k) = static_cast<double>(value);
      const bool greater = !result.max || value > *result.max || (value == *result.max && vertex < *result.maxVertex);
      if (!std::isnan(value) && greater) {
        result.max = value;
        result.maxVertex = vertex;
      }
    }
    if (std::any_of(here.begin(), here.end(), [](double value) { return std::isnan(value); })) {
      continue;
    }
    result.areaWithValue += area;
    integral += area * (here[0] + here[1] + here[2]) / 3.0;
    above += threshold ? area * shareOfTriangleAbove(here, *threshold) : 0.0;
  }
  if (result.areaWithValue > 0.0) {
    result.mean = integral / result.areaWithValue;
    if (threshold) {
      result.shareAbove = above / result.areaWithValue;
    }
  }
  return result;
}

}  // namespace lorica::threat
