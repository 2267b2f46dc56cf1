#include "line_layer.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>

namespace lorica::viewport {

namespace {

constexpr double dotsPerInch = 72.0;  // of a screen at 100 %, as VTK has it

}  // namespace

LineLayer::LineLayer(vtkRenderer* renderer, const QColor& colour, float size, double opacity)
    : renderer_(renderer), size_(size) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data_);
  actor_->SetMapper(mapper);
  vtkProperty* property = actor_->GetProperty();
  property->LightingOff();
  property->SetColor(colour.redF(), colour.greenF(), colour.blueF());
  property->SetOpacity(opacity);
  property->RenderPointsAsSpheresOn();
  renderer->AddActor(actor_);
}

LineLayer::~LineLayer() {
  renderer_->RemoveActor(actor_);
}

void LineLayer::draw(std::span<const Polyline> lines, std::span<const geometry::Vec3d> balls) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lineCells;
  vtkNew<vtkCellArray> ballCells;
  for (const Polyline& line : lines) {
    lineCells->InsertNextCell(static_cast<int>(line.size()));
    for (const geometry::Vec3d& point : line) {
      lineCells->InsertCellPoint(points->InsertNextPoint(point.data()));
    }
  }
  for (const geometry::Vec3d& ball : balls) {
    const vtkIdType at = points->InsertNextPoint(ball.data());
    ballCells->InsertNextCell(1, &at);
  }
  data_->SetPoints(points);
  data_->SetLines(lineCells);
  data_->SetVerts(ballCells);
  actor_->SetVisibility(points->GetNumberOfPoints() > 0 ? 1 : 0);
  vtkRenderWindow* window = renderer_->GetRenderWindow();
  const double scale = window == nullptr ? 1.0 : window->GetDPI() / dotsPerInch;
  actor_->GetProperty()->SetLineWidth(static_cast<float>(size_ * scale));
  actor_->GetProperty()->SetPointSize(static_cast<float>(size_ * scale));
}

}  // namespace lorica::viewport
