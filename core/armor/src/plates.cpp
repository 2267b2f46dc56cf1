#include "lorica/armor/plates.h"

#include <vector>

#include "lorica/base/error.h"
#include "plate_surface.h"

namespace lorica::armor {

using geometry::Triangle;
using geometry::TriangleMesh;

PlateSpec mediumSapi() {
  // resources/tables/plates.csv holds these numbers with their sources; a test keeps the two together.
  PlateSpec spec;
  spec.width = 0.2413;
  spec.height = 0.3175;
  spec.thickness = 0.019;
  spec.topWidth = 0.60 * spec.width;
  spec.cornerHeight = 0.050;
  spec.curvatureRadius = 0.400;
  spec.verticalCurvature = 1.0 / 1.000;
  spec.mass = 1.81;
  spec.source =
      "SAPI plate, size M: width and height from a published sizing guide; thickness, corner cut, curvature and mass "
      "from memory, unverified; bend in profile assumed (resources/tables/plates.csv)";
  return spec;
}

double frontalArea(const PlateSpec& spec) {
  return spec.width * spec.height - 0.5 * (spec.width - spec.topWidth) * spec.cornerHeight;
}

namespace {

constexpr double kSpacing = 0.014;

int steps(double length) {
  return std::max(2, static_cast<int>(std::lround(length / kSpacing)));
}

/// Heights of the rows of vertices; one row lies where the corners begin.
std::vector<double> rowHeights(const PlateSpec& spec) {
  std::vector<double> rows;
  const double straight = spec.height - spec.cornerHeight;
  const int below = steps(straight);
  const int above = steps(spec.cornerHeight);
  rows.reserve(static_cast<std::size_t>(below) + static_cast<std::size_t>(above) + 1);
  for (int i = 0; i < below; ++i) {
    rows.push_back(straight * i / below);
  }
  for (int i = 0; i <= above; ++i) {
    rows.push_back(straight + spec.cornerHeight * i / above);
  }
  return rows;
}

void addQuad(TriangleMesh& mesh, const std::array<std::uint32_t, 4>& corners, bool firstDiagonal) {
  const auto& [a, b, c, d] = corners;
  if (firstDiagonal) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  } else {
    mesh.triangles.push_back({a, b, d});
    mesh.triangles.push_back({b, c, d});
  }
}

}  // namespace

TriangleMesh plate(const PlateSpec& spec) {
  LORICA_CHECK(spec.width > 0.0 && spec.height > 0.0 && spec.thickness > 0.0 && spec.topWidth > 0.0,
               "a plate has positive lengths");
  LORICA_CHECK(spec.topWidth <= spec.width && spec.cornerHeight > 0.0 && spec.cornerHeight < spec.height,
               "the cut corners lie within the plate");
  LORICA_CHECK(spec.width < spec.curvatureRadius && 2.0 * spec.thickness < spec.curvatureRadius,
               "the plate is bent less than a half pipe");
  LORICA_CHECK(spec.verticalCurvature >= 0.0 && spec.verticalCurvature * spec.height < 1.0,
               "the plate is bent outward and less than a half pipe");
  const std::vector<double> heights = rowHeights(spec);
  const auto rows = static_cast<std::uint32_t>(heights.size());
  const auto columns = static_cast<std::uint32_t>(2 * steps(0.5 * spec.width) + 1);
  TriangleMesh mesh;
  for (const double depth : {0.0, 1.0}) {
    for (const double height : heights) {
      for (std::uint32_t i = 0; i < columns; ++i) {
        const double across = 2.0 * i / (columns - 1) - 1.0;
        mesh.positions.emplace_back(platePoint(spec, across, height, depth).cast<float>());
      }
    }
  }
  const auto front = [&](std::uint32_t row, std::uint32_t column) { return row * columns + column; };
  const auto back = [&](std::uint32_t row, std::uint32_t column) { return (rows + row) * columns + column; };
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const bool left = i < columns / 2;  // diagonals mirror each other, as the plate does
      addQuad(mesh, {front(j, i), front(j, i + 1), front(j + 1, i + 1), front(j + 1, i)}, left);
      addQuad(mesh, {back(j, i), back(j + 1, i), back(j + 1, i + 1), back(j, i + 1)}, left);
    }
    const std::uint32_t last = columns - 1;
    addQuad(mesh, {back(j, 0), front(j, 0), front(j + 1, 0), back(j + 1, 0)}, true);
    addQuad(mesh, {front(j, last), back(j, last), back(j + 1, last), front(j + 1, last)}, false);
  }
  for (std::uint32_t i = 0; i + 1 < columns; ++i) {
    const bool left = i < columns / 2;
    const std::uint32_t top = rows - 1;
    addQuad(mesh, {front(top, i), front(top, i + 1), back(top, i + 1), back(top, i)}, left);
    addQuad(mesh, {back(0, i), back(0, i + 1), front(0, i + 1), front(0, i)}, left);
  }
  return mesh;
}

