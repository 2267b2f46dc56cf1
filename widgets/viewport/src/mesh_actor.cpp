#include "mesh_actor.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <numeric>

namespace lorica::viewport {

namespace {

/// A view of float triples as a VTK array. VTK's interface takes what it only reads without const.
vtkNew<vtkFloatArray> viewOf(std::span<const geometry::Vec3f> triples) {
  vtkNew<vtkFloatArray> array;
  array->SetNumberOfComponents(3);
  array->SetArray(const_cast<float*>(triples.data()->data()), 3 * static_cast<vtkIdType>(triples.size()), 1);
  return array;
}

}  // namespace

MeshActor::Level::Level() {
  data->SetPoints(vtkNew<vtkPoints>());
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
}

void MeshActor::Level::setTriangles(std::span<const geometry::Triangle> triangles) {
  static_assert(sizeof(geometry::Triangle) == 3 * sizeof(vtkTypeInt32), "indices are shared with VTK");
  vtkNew<vtkTypeInt32Array> corners;
  auto* first = const_cast<std::uint32_t*>(triangles.data()->data());
  corners->SetArray(reinterpret_cast<vtkTypeInt32*>(first), 3 * static_cast<vtkIdType>(triangles.size()), 1);
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(triangles.size()) + 1);
  for (vtkIdType t = 0; t < offsets->GetNumberOfValues(); ++t) {
    offsets->SetValue(t, static_cast<vtkTypeInt32>(3 * t));
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, corners);
  data->SetPolys(cells);
}

MeshActor::MeshActor(std::span<const geometry::Triangle> triangles) : triangles_(triangles) {
  full_.setTriangles(triangles);
  // One set of vertices for both.
  coarse_.data->SetPoints(full_.data->GetPoints());
  actor_->SetMapper(full_.mapper);
  vtkProperty* property = actor_->GetProperty();
  property->SetInterpolationToGouraud();
  property->SetAmbient(0.15);
  property->SetDiffuse(0.85);
  property->SetSpecular(0.12);
  property->SetSpecularPower(20.0);
}

void MeshActor::show(std::span<const geometry::Vec3f> positions, std::span<const geometry::Vec3f> normals) {
  full_.data->GetPoints()->SetData(viewOf(positions));
  full_.data->GetPoints()->Modified();
  const auto normalArray = viewOf(normals);
  normalArray->SetName("Normals");
  for (Level* level : {&full_, &coarse_}) {
    level->data->GetPointData()->SetNormals(normalArray);
    level->data->Modified();
  }
}

void MeshActor::colourVertices(const std::vector<Rgb>& colours) {
  vtkNew<vtkUnsignedCharArray> array;
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  for (std::size_t v = 0; v < colours.size(); ++v) {
    array->SetTypedTuple(static_cast<vtkIdType>(v), colours[v].data());
  }
  for (Level* level : {&full_, &coarse_}) {
    level->data->GetPointData()->SetScalars(colours.empty() ? nullptr : array.Get());
    level->mapper->SetScalarModeToUsePointData();
    level->mapper->SetColorModeToDirectScalars();
    level->mapper->SetScalarVisibility(colours.empty() ? 0 : 1);
  }
}

void MeshActor::drawCoarsely(const Triangles& coarse) {
  if (coarse != nullptr && coarse != coarseTriangles_) {
    coarse_.setTriangles(*coarse);
    coarseTriangles_ = coarse;
  }
  isCoarse_ = coarse != nullptr;
  actor_->SetMapper(isCoarse_ ? coarse_.mapper : full_.mapper);
}

}  // namespace lorica::viewport
