#include "lorica/viscera/lattice.h"

#include <algorithm>
#include <cmath>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::viscera {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

std::array<int, 3> cellCounts(const Vec3d& size, const LatticeOptions& options) {
  std::array<int, 3> counts{1, 1, 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    switch (options.layout) {
      case LatticeOptions::Layout::boundingBox:
        break;
      case LatticeOptions::Layout::uniform:
        counts[axis] = options.cells[0];
        break;
      case LatticeOptions::Layout::perAxis:
        counts[axis] = options.cells[axis];
        break;
      case LatticeOptions::Layout::cellSize:
        LORICA_CHECK(options.cellMetres > 0.0, "a cell size in metres");
        counts[axis] = std::clamp(
            static_cast<int>(std::lround(size[static_cast<Eigen::Index>(axis)] / options.cellMetres)), 1, 1000);
        break;
    }
    LORICA_CHECK(counts[axis] >= 1 && counts[axis] <= 1000, "1 to 1000 cells along each axis");
  }
  return counts;
}

/// Numbers the control points of a full lattice, x fastest.
struct Grid {
  std::array<std::size_t, 3> points;

  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return i + points[0] * (j + points[1] * k); }
};

/// Number of a cell's corner `c` among the control points.
std::size_t cornerOf(const Grid& grid, const std::array<std::size_t, 3>& cell, std::size_t c) {
  const auto step = [c](std::size_t axis) { return static_cast<std::size_t>(cornerDigits[c][axis]); };
  return grid.index(cell[0] + step(0), cell[1] + step(1), cell[2] + step(2));
}

}  // namespace

double controlPointsAsked(const geometry::Box3d& box, const LatticeOptions& options) {
  const std::array<int, 3> cells = cellCounts(box.sizes(), options);
  return (cells[0] + 1.0) * (cells[1] + 1.0) * (cells[2] + 1.0);
}

Lattice makeLattice(std::span<const Vec3f> positions, const LatticeOptions& options) {
  LORICA_CHECK(!positions.empty(), "a lattice needs vertices");
  const geometry::Box3d box = geometry::bounds(positions);
  Lattice lattice;
  lattice.cells = cellCounts(box.sizes(), options);
  // A flat model still gets cells with a volume.
  const Vec3d size = box.sizes().cwiseMax(1e-6);
  lattice.origin = box.center() - 0.5 * size;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    lattice.cell[axis] = size[axis] / lattice.cells[static_cast<std::size_t>(axis)];
  }
  const std::array<std::size_t, 3> cells{static_cast<std::size_t>(lattice.cells[0]),
                                         static_cast<std::size_t>(lattice.cells[1]),
                                         static_cast<std::size_t>(lattice.cells[2])};
  const Grid grid{{cells[0] + 1, cells[1] + 1, cells[2] + 1}};
  LORICA_CHECK(controlPointsAsked(box, options) <= latticeLimit, "a lattice of at most 5e6 control points");

  std::vector<std::uint32_t> cellNumber(cells[0] * cells[1] * cells[2], UINT32_MAX);
  std::vector<std::array<std::size_t, 3>> usedCells;
  lattice.cellOf.reserve(positions.size());
  lattice.fraction.reserve(positions.size());
  for (const Vec3f& position : positions) {
    const Vec3d scaled = (position.cast<double>() - lattice.origin).cwiseQuotient(lattice.cell);
    std::array<std::size_t, 3> at{};
    Vec3d fraction;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double s = std::max(0.0, scaled[static_cast<Eigen::Index>(axis)]);
      at[axis] = std::min(static_cast<std::size_t>(s), cells[axis] - 1);
      fraction[static_cast<Eigen::Index>(axis)] = std::min(1.0, s - static_cast<double>(at[axis]));
    }
    std::uint32_t& number = cellNumber[at[0] + cells[0] * (at[1] + cells[1] * at[2])];
    if (number == UINT32_MAX) {
      number = static_cast<std::uint32_t>(usedCells.size());
      usedCells.push_back(at);
    }
    lattice.cellOf.push_back(number);
    lattice.fraction.emplace_back(fraction.cast<float>());
  }

  const std::size_t allPoints = grid.points[0] * grid.points[1] * grid.points[2];
  std::vector<char> keep(allPoints, options.prune ? 0 : 1);
  for (const auto& at : usedCells) {
    for (std::size_t c = 0; c < 8; ++c) {
      keep[cornerOf(grid, at, c)] = 1;
    }
  }
  std::vector<std::uint32_t> pointNumber(allPoints, UINT32_MAX);
  for (std::size_t k = 0; k < grid.points[2]; ++k) {
    for (std::size_t j = 0; j < grid.points[1]; ++j) {
      for (std::size_t i = 0; i < grid.points[0]; ++i) {
        const std::size_t index = grid.index(i, j, k);
        if (keep[index] != 0) {
          pointNumber[index] = static_cast<std::uint32_t>(lattice.controlPoints.size());
          lattice.controlPoints.emplace_back(
              lattice.origin +
              lattice.cell.cwiseProduct(Vec3d(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))));
        }
      }
    }
  }
  lattice.pruned = allPoints - lattice.controlPoints.size();
  lattice.cellCorners.reserve(usedCells.size());
  for (const auto& at : usedCells) {
    std::array<std::uint32_t, 8>& corners = lattice.cellCorners.emplace_back();
    for (std::size_t c = 0; c < 8; ++c) {
      corners[c] = pointNumber[cornerOf(grid, at, c)];
    }
  }
  return lattice;
}

void deform(std::span<const Vec3f> rest, const Embedding& lattice, std::span<const Vec3f> offsets,
            std::span<Vec3f> posed, base::Threads threads) {
  LORICA_CHECK(rest.size() == lattice.cellOf.size() && posed.size() == rest.size(), "the lattice's own vertices");
  // A vector register for each corner of a cell. What goes back, not forth: taking +0 from -0 leaves it -0.
  using Lanes = Eigen::Vector4f;
  std::vector<std::array<Lanes, 8>> back(lattice.cellCorners.size());
  for (std::size_t cell = 0; cell < back.size(); ++cell) {
    for (std::size_t c = 0; c < 8; ++c) {
      const Vec3f& offset = offsets[lattice.cellCorners[cell][c]];
      back[cell][c] = Lanes(0.0F - offset.x(), 0.0F - offset.y(), 0.0F - offset.z(), 0.0F);
    }
  }
  base::parallelFor(rest.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::array<Lanes, 8>& corner = back[lattice.cellOf[v]];
      const Vec3f& d = lattice.fraction[v];
      const float x = d.x();
      const Lanes c00 = corner[0] * (1.0F - x) + corner[1] * x;
      const Lanes c01 = corner[2] * (1.0F - x) + corner[3] * x;
      const Lanes c10 = corner[4] * (1.0F - x) + corner[5] * x;
      const Lanes c11 = corner[6] * (1.0F - x) + corner[7] * x;
      const Lanes c0 = c00 * (1.0F - d.y()) + c10 * d.y();
      const Lanes c1 = c01 * (1.0F - d.y()) + c11 * d.y();
      const Lanes offset = c0 * (1.0F - d.z()) + c1 * d.z();
      posed[v] = rest[v] - offset.head<3>();
    }
  });
}

}  // namespace lorica::viscera
