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
  spec.mass = 1.81;
  spec.source =
      "SAPI plate, size M: width and height from a published sizing guide; thickness, corner cut, curvature and mass "
      "from memory, unverified (resources/tables/plates.csv)";
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

}  // namespace lorica::armor
