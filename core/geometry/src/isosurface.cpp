#include "lorica/geometry/isosurface.h"

#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/weld.h"

namespace lorica::geometry {

TriangleMesh isosurface(const std::function<double(const Vec3d&)>& field, const Box3d& box, double cell) {
  LORICA_CHECK(cell > 0.0 && !box.isEmpty(), "a grid needs a box and a cell size");
  std::array<int, 3> points{};
  double total = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double count = std::ceil(box.sizes()[axis] / cell) + 1.0;
    total *= count;
    LORICA_CHECK(total <= 268435456.0, "at most 2^28 grid points");
    points[static_cast<std::size_t>(axis)] = static_cast<int>(count);
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(points[0], points[1], points[2]);
  image->SetSpacing(cell, cell, cell);
  image->SetOrigin(box.min().x(), box.min().y(), box.min().z());
  image->AllocateScalars(VTK_DOUBLE, 1);
  auto* values = static_cast<double*>(image->GetScalarPointer());
  for (int k = 0; k < points[2]; ++k) {
    for (int j = 0; j < points[1]; ++j) {
      for (int i = 0; i < points[0]; ++i) {
        const double value = field(box.min() + cell * Vec3d(i, j, k));
        // A grid point exactly on the surface would collapse the triangles around it to a point.
        *values++ = std::abs(value) < 1e-6 * cell ? std::copysign(1e-6 * cell, value) : value;
      }
    }
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();

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

}  // namespace lorica::geometry
