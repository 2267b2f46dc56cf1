#include "source_presenter.h"

#include <vtkRenderWindow.h>
#include <vtkTextProperty.h>

#include "label_layout.h"
#include "lorica/geometry/measures.h"

namespace lorica::viewport {

using geometry::Vec3d;

namespace {

const QColor paleColour(205, 125, 125);
const QColor sourceColour(178, 24, 24);
const QColor compassColour(70, 84, 104);
const QColor directionColour(20, 70, 160);
constexpr int strongSize = 14;  // of labels, points
constexpr int plainSize = 12;

}  // namespace

Vec3d aimIn(const jobs::Frame& frame, const study::Source& source) {
  if (source.target) {
    return *source.target;
  }
  geometry::Box3d box;
  const analysis::LoadedStudy& study = *frame.study;
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    for (std::size_t m = 0; study.organs[o]->name == source.targetStructure && m < frame.scene->models().size(); ++m) {
      box.extend(geometry::bounds(frame.scene->organ(o, m)));
    }
  }
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    if (study.pieces[p]->name == source.targetStructure) {
      box.extend(geometry::bounds(frame.scene->piece(p)));
    }
  }
  return box.isEmpty() ? geometry::bounds(frame.scene->body().skin).center() : box.center();
}

double radiusIn(const jobs::Frame& frame, const Vec3d& aim) {
  double largest = 0.0;
  for (const geometry::Vec3f& vertex : frame.scene->body().skin) {
    largest = std::max(largest, (vertex.cast<double>() - aim).squaredNorm());
  }
  return std::sqrt(largest);
}

SourcePresenter::SourcePresenter(vtkRenderer* renderer)
    : Presenter(renderer),
      lines_(renderer, paleColour, 1.0F),
      balls_(renderer, sourceColour, 9.0F),
      selectedLines_(renderer, sourceColour, 1.8F),
      selectedBalls_(renderer, sourceColour, 13.0F),
      compass_(renderer, compassColour, 1.2F),
      direction_(renderer, directionColour, 2.6F) {}

SourcePresenter::~SourcePresenter() {
  for (const auto& label : labels_) {
    renderer()->RemoveActor(label);
  }
}

void SourcePresenter::showFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  frame_ = frame;
}

std::span<const raycast::Ray> SourcePresenter::listedBy(const std::string& source) const {
  const auto& sources = frame_->study->study.sources;
  for (std::size_t i = 0; i < std::min(sources.size(), frame_->study->shotLists.size()); ++i) {
    if (sources[i].name == source && frame_->study->shotLists[i].rays != nullptr) {
      return *frame_->study->shotLists[i].rays;
    }
  }
  return {};
}

void SourcePresenter::restyle(const document::StudyDocument& document) {
  SourceShape others;
  SourceShape chosen;
  std::optional<Compass> compass;
  const auto& selection = document.selection();
  const bool anySelected = selection && selection->kind == document::ItemKind::source;
  const double floor = frame_ == nullptr ? 0.0 : geometry::bounds(frame_->study->body->body().skin.positions).min().y();
  for (const study::Source& source : document.study().sources) {
    if (frame_ == nullptr) {
      break;
    }
    const Vec3d aim = aimIn(*frame_, source);
    const double radius = radiusIn(*frame_, aim);
    const SourceShape shape = shapeOf(source, aim, radius, listedBy(source.name));
    const bool selected = anySelected && selection->name == source.name;
    SourceShape& drawn = selected ? chosen : others;
    // One that is looked at is not to be hidden by all the others.
    if (selected || !anySelected) {
      drawn.lines.insert(drawn.lines.end(), shape.lines.begin(), shape.lines.end());
    }
    drawn.balls.insert(drawn.balls.end(), shape.balls.begin(), shape.balls.end());
    if (selected && compassOn_) {
      compass = compassOf(source, aim, radius, floor);
    }
  }
  lines_.draw(others.lines);
  balls_.draw({}, others.balls);
  selectedLines_.draw(chosen.lines);
  selectedBalls_.draw({}, chosen.balls);
  drawCompass(compass);
}

void SourcePresenter::drawCompass(const std::optional<Compass>& compass) {
  const Compass shown = compass.value_or(Compass());
  shownLabels_ = shown.labels;
  compass_.draw(shown.lines);
  direction_.draw(shown.strong);
  while (labels_.size() < shown.labels.size()) {
    auto label = vtkSmartPointer<vtkBillboardTextActor3D>::New();
    vtkTextProperty* text = label->GetTextProperty();
    text->SetFontFamilyToArial();
    text->SetJustificationToCentered();
    text->SetVerticalJustificationToCentered();
    renderer()->AddActor(label);
    labels_.push_back(std::move(label));
  }
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    labels_[i]->SetVisibility(i < shown.labels.size() ? 1 : 0);
    if (i < shown.labels.size()) {
      const CompassLabel& label = shown.labels[i];
      labels_[i]->SetInput(label.text.toUtf8().constData());
      labels_[i]->SetPosition(label.place.x(), label.place.y(), label.place.z());
      vtkTextProperty* text = labels_[i]->GetTextProperty();
      const QColor& colour = label.ofSource ? directionColour : compassColour;
      text->SetColor(colour.redF(), colour.greenF(), colour.blueF());
      text->SetFontSize(label.strong ? strongSize : plainSize);
      text->SetBold(label.strong);
    }
  }
}

void SourcePresenter::placeLabels() {
  const int* window = renderer()->GetSize();
  if (window[0] < 1 || window[1] < 1) {
    return;
  }
  constexpr double pointsPerInch = 72.0;
  constexpr double widthOfLetter = 0.62;  // of the size of the text, with some room
  constexpr double heightOfLine = 1.25;
  const double scale = renderer()->GetRenderWindow()->GetDPI() / pointsPerInch;
  std::vector<LabelBox> boxes;
  for (const CompassLabel& label : shownLabels_) {
    renderer()->SetWorldPoint(label.place.x(), label.place.y(), label.place.z(), 1.0);
    renderer()->WorldToDisplay();
    const double* place = renderer()->GetDisplayPoint();
    const double size = scale * (label.strong ? strongSize : plainSize);
    boxes.push_back({{place[0], place[1]},
                     {widthOfLetter * size * static_cast<double>(label.text.size()), heightOfLine * size},
                     label.ofSource ? 2
                     : label.strong ? 1
                                    : 0});
  }
  const std::vector<bool> seen = withoutOverlaps(boxes);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    labels_[i]->SetVisibility(seen[i] ? 1 : 0);
  }
}

}  // namespace lorica::viewport
