#include "shot_presenter.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include "lorica/document/appearance.h"

namespace lorica::viewport {

namespace {

using Kind = ShotMeeting::Kind;
using Ref = analysis::StructureRef;

/// How far a line runs beyond what it crossed last, and a shot that met nothing beyond its source, metres.
constexpr double tail = 0.15;
constexpr double missLength = 6.5;

bool passes(const std::string& filter, const ShotMeeting& met, const std::string& structure) {
  if (filter.empty() || (filter == "hits" && met.kind != Kind::miss)) {
    return true;
  }
  switch (met.kind) {
    case Kind::miss:
      return filter == "miss";
    case Kind::body:
      return filter == "body";
    case Kind::armor:
      return filter == "armor" || filter == structure;
    case Kind::organ:
      return filter == "organs" || filter == structure;
  }
  return false;
}

}  // namespace

ShotMeeting meetingOf(const analysis::ShotPath& shot, std::size_t model, const std::vector<bool>& pieceShown) {
  ShotMeeting met;
  for (const analysis::ShotCrossing& crossing : shot.crossings) {
    const Ref& what = crossing.structure;
    if (what.kind == Ref::Kind::body && met.kind == Kind::miss) {
      met.kind = Kind::body;
    } else if (what.kind == Ref::Kind::piece && met.kind == Kind::miss && pieceShown[what.index]) {
      return {Kind::armor, what.index};
    } else if (what.kind == Ref::Kind::organ && what.model == model) {
      return {Kind::organ, what.index};
    }
  }
  return met;
}

ShotPresenter::ShotPresenter(vtkRenderer* renderer, std::size_t model) : Presenter(renderer), model_(model) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data_);
  mapper->SetScalarModeToUseCellData();
  mapper->SetColorModeToDirectScalars();
  actor_->SetMapper(mapper);
  actor_->GetProperty()->LightingOff();
  actor_->GetProperty()->SetLineWidth(1.4F);
  renderer->AddActor(actor_);
}

ShotPresenter::~ShotPresenter() {
  renderer()->RemoveActor(actor_);
}

void ShotPresenter::showFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  frame_ = frame;
}

void ShotPresenter::restyle(const document::StudyDocument& document) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  drawn_.clear();
  if (frame_ != nullptr && !frame_->shots.empty()) {
    const study::Study& study = document.study();
    std::vector<bool> pieceShown;
    for (const auto& piece : frame_->study->pieces) {
      pieceShown.push_back(document::appearanceOf(study, piece->name).visible);
    }
    for (const analysis::ShotPath& shot : frame_->shots) {
      const ShotMeeting met = meetingOf(shot, model_, pieceShown);
      const std::string structure = met.kind == Kind::armor   ? frame_->study->pieces[met.index]->name
                                    : met.kind == Kind::organ ? frame_->study->organs[met.index]->name
                                                              : "body";
      if (!passes(filter_, met, structure)) {
        continue;
      }
      const QColor colour = met.kind == Kind::miss   ? QColor(168, 168, 168)
                            : met.kind == Kind::body ? document::appearanceOf(study, structure).colour.darker(130)
                                                     : document::appearanceOf(study, structure).colour;
      const double length = shot.crossings.empty() ? missLength : shot.crossings.back().distance + tail;
      const geometry::Vec3d from = shot.origin.cast<double>();
      const geometry::Vec3d to = from + length * shot.direction.cast<double>();
      const std::array<vtkIdType, 2> ends{points->InsertNextPoint(from.data()), points->InsertNextPoint(to.data())};
      lines->InsertNextCell(2, ends.data());
      const std::array<unsigned char, 3> rgb{static_cast<unsigned char>(colour.red()),
                                             static_cast<unsigned char>(colour.green()),
                                             static_cast<unsigned char>(colour.blue())};
      colours->InsertNextTypedTuple(rgb.data());
      drawn_.push_back({shot.number, from, to});
    }
  }
  data_->SetPoints(points);
  data_->SetLines(lines);
  data_->GetCellData()->SetScalars(colours);
}

}  // namespace lorica::viewport
