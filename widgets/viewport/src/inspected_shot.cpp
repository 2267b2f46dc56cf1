#include "inspected_shot.h"

#include "lorica/document/appearance.h"

namespace lorica::viewport {

namespace {

constexpr double tail = 0.15;       // metres beyond what is crossed last
constexpr double missLength = 6.5;  // of a shot that crosses nothing
const QColor lineColour(225, 95, 0);
const QColor insideColour(120, 20, 120);
const QColor entryColour(20, 110, 40);
const QColor exitColour(20, 40, 150);

}  // namespace

InspectedShotPresenter::InspectedShotPresenter(vtkRenderer* renderer, std::size_t model)
    : Presenter(renderer),
      model_(model),
      line_(renderer, lineColour, 2.6F),
      inside_(renderer, insideColour, 5.0F),
      entries_(renderer, entryColour, 11.0F),
      exits_(renderer, exitColour, 8.0F) {}

void InspectedShotPresenter::showFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  frame_ = frame;
}

void InspectedShotPresenter::restyle(const document::StudyDocument& document) {
  std::vector<Polyline> lines;
  std::vector<Polyline> inside;
  std::vector<geometry::Vec3d> entries;
  std::vector<geometry::Vec3d> exits;
  if (inspection_ != nullptr && frame_ != nullptr && frame_->pose == inspection_->details.pose) {
    const raycast::Ray& ray = inspection_->details.ray;
    const geometry::Vec3d from = ray.origin.cast<double>();
    const geometry::Vec3d along = ray.direction.cast<double>().normalized();
    const std::string model = viscera::name(frame_->scene->models()[model_]);
    double last = 0.0;
    for (const analysis::NamedPassage& named : inspection_->details.passages) {
      const shotline::Passage& passage = named.passage;
      const bool here = (named.kind != "organ" || named.group == model) &&
                        document::appearanceOf(document.study(), named.structure).visible;
      if (!here) {
        continue;
      }
      last = std::max(last, passage.exit);
      entries.emplace_back(from + passage.enter * along);
      if (passage.closed) {
        exits.emplace_back(from + passage.exit * along);
      }
      if (passage.closed && named.kind != "body") {
        inside.push_back({from + passage.enter * along, from + passage.exit * along});
      }
    }
    lines.push_back({from, from + (last > 0.0 ? last + tail : missLength) * along});
  }
  line_.draw(lines);
  inside_.draw(inside);
  entries_.draw({}, entries);
  exits_.draw({}, exits);
}

}  // namespace lorica::viewport
