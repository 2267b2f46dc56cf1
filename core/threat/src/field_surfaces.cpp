#include "lorica/threat/field_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lorica/base/error.h"
#include "lorica/geometry/isosurface.h"

namespace lorica::threat {

using geometry::Box3d;
using geometry::Positions;
using geometry::Vec3d;

namespace {

/// Number of points of a grid that covers `length`.
double pointsOver(double length, double spacing) {
  return std::ceil(length / spacing * (1.0 - 1e-9)) + 1.0;
}

void refuseTooMany(double points, double most, double spacing) {
  if (!(points <= most)) {
    throw base::InputError("", "",
                           fmt::format("a spacing of {:g} m makes {:.0f} points, more than {:.0f}; choose a wider one",
                                       spacing, points, most));
  }
}

/// Two unit vectors across a normal, along the scene's axes where it is one of them.
std::array<Vec3d, 2> axesAcross(const Vec3d& normal) {
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3d first = Vec3d::Unit(least).cross(normal).normalized();
  return {first, normal.cross(first)};
}

/// How far a box reaches along a direction from a point.
std::array<double, 2> reach(const Box3d& box, const Vec3d& point, const Vec3d& direction) {
  std::array<double, 2> ends{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int c = 0; c < 8; ++c) {
    const double along = direction.dot(box.corner(static_cast<Box3d::CornerType>(c)) - point);
    ends = {std::min(ends[0], along), std::max(ends[1], along)};
  }
  return ends;
}

/// Keeps the vertices that triangles use.
ColouredSurface used(const ColouredSurface& all) {
  ColouredSurface kept;
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(all.mesh.positions.size(), none);
  for (const geometry::Triangle& triangle : all.mesh.triangles) {
    geometry::Triangle moved{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& at = place[triangle.at(k)];
      if (at == none) {
        at = static_cast<std::uint32_t>(kept.mesh.positions.size());
        kept.mesh.positions.push_back(all.mesh.positions[triangle.at(k)]);
        kept.values.push_back(all.values[triangle.at(k)]);
      }
      moved.at(k) = at;
    }
    kept.mesh.triangles.push_back(moved);
  }
  return kept;
}

}  // namespace

ColouredSurface slice(const FieldSampler& sampler, std::size_t attribute, double time, const Plane& plane,
                      double spacing, base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(spacing > 0.0 && plane.normal.norm() > 0.0, "a spacing and a direction");
  const Box3d box = sampler.field().bounds();
  const double margin = sampler.radius();
  const Box3d wide(box.min() - Vec3d::Constant(margin), box.max() + Vec3d::Constant(margin));
  const Vec3d normal = plane.normal.normalized();
  const std::array<Vec3d, 2> across = axesAcross(normal);
  const std::array<double, 2> u = reach(wide, plane.point, across[0]);
  const std::array<double, 2> v = reach(wide, plane.point, across[1]);
  const double columns = pointsOver(u[1] - u[0], spacing);
  const double rows = pointsOver(v[1] - v[0], spacing);
  refuseTooMany(columns * rows, 0x1p24, spacing);
  const auto width = static_cast<std::size_t>(columns);
  const auto height = static_cast<std::size_t>(rows);
  ColouredSurface all;
  all.mesh.positions.resize(width * height);
  for (std::size_t p = 0; p < all.mesh.positions.size(); ++p) {
    // The last column and row end with the box, so that nothing at its end is lost.
    const double along = std::min(u[0] + spacing * static_cast<double>(p % width), u[1]);
    const double up = std::min(v[0] + spacing * static_cast<double>(p / width), v[1]);
    all.mesh.positions[p] = (plane.point + along * across[0] + up * across[1]).cast<float>();
  }
  all.values = sampler.values(all.mesh.positions, time, attribute, threads);
  progress.check();
  for (std::size_t row = 0; row + 1 < height; ++row) {
    for (std::size_t column = 0; column + 1 < width; ++column) {
      const auto a = static_cast<std::uint32_t>(row * width + column);
      const auto b = a + 1;
      const auto c = static_cast<std::uint32_t>(a + width);
      const auto d = c + 1;
      if (!std::isnan(all.values[a] + all.values[b] + all.values[c] + all.values[d])) {
        all.mesh.triangles.push_back({a, b, d});
        all.mesh.triangles.push_back({a, d, c});
      }
    }
  }
  return used(all);
}

ThreatField onLattice(const FieldSampler& sampler, std::size_t attribute, double time, double spacing,
                      base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(spacing > 0.0, "a spacing");
  const Box3d box = sampler.field().bounds();
  ThreatField result;
  result.attributes = {{sampler.field().attributes.at(attribute).name, sampler.field().attributes.at(attribute).unit}};
  Lattice& lattice = result.lattice.emplace();
  double points = 1.0;
  for (const double length : box.sizes()) {
    points *= pointsOver(length, spacing);
  }
  refuseTooMany(points, 0x1p27, spacing);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const auto count = static_cast<std::size_t>(pointsOver(box.sizes()[a], spacing));
    for (std::size_t i = 0; i < count; ++i) {
      lattice.axes.at(axis).push_back(box.min()[a] + spacing * static_cast<double>(i));
    }
  }
  std::vector<float>& values = result.steps.emplace_back().values.emplace_back(lattice.points());
  const std::size_t layer = lattice.axes[0].size();
  base::parallelFor(lattice.points() / layer, 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t line = begin; line < end && !progress.cancelled(); ++line) {
      for (std::size_t i = line * layer; i < (line + 1) * layer; ++i) {
        const std::optional<double> here = sampler.value(lattice.place(i), time, attribute);
        values[i] = here ? static_cast<float>(*here) : std::numeric_limits<float>::quiet_NaN();
      }
    }
  });
  progress.check();
  return result;
}

