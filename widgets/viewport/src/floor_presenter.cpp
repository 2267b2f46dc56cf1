#include "floor_presenter.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <array>
#include <cmath>

#include "lorica/geometry/measures.h"

namespace lorica::viewport {

namespace {

/// Lines along x and z every `step` metres, out to `reach`.
vtkNew<vtkPolyData> grid(double step, double reach) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  const auto line = [&](double x0, double z0, double x1, double z1) {
    const std::array<vtkIdType, 2> ends{points->InsertNextPoint(x0, 0.0, z0), points->InsertNextPoint(x1, 0.0, z1)};
    lines->InsertNextCell(2, ends.data());
  };
  const int count = static_cast<int>(std::lround(reach / step));
  for (int i = -count; i <= count; ++i) {
    line(i * step, -reach, i * step, reach);
    line(-reach, i * step, reach, i * step);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

void dress(vtkActor* actor, vtkPolyData* data, double grey, double width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(grey, grey, grey);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->LightingOff();
  actor->PickableOff();
  actor->VisibilityOff();
}

}  // namespace

FloorPresenter::FloorPresenter(vtkRenderer* renderer) : Presenter(renderer) {
  dress(fine_, grid(0.1, 1.0), 0.80, 1.0);
  dress(coarse_, grid(1.0, 1.0), 0.62, 1.5);
  renderer->AddActor(fine_);
  renderer->AddActor(coarse_);
}

FloorPresenter::~FloorPresenter() {
  renderer()->RemoveActor(fine_);
  renderer()->RemoveActor(coarse_);
}

void FloorPresenter::showFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  const bool shown = frame != nullptr;
  fine_->SetVisibility(shown ? 1 : 0);
  coarse_->SetVisibility(shown ? 1 : 0);
  if (!shown || frame->study == study_) {
    return;
  }
  study_ = frame->study;
  const geometry::Box3d box = geometry::bounds(study_->body->body().skin.positions);
  for (vtkActor* actor : {fine_.Get(), coarse_.Get()}) {
    actor->SetPosition(box.center().x(), box.min().y(), box.center().z());
  }
}

}  // namespace lorica::viewport