namespace {

/// A point in the frame of platePoint(), by its way along the front face and its distance from that face.
geometry::Vec3d pointOverFace(const PlateSpec& spec, double across, double height, double off) {
  geometry::Vec3d p = bentPoint(spec, across / spec.curvatureRadius, height - 0.5 * spec.height, off);
  p.z() -= boxMiddle(spec);
  return p;
}

/// Half the arc of the front face, `margin` metres beyond the plate, at a height from -margin to height + margin.
double halfArcAt(const PlateSpec& spec, double height, double margin) {
  // The cut runs at 45 degrees or so: beyond it the margin counts square to the cut.
  const double run = 0.5 * (spec.width - spec.topWidth);
  const double lift = margin * (std::hypot(run, spec.cornerHeight) - run) / spec.cornerHeight;
  const double atCut = spec.height - spec.cornerHeight + lift;
  const double cut = std::clamp((height - atCut) / (spec.height + margin - atCut), 0.0, 1.0);
  const double wide = spec.curvatureRadius * std::asin(0.5 * spec.width / spec.curvatureRadius) + margin;
  const double top = spec.curvatureRadius * std::asin(0.5 * spec.topWidth / spec.curvatureRadius) + margin;
  return wide + cut * (top - wide);
}

/// The outline of a grid of rows and columns, counter-clockwise from the lower left corner.
std::vector<std::uint32_t> rimOf(std::uint32_t rows, std::uint32_t columns) {
  std::vector<std::uint32_t> rim;
  for (std::uint32_t i = 0; i + 1 < columns; ++i) {
    rim.push_back(i);
  }
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    rim.push_back(j * columns + columns - 1);
  }
  for (std::uint32_t i = columns - 1; i > 0; --i) {
    rim.push_back((rows - 1) * columns + i);
  }
  for (std::uint32_t j = rows - 1; j > 0; --j) {
    rim.push_back(j * columns);
  }
  return rim;
}

/// Quads between two rings of as many vertices, outward when the first ring runs counter-clockwise around what lies
/// before the second.
void addRing(TriangleMesh& mesh, const std::vector<std::uint32_t>& front, const std::vector<std::uint32_t>& back) {
  for (std::size_t k = 0; k < front.size(); ++k) {
    const std::size_t next = (k + 1) % front.size();
    addQuad(mesh, {back[k], back[next], front[next], front[k]}, true);
  }
}

}  // namespace

