#include "lorica/geometry/isosurface.h"

#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/weld.h"

namespace lorica::geometry {

namespace {

/// A grid that covers a box, and what fills it with the field's values.
struct Grid {
  std::array<int, 3> points{};
  vtkNew<vtkImageData> image;
  double* values = nullptr;
  Vec3d origin;
  double cell;

  Grid(const Box3d& box, double cellSize) : origin(box.min()), cell(cellSize) {
    LORICA_CHECK(cell > 0.0 && !box.isEmpty(), "a grid needs a box and a cell size");
    double total = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double count = std::ceil(box.sizes()[axis] / cell) + 1.0;
      total *= count;
      LORICA_CHECK(total <= 268435456.0, "at most 2^28 grid points");
      points[static_cast<std::size_t>(axis)] = static_cast<int>(count);
    }
    image->SetDimensions(points[0], points[1], points[2]);
    image->SetSpacing(cell, cell, cell);
    image->SetOrigin(origin.x(), origin.y(), origin.z());
    image->AllocateScalars(VTK_DOUBLE, 1);
    values = static_cast<double*>(image->GetScalarPointer());
  }

  Vec3d place(int i, int j, int k) const { return origin + cell * Vec3d(i, j, k); }
  double& at(int i, int j, int k) const {
    return values[(static_cast<std::size_t>(k) * static_cast<std::size_t>(points[1]) + static_cast<std::size_t>(j)) *
                      static_cast<std::size_t>(points[0]) +
                  static_cast<std::size_t>(i)];
  }
  /// A grid point exactly on the surface would collapse the triangles around it to a point.
  double clearOfZero(double value) const {
    return std::abs(value) < 1e-6 * cell ? std::copysign(1e-6 * cell, value) : value;
  }
};

TriangleMesh contour(const Grid& grid) {
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(grid.image);
  filter->SetValue(0, 0.0);
  filter->ComputeNormalsOff();
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  vtkPolyData* surface = filter->GetOutput();

  TriangleMesh mesh;
  mesh.positions.reserve(static_cast<std::size_t>(surface->GetNumberOfPoints()));
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p) {
    mesh.positions.emplace_back(Vec3d(surface->GetPoint(p)).cast<float>());
  }
  vtkNew<vtkIdList> corners;
  vtkCellArray* cells = surface->GetPolys();
  for (cells->InitTraversal(); cells->GetNextCell(corners) != 0;) {
    mesh.triangles.push_back({static_cast<std::uint32_t>(corners->GetId(0)),
                              static_cast<std::uint32_t>(corners->GetId(1)),
                              static_cast<std::uint32_t>(corners->GetId(2))});
  }
  mesh = weld(mesh).mesh;
  if (signedVolume(mesh) < 0.0) {
    for (Triangle& triangle : mesh.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh isosurface(const std::function<double(const Vec3d&)>& field, const Box3d& box, double cell) {
  const Grid grid(box, cell);
  for (int k = 0; k < grid.points[2]; ++k) {
    for (int j = 0; j < grid.points[1]; ++j) {
      for (int i = 0; i < grid.points[0]; ++i) {
        grid.at(i, j, k) = grid.clearOfZero(field(grid.place(i, j, k)));
      }
    }
  }
  return contour(grid);
}

TriangleMesh isosurface(const std::function<double(const Vec3d&)>& field, const Box3d& box, double cell, double reach,
                        base::Threads threads) {
  LORICA_CHECK(reach >= 1.0, "a block's corners are half a diagonal from its middle");
  constexpr int block = 8;
  const Grid grid(box, cell);
  std::array<int, 3> blocks{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    blocks[axis] = (grid.points[axis] + block - 1) / block;
  }
  const double far = reach * 0.5 * std::numbers::sqrt3 * block * cell;
  const auto columns = static_cast<std::size_t>(blocks[1]) * static_cast<std::size_t>(blocks[2]);
  base::parallelFor(columns, 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t column = begin; column < end; ++column) {
      const int j0 = block * static_cast<int>(column % static_cast<std::size_t>(blocks[1]));
      const int k0 = block * static_cast<int>(column / static_cast<std::size_t>(blocks[1]));
      for (int i0 = 0; i0 < grid.points[0]; i0 += block) {
        const double middle = field(grid.place(i0, j0, k0) + Vec3d::Constant(0.5 * (block - 1) * cell));
        for (int k = k0; k < std::min(k0 + block, grid.points[2]); ++k) {
          for (int j = j0; j < std::min(j0 + block, grid.points[1]); ++j) {
            for (int i = i0; i < std::min(i0 + block, grid.points[0]); ++i) {
              grid.at(i, j, k) = std::abs(middle) > far ? middle : grid.clearOfZero(field(grid.place(i, j, k)));
            }
          }
        }
      }
    }
  });
  return contour(grid);
}

}  // namespace lorica::geometry