ColouredSurface levelSurface(const FieldSampler& sampler, std::size_t attribute, double time, double level,
                             const LevelOptions& options, base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(std::isfinite(level), "a level");
  const double cell = options.spacing.value_or(typicalSpacing(sampler.field()));
  if (!(cell > 0.0)) {
    throw base::InputError("", "", "the data lie at one place; a surface needs a volume");
  }
  const ThreatField volume = onLattice(sampler, attribute, time, cell, threads, progress.part(0.0, 0.7));
  const Lattice& lattice = *volume.lattice;
  const std::vector<float>& values = volume.steps.front().values.front();
  double widest = 0.0;
  for (const float value : values) {
    widest = std::isnan(value) ? widest : std::max(widest, std::abs(static_cast<double>(value) - level));
  }
  // About lengths, as isosurface() expects them; a layer of "outside" around the data closes the surface.
  const double scale = widest > 0.0 ? cell / widest : 0.0;
  const double outside = 10.0 * cell;
  const std::array<long, 3> counts{static_cast<long>(lattice.axes[0].size()), static_cast<long>(lattice.axes[1].size()),
                                   static_cast<long>(lattice.axes[2].size())};
  const Vec3d first(lattice.axes[0].front(), lattice.axes[1].front(), lattice.axes[2].front());
  const auto field = [&](const Vec3d& place) {
    const Vec3d steps = (place - first) / cell;
    std::array<long, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at.at(axis) = std::lround(steps[static_cast<Eigen::Index>(axis)]);
      if (at.at(axis) < 0 || at.at(axis) >= counts.at(axis)) {
        return outside;
      }
    }
    const float value = values[static_cast<std::size_t>((at[2] * counts[1] + at[1]) * counts[0] + at[0])];
    return std::isnan(value) ? outside : scale * (level - static_cast<double>(value));
  };
  const Vec3d last(lattice.axes[0].back(), lattice.axes[1].back(), lattice.axes[2].back());
  ColouredSurface surface;
  // A little less than a cell at the far side: rounding must not add a layer more than the one wanted.
  surface.mesh =
      geometry::isosurface(field, Box3d(first - Vec3d::Constant(cell), last + Vec3d::Constant(0.999 * cell)), cell);
  progress.check();
  surface.mesh.positions = geometry::taubinSmoothed(surface.mesh, options.smoothing);
  surface.values = sampler.values(surface.mesh.positions, time, options.colour.value_or(attribute), threads);
  return surface;
}

}  // namespace lorica::threat
