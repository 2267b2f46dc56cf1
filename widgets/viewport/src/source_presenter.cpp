#include "source_presenter.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "lorica/geometry/measures.h"

namespace lorica::viewport {

SourcePresenter::SourcePresenter(vtkRenderer* renderer) : Presenter(renderer) {
  for (const auto& [actor, data] : {std::pair{ballActor_.Get(), balls_.Get()}, {lineActor_.Get(), lines_.Get()}}) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(0.75, 0.10, 0.10);
    renderer->AddActor(actor);
  }
  ballActor_->GetProperty()->SetPointSize(11.0F);
  ballActor_->GetProperty()->RenderPointsAsSpheresOn();
  lineActor_->GetProperty()->SetLineWidth(1.0F);
  lineActor_->GetProperty()->SetColor(0.80, 0.45, 0.45);
}

SourcePresenter::~SourcePresenter() {
  renderer()->RemoveActor(ballActor_);
  renderer()->RemoveActor(lineActor_);
}

void SourcePresenter::showFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  shown_ = frame != nullptr;
  if (shown_) {
    middle_ = geometry::bounds(frame->scene->body().skin).center();
  }
}

void SourcePresenter::restyle(const document::StudyDocument& document) {
  vtkNew<vtkPoints> ends;
  vtkNew<vtkCellArray> balls;
  vtkNew<vtkCellArray> lines;
  if (shown_) {
    for (const study::Source& source : document.study().sources) {
      const geometry::Vec3d target = source.target.value_or(middle_);
      const std::array<vtkIdType, 2> line{ends->InsertNextPoint(source.position.data()),
                                          ends->InsertNextPoint(target.data())};
      balls->InsertNextCell(1, line.data());
      lines->InsertNextCell(2, line.data());
    }
  }
  balls_->SetPoints(ends);
  balls_->SetVerts(balls);
  lines_->SetPoints(ends);
  lines_->SetLines(lines);
}

}  // namespace lorica::viewport
