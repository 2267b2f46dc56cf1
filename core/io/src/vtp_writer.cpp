#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "lorica/base/error.h"
#include "reading.h"
#include "writers.h"

namespace lorica::io {

namespace {

vtkSmartPointer<vtkDoubleArray> arrayOf(const std::string& name, const std::vector<double>& values, vtkIdType count) {
  LORICA_CHECK(static_cast<vtkIdType>(values.size()) == count, "a value per triangle or position");
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(oneLine(name).c_str());
  for (const double value : values) {
    array->InsertNextValue(value);
  }
  return array;
}

}  // namespace

std::string fieldsVtpBytes(std::span<const SceneMesh> scene, std::span<const TriangleField> fields,
                           std::span<const VertexField> vertexFields) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIntArray> structure;
  structure->SetName("structure");
  vtkNew<vtkUnsignedCharArray> colour;
  colour->SetName("colour");
  colour->SetNumberOfComponents(4);
  vtkNew<vtkStringArray> names;
  names->SetName("structure_names");
  vtkIdType first = 0;
  for (std::size_t s = 0; s < scene.size(); ++s) {
    names->InsertNextValue(oneLine(scene[s].name));
    for (const geometry::Vec3f& p : scene[s].positions) {
      points->InsertNextPoint(p.data());
    }
    const std::array<std::uint8_t, 4> shown = displayColour(scene[s].colour);
    for (const geometry::Triangle& t : scene[s].triangles) {
      cells->InsertNextCell({first + t[0], first + t[1], first + t[2]});
      structure->InsertNextValue(static_cast<int>(s));
      colour->InsertNextTypedTuple(shown.data());
    }
    first += static_cast<vtkIdType>(scene[s].positions.size());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetCellData()->AddArray(structure);
  data->GetCellData()->SetScalars(colour);
  data->GetFieldData()->AddArray(names);
  for (const TriangleField& field : fields) {
    data->GetCellData()->AddArray(arrayOf(field.name, field.values, data->GetNumberOfCells()));
  }
  for (const VertexField& field : vertexFields) {
    data->GetPointData()->AddArray(arrayOf(field.name, field.values, data->GetNumberOfPoints()));
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

std::string vtpBytes(std::span<const SceneMesh> scene) {
  return fieldsVtpBytes(scene, {});
}

}  // namespace lorica::io
