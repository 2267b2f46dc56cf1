#include "body_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lorica/geometry/measures.h"
#include "lorica/raycast/caster.h"

namespace lorica::viscera {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

constexpr int samples = samplesPerEdge;

constexpr std::uint64_t bit(int x, int y, int z) {
  return std::uint64_t{1} << static_cast<unsigned>(x + samples * (y + samples * z));
}

/// A column of samples along z.
struct Column {
  const BodyGrid& grid;
  Samples& inside;
  int x, y;  // samples from the grid's low corner

  /// Marks the samples from `low` to `high` metres above the grid's floor.
  void mark(double low, double high) const {
    const double step = grid.cell / samples;
    const int first = std::max(0, static_cast<int>(std::ceil(low / step - 0.5)));
    const int end = std::min(samples * grid.cells[2], static_cast<int>(std::ceil(high / step - 0.5)));
    for (int s = first; s < end; ++s) {
      inside[grid.index(x / samples, y / samples, s / samples)] |= bit(x % samples, y % samples, s % samples);
    }
  }
};

void sampleColumn(const Column& column, raycast::Caster& caster, const Vec3f& start) {
  int winding = 0;
  double entered = 0.0;
  for (const raycast::Hit& hit : caster.cast({start, Vec3f::UnitZ()})) {
    if (!caster.isClosed(hit)) {
      continue;
    }
    const int before = winding;
    winding += hit.entering ? 1 : -1;
    if (before < 1 && winding >= 1) {
      entered = hit.t;
    } else if (before >= 1 && winding < 1) {
      const double floor = column.grid.origin.z() - static_cast<double>(start.z());
      column.mark(entered - floor, hit.t - floor);
    }
  }
}

}  // namespace

BodyGrid BodyGrid::over(const geometry::Box3d& box, double cell, int margin) {
  BodyGrid grid;
  grid.cell = cell;
  // Half a cell more, so that rounding takes no vertex out of the grid.
  const Vec3d around = Vec3d::Constant((margin + 0.5) * cell);
  grid.origin = box.min() - around;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    grid.cells[axis] = static_cast<int>(std::ceil((box.sizes()[a] + 2.0 * around[a]) / cell));
  }
  return grid;
}

std::array<int, 3> BodyGrid::place(std::size_t index) const {
  const auto nx = static_cast<std::size_t>(cells[0]);
  const auto ny = static_cast<std::size_t>(cells[1]);
  return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny), static_cast<int>(index / (nx * ny))};
}

std::optional<BodyGrid::Spot> BodyGrid::locate(const Vec3f& point) const {
  const Vec3d scaled = (point.cast<double>() - origin) / cell;
  const Vec3d low = scaled.array().floor();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!(low[axis] >= 0.0 && low[axis] < cells[static_cast<std::size_t>(axis)])) {
      return std::nullopt;
    }
  }
  return Spot{index(static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(low.z())),
              (scaled - low).cast<float>()};
}

Samples samplesInside(const BodyGrid& grid, const geometry::Positions& positions,
                      const std::shared_ptr<const raycast::MeshTopology>& topology, base::Threads threads) {
  Samples inside(grid.size(), 0);
  if (std::none_of(topology->closed.begin(), topology->closed.end(), [](bool closed) { return closed; })) {
    return inside;
  }
  raycast::Scene scene(raycast::SceneUse::manyRays);
  scene.add(positions, topology);
  scene.build();
  const geometry::Box3d box = geometry::bounds(positions);
  const double step = grid.cell / samples;
  const auto start = static_cast<float>(std::min(box.min().z(), grid.origin.z()) - grid.cell);
  // A range holds whole cells: a cell's word belongs to one range.
  base::parallelFor(static_cast<std::size_t>(grid.cells[1]), 1, threads, [&](std::size_t begin, std::size_t end) {
    raycast::Caster caster(scene);
    for (int row = samples * static_cast<int>(begin); row < samples * static_cast<int>(end); ++row) {
      for (int column = 0; column < samples * grid.cells[0]; ++column) {
        const double x = grid.origin.x() + (column + 0.5) * step;
        const double y = grid.origin.y() + (row + 0.5) * step;
        if (x >= box.min().x() && x <= box.max().x() && y >= box.min().y() && y <= box.max().y()) {
          sampleColumn({grid, inside, column, row}, caster, {static_cast<float>(x), static_cast<float>(y), start});
        }
      }
    }
  });
  return inside;
}

std::uint64_t sampleAt(const Vec3f& fraction) {
  const auto along = [&](Eigen::Index axis) {
    return std::clamp(static_cast<int>(fraction[axis] * samples), 0, samples - 1);
  };
  return bit(along(0), along(1), along(2));
}

float share(std::uint64_t set) {
  return static_cast<float>(std::popcount(set)) / (samples * samples * samples);
}

Vec3f centroid(std::uint64_t set) {
  Vec3f sum = Vec3f::Zero();
  for (int z = 0; z < samples; ++z) {
    for (int y = 0; y < samples; ++y) {
      for (int x = 0; x < samples; ++x) {
        if ((set & bit(x, y, z)) != 0) {
          sum += Vec3f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, static_cast<float>(z) + 0.5F);
        }
      }
    }
  }
  return sum / (samples * static_cast<float>(std::max(1, std::popcount(set))));
}

void flood(const BodyGrid& grid, const Samples& inside, int steps, Samples& seeds) {
  struct Sample {
    std::array<int, 3> at;
  };
  std::vector<Sample> front;
  for (std::size_t c = 0; c < seeds.size(); ++c) {
    const std::array<int, 3> cell = grid.place(c);
    for (int s = 0; seeds[c] != 0 && s < samples * samples * samples; ++s) {
      if ((seeds[c] >> static_cast<unsigned>(s) & 1U) != 0) {
        front.push_back({{samples * cell[0] + s % samples, samples * cell[1] + s / samples % samples,
                          samples * cell[2] + s / (samples * samples)}});
      }
    }
  }
  for (int step = 0; step < steps; ++step) {
    std::vector<Sample> next;
    for (const Sample& sample : front) {
      for (std::size_t side = 0; side < 6; ++side) {
        std::array<int, 3> at = sample.at;
        at[side / 2] += side % 2 == 0 ? 1 : -1;
        if (at[side / 2] < 0 || at[side / 2] >= samples * grid.cells[side / 2]) {
          continue;
        }
        const std::size_t cell = grid.index(at[0] / samples, at[1] / samples, at[2] / samples);
        const std::uint64_t here = bit(at[0] % samples, at[1] % samples, at[2] % samples);
        if ((inside[cell] & here) != 0 && (seeds[cell] & here) == 0) {
          seeds[cell] |= here;
          next.push_back({at});
        }
      }
    }
    front = std::move(next);
  }
}

}  // namespace lorica::viscera
