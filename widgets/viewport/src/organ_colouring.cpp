#include "organ_colouring.h"

#include "lorica/document/study_document.h"

namespace lorica::viewport {

using document::Colouring;

namespace {

constexpr int restMs = 250;  ///< without another frame until colours are worth their while

}  // namespace

OrganColouring::OrganColouring(const document::StudyDocument& document, QObject* parent)
    : QObject(parent), document_(document) {
  rest_.setSingleShot(true);
  rest_.setInterval(restMs);
  connect(&rest_, &QTimer::timeout, this, [this] { colourer_.request(frame_, document_.inspection().colouring); });
  connect(&colourer_, &jobs::OrganColourer::ready, this,
          [this](const std::shared_ptr<const jobs::OrganColours>& found) {
            colours_ = found;
            rescale();
            Q_EMIT this->found();
          });
}

void OrganColouring::follow(const std::shared_ptr<const jobs::Frame>& frame) {
  const Colouring what = document_.inspection().colouring;
  const bool known = colours_ != nullptr && colours_->frame == frame && colours_->what == what;
  frame_ = frame;
  if (known) {
    return;
  }
  colours_.reset();
  colourer_.abandon();
  rest_.stop();
  if (frame_ != nullptr && what != Colouring::own) {
    rest_.start();
  }
}

void OrganColouring::rescale() {
  if (colours_ == nullptr) {
    return;
  }
  const auto& organs = frame_->study->organs;
  std::vector<std::span<const float>> seen;
  for (std::size_t slot = 0; slot < colours_->values.size(); ++slot) {
    if (document::drawnAppearance(document_, organs[slot % organs.size()]->name).visible) {
      seen.emplace_back(colours_->values[slot]);
    }
  }
  scale_ = scaleFor(colours_->what, seen);
}

}  // namespace lorica::viewport