TriangleMesh plateCover(const PlateSpec& spec, double gap, double thickness) {
  LORICA_CHECK(gap > 0.0 && thickness > 0.0, "a cover with a gap and a thickness");
  std::vector<double> heights = rowHeights(spec);
  const auto rows = static_cast<std::uint32_t>(heights.size());
  const auto columns = static_cast<std::uint32_t>(2 * steps(0.5 * spec.width) + 1);
  const std::uint32_t grid = rows * columns;
  const std::vector<std::uint32_t> rim = rimOf(rows, columns);
  const auto ring = static_cast<std::uint32_t>(rim.size());
  TriangleMesh mesh;
  for (const double margin : {gap + thickness, gap}) {
    const auto place = [&](std::uint32_t vertex, double off) -> geometry::Vec3f {
      const double height = -margin + heights[vertex / columns] / spec.height * (spec.height + 2.0 * margin);
      const double across = 2.0 * (vertex % columns) / (columns - 1) - 1.0;
      return pointOverFace(spec, across * halfArcAt(spec, height, margin), height, off).cast<float>();
    };
    for (std::uint32_t v = 0; v < grid; ++v) {
      mesh.positions.emplace_back(place(v, margin));
    }
    for (const std::uint32_t v : rim) {
      mesh.positions.emplace_back(place(v, -0.9 * spec.thickness));
    }
  }
  const std::uint32_t inner = grid + ring;
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t v = j * columns + i;
      const bool left = i < columns / 2;
      addQuad(mesh, {v, v + 1, v + columns + 1, v + columns}, left);
      addQuad(mesh, {inner + v, inner + v + columns, inner + v + columns + 1, inner + v + 1}, left);
    }
  }
  const auto shifted = [&](std::uint32_t by) {
    std::vector<std::uint32_t> moved = rim;
    for (std::uint32_t& v : moved) {
      v += by;
    }
    return moved;
  };
  const auto backRing = [&](std::uint32_t first) {
    std::vector<std::uint32_t> back(ring);
    for (std::uint32_t k = 0; k < ring; ++k) {
      back[k] = first + k;
    }
    return back;
  };
  addRing(mesh, rim, backRing(grid));
  addRing(mesh, backRing(grid), backRing(inner + grid));
  addRing(mesh, backRing(inner + grid), shifted(inner));
  return mesh;
}

TriangleMesh boxOnPlate(const PlateSpec& spec, double left, double right, double low, double high, double bottom,
                        double top) {
  LORICA_CHECK(left < right && low < high && bottom < top, "a box with a size");
  const auto columns = static_cast<std::uint32_t>(steps(right - left) + 1);
  const auto rows = static_cast<std::uint32_t>(steps(high - low) + 1);
  const auto layers = static_cast<std::uint32_t>(steps(top - bottom) + 1);
  const std::vector<std::uint32_t> rim = rimOf(rows, columns);
  TriangleMesh mesh;
  const auto place = [&](std::uint32_t vertex, double off) -> geometry::Vec3f {
    const std::uint32_t row = vertex / columns;
    const double across = left + (right - left) * (vertex % columns) / (columns - 1);
    return pointOverFace(spec, across, low + (high - low) * row / (rows - 1), off).cast<float>();
  };
  const std::uint32_t grid = rows * columns;
  for (const double off : {top, bottom}) {
    for (std::uint32_t v = 0; v < grid; ++v) {
      mesh.positions.emplace_back(place(v, off));
    }
  }
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t v = j * columns + i;
      addQuad(mesh, {v, v + 1, v + columns + 1, v + columns}, true);
      addQuad(mesh, {grid + v, grid + v + columns, grid + v + columns + 1, grid + v + 1}, true);
    }
  }
  std::vector<std::uint32_t> before = rim;
  for (std::uint32_t k = 1; k < layers; ++k) {
    std::vector<std::uint32_t> ring = rim;
    for (std::uint32_t& v : ring) {
      if (k + 1 < layers) {
        mesh.positions.emplace_back(place(v, top + (bottom - top) * k / (layers - 1)));
        v = static_cast<std::uint32_t>(mesh.positions.size() - 1);
      } else {
        v += grid;
      }
    }
    addRing(mesh, before, ring);
    before = ring;
  }
  return mesh;
}

}  // namespace lorica::armor
