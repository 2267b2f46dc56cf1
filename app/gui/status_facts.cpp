#include "status_facts.h"

#include <QHBoxLayout>
#include <QLabel>
#include <algorithm>

#include "lorica/models/numbers.h"

namespace lorica::gui {

namespace {

constexpr int gap = 14;
constexpr int longest = 36;  ///< average characters of a name

QString shown(const std::string& text) {
  return QString::fromStdString(text);
}

/// Long names are cut in the middle; the tooltip has them whole.
void say(QLabel& label, const QString& text) {
  const QFontMetrics metrics = label.fontMetrics();
  label.setText(metrics.elidedText(text, Qt::ElideMiddle, longest * metrics.averageCharWidth()));
  label.setToolTip(label.text() == text ? QString() : text);
  label.setVisible(!text.isEmpty());
}

}  // namespace

QString poseText(const std::string& pose, const std::vector<human::Clip>& clips) {
  const std::size_t at = pose.rfind('@');
  if (at == std::string::npos) {
    return StatusFacts::tr("Pose: %1").arg(shown(pose));
  }
  const std::string name = pose.substr(0, at);
  const auto clip =
      std::find_if(clips.begin(), clips.end(), [&](const human::Clip& candidate) { return candidate.name == name; });
  const QString time = models::fixed(shown(pose.substr(at + 1)).toDouble(), 2);
  return clip == clips.end()
             ? StatusFacts::tr("%1 at %2 s").arg(shown(name), time)
             : StatusFacts::tr("%1 at %2 of %3 s").arg(shown(name), time, models::fixed(clip->duration(), 2));
}

QString selectionText(const std::optional<document::ItemRef>& item) {
  if (!item) {
    return {};
  }
  using document::ItemKind;
  const QString name = shown(item->name);
  switch (item->kind) {
    case ItemKind::study:
      return {};
    case ItemKind::body:
      return StatusFacts::tr("Selected: the body");
    case ItemKind::region:
      return StatusFacts::tr("Selected: region %1").arg(name);
    case ItemKind::system:
      return StatusFacts::tr("Selected: system %1").arg(name);
    case ItemKind::pose:
      return StatusFacts::tr("Selected: pose %1").arg(name);
    case ItemKind::source:
      return StatusFacts::tr("Selected: source %1").arg(name);
    case ItemKind::organ:
    case ItemKind::piece:
    case ItemKind::run:
      return StatusFacts::tr("Selected: %1").arg(name);
  }
  return {};
}

StatusFacts::StatusFacts(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), pose_(new QLabel), shots_(new QLabel), selection_(new QLabel) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(gap / 2, 0, gap / 2, 0);
  row->setSpacing(gap);
  pose_->setObjectName(QStringLiteral("status_pose"));
  shots_->setObjectName(QStringLiteral("status_shots"));
  selection_->setObjectName(QStringLiteral("status_selection"));
  for (QLabel* label : {pose_, shots_, selection_}) {
    label->setTextFormat(Qt::PlainText);
    row->addWidget(label);
  }
  using document::StudyDocument;
  for (const auto signal : {&StudyDocument::shownPoseChanged, &StudyDocument::selectionChanged,
                            &StudyDocument::loadedChanged, &StudyDocument::replaced}) {
    connect(&document_, signal, this, &StatusFacts::refresh);
  }
  refresh();
}

void StatusFacts::setFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  shotsText_.clear();
  if (frame == nullptr) {
    setToolTip({});
  } else {
    poseMs_ = frame->engineMs;
    if (!frame->shotsOf.empty()) {
      shotsText_ = tr("%1 shots from %2").arg(models::grouped(frame->shots.size()), shown(frame->shotsOf));
    }
  }
  refresh();
}

void StatusFacts::setDrawingTime(double drawMs) {
  setToolTip(tr("Skin, organs and armor posed in %1 ms, drawn in %2 ms")
                 .arg(models::fixed(poseMs_, 1), models::fixed(drawMs, 0)));
}

void StatusFacts::refresh() {
  const auto& loaded = document_.loaded();
  const bool open = document_.hasStudy();
  say(*pose_, open ? poseText(document_.shownPose(), loaded == nullptr ? std::vector<human::Clip>() : loaded->clips)
                   : QString());
  say(*shots_, open ? shotsText_ : QString());
  say(*selection_, open ? selectionText(document_.selection()) : QString());
}

}  // namespace lorica::gui
