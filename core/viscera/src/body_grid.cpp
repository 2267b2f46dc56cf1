#include "body_grid.h"

#include <algorithm>
#include <cmath>

#include "lorica/geometry/measures.h"
#include "lorica/raycast/caster.h"

namespace lorica::viscera {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

constexpr int samples = 4;  // along each axis of a cell

/// The points of a column of samples, from `low` to `high` metres above the grid's floor, counted into their cells.
struct Column {
  const BodyGrid& grid;
  CellFill& fill;
  int i, j;
  float x, y;  // fractions

  void add(double low, double high) const {
    const double step = grid.cell / samples;
    const int first = std::max(0, static_cast<int>(std::ceil(low / step - 0.5)));
    const int end = std::min(samples * grid.cells[2], static_cast<int>(std::ceil(high / step - 0.5)));
    for (int s = first; s < end; ++s) {
      const std::size_t cell = grid.index(i, j, s / samples);
      fill.share[cell] += 1.0F;
      fill.centroid[cell] += Vec3f(x, y, (static_cast<float>(s % samples) + 0.5F) / samples);
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
      column.add(entered - floor, hit.t - floor);
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

CellFill cellFill(const BodyGrid& grid, const geometry::Positions& positions,
                  const std::shared_ptr<const raycast::MeshTopology>& topology, base::Threads threads) {
  CellFill fill;
  fill.share.assign(grid.size(), 0.0F);
  fill.centroid.assign(grid.size(), Vec3f::Zero());
  if (std::none_of(topology->closed.begin(), topology->closed.end(), [](bool closed) { return closed; })) {
    return fill;
  }
  raycast::Scene scene(raycast::SceneUse::manyRays);
  scene.add(positions, topology);
  scene.build();
  const geometry::Box3d box = geometry::bounds(positions);
  const double step = grid.cell / samples;
  const auto start = static_cast<float>(std::min(box.min().z(), grid.origin.z()) - grid.cell);
  base::parallelFor(static_cast<std::size_t>(grid.cells[1]), 1, threads, [&](std::size_t begin, std::size_t end) {
    raycast::Caster caster(scene);
    for (int row = samples * static_cast<int>(begin); row < samples * static_cast<int>(end); ++row) {
      for (int column = 0; column < samples * grid.cells[0]; ++column) {
        const double x = grid.origin.x() + (column + 0.5) * step;
        const double y = grid.origin.y() + (row + 0.5) * step;
        if (x >= box.min().x() && x <= box.max().x() && y >= box.min().y() && y <= box.max().y()) {
          sampleColumn({grid, fill, column / samples, row / samples,
                        (static_cast<float>(column % samples) + 0.5F) / samples,
                        (static_cast<float>(row % samples) + 0.5F) / samples},
                       caster, {static_cast<float>(x), static_cast<float>(y), start});
        }
      }
    }
  });
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (fill.share[cell] > 0.0F) {
      fill.centroid[cell] /= fill.share[cell];
      fill.share[cell] /= samples * samples * samples;
    }
  }
  return fill;
}

void growInside(const BodyGrid& grid, const CellFill& inside, int rings, std::vector<char>& marked) {
  std::vector<std::size_t> front;
  for (std::size_t cell = 0; cell < marked.size(); ++cell) {
    if (marked[cell] != 0) {
      front.push_back(cell);
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<std::size_t> next;
    for (const std::size_t cell : front) {
      const std::array<int, 3> at = grid.place(cell);
      for (std::size_t side = 0; side < 6; ++side) {
        std::array<int, 3> beside = at;
        beside[side / 2] += side % 2 == 0 ? 1 : -1;
        if (beside[side / 2] < 0 || beside[side / 2] >= grid.cells[side / 2]) {
          continue;
        }
        const std::size_t neighbour = grid.index(beside[0], beside[1], beside[2]);
        if (marked[neighbour] == 0 && inside.share[neighbour] > 0.0F) {
          marked[neighbour] = 1;
          next.push_back(neighbour);
        }
      }
    }
    front = std::move(next);
  }
}

}  // namespace lorica::viscera
