#include "lorica/panels/timeline_panel.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QScopedValueRollback>
#include <QStackedWidget>
#include <QStyle>
#include <QTextEdit>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "lorica/commands/edits.h"
#include "lorica/models/numbers.h"
#include "lorica/panels/property_form.h"
#include "marked_slider.h"
#include "panel_parts.h"

namespace lorica::panels {

namespace {

// A duration that misses a whole frame by rounding alone makes no frame more.
constexpr double sameFrame = 1e-6;

const study::Pose* poseNamed(const study::Study& study, const std::string& name) {
  const auto found =
      std::find_if(study.poses.begin(), study.poses.end(), [&](const study::Pose& pose) { return pose.name == name; });
  return found == study.poses.end() ? nullptr : &*found;
}

const study::Pose* poseAt(const study::Study& study, const study::ClipPose& moment) {
  const auto found = std::find_if(study.poses.begin(), study.poses.end(), [&](const study::Pose& pose) {
    const auto* clip = std::get_if<study::ClipPose>(&pose.what);
    return clip != nullptr && *clip == moment;
  });
  return found == study.poses.end() ? nullptr : &*found;
}

QString poseId(const std::string& name) {
  return QStringLiteral("pose:") + QString::fromStdString(name);
}
QString clipId(const std::string& name) {
  return QStringLiteral("clip:") + QString::fromStdString(name);
}

/// Whether a key without modifiers means something of its own to the widget.
bool usesKey(const QWidget* widget, int key) {
  if (qobject_cast<const QLineEdit*>(widget) != nullptr || qobject_cast<const QAbstractSpinBox*>(widget) != nullptr ||
      qobject_cast<const QPlainTextEdit*>(widget) != nullptr || qobject_cast<const QTextEdit*>(widget) != nullptr ||
      qobject_cast<const QAbstractItemView*>(widget) != nullptr || qobject_cast<const QComboBox*>(widget) != nullptr ||
      qobject_cast<const QAbstractButton*>(widget) != nullptr) {
    return true;
  }
  return key != Qt::Key_Space && qobject_cast<const QAbstractSlider*>(widget) != nullptr;
}

/// A time that is typed to the millisecond and stepped frame by frame.
class TimeSpin : public QDoubleSpinBox {
 public:
  TimeSpin(std::function<void(int)> step, QWidget* parent) : QDoubleSpinBox(parent), step_(std::move(step)) {}
  void stepBy(int steps) override { step_(steps); }

 private:
  std::function<void(int)> step_;
};

}  // namespace

ClipFrames::ClipFrames(double duration)
    : duration_(duration), last_(static_cast<int>(std::ceil(duration * perSecond - sameFrame))) {}

double ClipFrames::seconds(int frame) const {
  return frame >= last_ ? duration_ : frame / perSecond;
}

int ClipFrames::frameAt(double seconds) const {
  if (seconds >= duration_) {
    return last_;
  }
  int frame = std::clamp(static_cast<int>(seconds * perSecond), 0, std::max(0, last_ - 1));
  // The product may be rounded to either side of the frame.
  while (frame > 0 && this->seconds(frame) > seconds) {
    --frame;
  }
  while (frame + 1 < last_ && this->seconds(frame + 1) <= seconds) {
    ++frame;
  }
  return frame;
}

std::string clipPoseText(const std::string& clip, double seconds) {
  std::array<char, 40> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), seconds).ptr;
  return clip + '@' + std::string(digits.data(), end);
}

TimelinePanel::TimelinePanel(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), pages_(new QStackedWidget(this)) {
  makeActions();
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(pages_);
  pages_->addWidget(makeEmptyPage(tr("Open a study to see its body move."), pages_));
  pages_->addWidget(makeControls());
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);

  timer_.setInterval(33);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &TimelinePanel::tick);
  using document::StudyDocument;
  connect(&document_, &StudyDocument::replaced, this, [this] { setPlaying(false); });
  connect(&document_, &StudyDocument::studyChanged, this, [this](document::Changes what) {
    if (what.testFlag(document::Change::poses)) {
      refresh();
    }
  });
  connect(&document_, &StudyDocument::loadedChanged, this, &TimelinePanel::refresh);
  connect(&document_, &StudyDocument::problemsChanged, this, &TimelinePanel::refresh);
  connect(&document_, &StudyDocument::shownPoseChanged, this, [this] {
    showState();
    if (isPlaying() && !ticking_) {
      restartClock();
    }
  });
  qApp->installEventFilter(this);
  refresh();
}

void TimelinePanel::makeActions() {
  const auto make = [this](QStyle::StandardPixmap icon, const QString& text, const QKeySequence& key,
                           const char* name) {
    auto* action = new QAction(style()->standardIcon(icon), text, this);
    action->setObjectName(QString::fromLatin1(name));
    action->setShortcut(key);
    addAction(action);
    return action;
  };
  first_ = make(QStyle::SP_MediaSkipBackward, tr("First frame"), {}, "first");
  stepBack_ = make(QStyle::SP_MediaSeekBackward, tr("Step back"), Qt::Key_Left, "step_back");
  play_ = make(QStyle::SP_MediaPlay, tr("Play"), Qt::Key_Space, "play");
  stepForward_ = make(QStyle::SP_MediaSeekForward, tr("Step forward"), Qt::Key_Right, "step_forward");
  last_ = make(QStyle::SP_MediaSkipForward, tr("Last frame"), {}, "last");
  connect(first_, &QAction::triggered, this, [this] { showFrame(0); });
  connect(stepBack_, &QAction::triggered, this, [this] { step(-1); });
  connect(play_, &QAction::triggered, this, [this] { setPlaying(!isPlaying()); });
  connect(stepForward_, &QAction::triggered, this, [this] { step(1); });
  connect(last_, &QAction::triggered, this, [this] {
    if (const auto moment = shownMoment()) {
      showFrame(framesOf(moment->clip)->last());
    }
  });
}

QWidget* TimelinePanel::makeControls() {
  auto* page = new QWidget(pages_);
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  column->setSpacing(2);
  auto* row = new QHBoxLayout;
  row->setSpacing(panelMargin);
  column->addLayout(row);

  poses_ = makeChoice(tr("Pose that is shown"), page);
  poses_->setObjectName(QStringLiteral("pose"));
  row->addWidget(poses_);
  connect(poses_, &QComboBox::activated, this, &TimelinePanel::choosePose);

  auto* transport = new QHBoxLayout;
  transport->setSpacing(0);
  row->addLayout(transport);
  for (QAction* action : {first_, stepBack_, play_, stepForward_, last_}) {
    auto* button = new QToolButton(page);
    button->setDefaultAction(action);
    button->setAutoRaise(true);
    transport->addWidget(button);
  }
  loop_ = new QToolButton(page);
  loop_->setObjectName(QStringLiteral("loop"));
  loop_->setText(tr("Loop"));
  loop_->setToolTip(tr("Start again at the end"));
  loop_->setCheckable(true);
  loop_->setChecked(true);
  loop_->setAutoRaise(true);
  row->addWidget(loop_);
  speed_ = makeChoice(tr("Speed"), page);
  speed_->setObjectName(QStringLiteral("speed"));
  speed_->setMinimumContentsLength(5);
  for (const double speed : {0.25, 0.5, 1.0, 2.0}) {
    speed_->addItem(readable(speed, 2) + QChar(0xD7), speed);
  }
  speed_->setCurrentIndex(speed_->findData(1.0));
  connect(speed_, &QComboBox::currentIndexChanged, this, &TimelinePanel::restartClock);
  row->addWidget(speed_);
  where_ = new ElidedLabel(page);
  where_->setObjectName(QStringLiteral("where"));
  where_->setElideMode(Qt::ElideRight);
  row->addWidget(where_, 1);
  time_ = new TimeSpin([this](int frames) { step(frames); }, page);
  time_->setObjectName(QStringLiteral("time"));
  time_->setAccessibleName(tr("Time in the clip"));
  time_->setToolTip(tr("Time in the clip"));
  time_->setDecimals(3);
  time_->setSuffix(tr(" s"));
  time_->setKeyboardTracking(false);
  connect(time_, &QDoubleSpinBox::valueChanged, this, [this](double seconds) {
    if (!refreshing_) {
      showTime(seconds);
    }
  });
  row->addWidget(time_);
  keep_ = new QToolButton(page);
  keep_->setObjectName(QStringLiteral("keep"));
  keep_->setText(tr("Keep pose"));
  connect(keep_, &QToolButton::clicked, this, &TimelinePanel::keepPose);
  row->addWidget(keep_);

  slider_ = new MarkedSlider(page);
  slider_->setObjectName(QStringLiteral("frame"));
  slider_->setAccessibleName(tr("Frame"));
  slider_->setPageStep(10);
  connect(slider_, &QSlider::valueChanged, this, [this](int frame) {
    if (!refreshing_) {
      showFrame(frame);
    }
  });
  column->addWidget(slider_);
  return page;
}

std::optional<study::ClipPose> TimelinePanel::shownMoment() const {
  const std::string& shown = document_.shownPose();
  if (document_.loaded() == nullptr || shown == "rest") {
    return std::nullopt;
  }
  std::optional<study::ClipPose> moment;
  if (const study::Pose* pose = poseNamed(document_.study(), shown)) {
    if (const auto* clip = std::get_if<study::ClipPose>(&pose->what)) {
      moment = *clip;
    }
  } else {
    moment = study::clipPoseNamed(shown);
  }
  return moment && framesOf(moment->clip) ? moment : std::nullopt;
}

std::optional<ClipFrames> TimelinePanel::framesOf(const std::string& clip) const {
  if (document_.loaded() == nullptr) {
    return std::nullopt;
  }
  for (const human::Clip& known : document_.loaded()->clips) {
    if (known.name == clip) {
      return ClipFrames(known.duration());
    }
  }
  return std::nullopt;
}

void TimelinePanel::refresh() {
  pages_->setCurrentIndex(document_.hasStudy() ? 1 : 0);
  refillPoses();
  showState();
}

void TimelinePanel::refillPoses() {
  const QScopedValueRollback quiet(refreshing_, true);
  const QString chosen = poses_->currentData().toString();
  poses_->clear();
  poses_->addItem(tr("Rest"), poseId("rest"));
  if (!document_.study().poses.empty()) {
    poses_->insertSeparator(poses_->count());
  }
  for (const study::Pose& pose : document_.study().poses) {
    poses_->addItem(QString::fromStdString(pose.name), poseId(pose.name));
    poses_->setItemData(poses_->count() - 1, QString::fromStdString(pose.description), Qt::ToolTipRole);
  }
  if (document_.loaded() != nullptr && !document_.loaded()->clips.empty()) {
    poses_->insertSeparator(poses_->count());
    for (const human::Clip& clip : document_.loaded()->clips) {
      poses_->addItem(tr("%1 (clip, %2 s)").arg(QString::fromStdString(clip.name), models::fixed(clip.duration(), 2)),
                      clipId(clip.name));
    }
  }
  poses_->setCurrentIndex(std::max(0, poses_->findData(chosen)));
}

void TimelinePanel::choosePose() {
  const QString id = poses_->currentData().toString();
  const std::string name = id.mid(5).toStdString();
  if (id.startsWith(u"pose:")) {
    setPlaying(false);
    document_.showPose(name);
    return;
  }
  // A pose of that clip becomes the clip at the pose's time.
  const std::optional<study::ClipPose> moment = shownMoment();
  document_.showPose(clipPoseText(name, moment && moment->clip == name ? moment->seconds : 0.0));
  showState();
}

QString TimelinePanel::whyNoTime() const {
  const auto& loaded = document_.loaded();
  if (loaded == nullptr) {
    return document_.problems().empty() ? tr("The body is being read.")
                                        : tr("The body cannot be read; the problems say why.");
  }
  if (!loaded->body->body().skeleton) {
    return tr("The body has no skeleton, so it can only be shown at rest.");
  }
  if (loaded->clips.empty()) {
    return tr("The body has no motion clips.");
  }
  const std::string& shown = document_.shownPose();
  if (const std::optional<study::ClipPose> missing = study::clipPoseNamed(shown);
      missing && poseNamed(document_.study(), shown) == nullptr) {
    return tr("The body has no clip named \"%1\".").arg(QString::fromStdString(missing->clip));
  }
  return shown == "rest" ? tr("At rest. Choose a clip to see the body move.")
                         : tr("A pose of turned joints has no time. Choose a clip to see the body move.");
}

void TimelinePanel::showState() {
  const std::optional<study::ClipPose> moment = shownMoment();
  if (!moment) {
    setPlaying(false);
  }
  const QScopedValueRollback quiet(refreshing_, true);
  const bool posable = document_.loaded() != nullptr && document_.loaded()->body->body().skeleton.has_value();
  poses_->setEnabled(posable);
  // Within a clip the choice stays at it, also where a pose of the study is passed.
  if (!moment || poses_->currentData().toString() != clipId(moment->clip)) {
    int index = poses_->findData(poseId(document_.shownPose()));
    if (index < 0 && moment) {
      index = poses_->findData(clipId(moment->clip));
    }
    poses_->setCurrentIndex(index);
  }
  const bool moves = moment && framesOf(moment->clip)->last() > 0;
  for (QAction* action : {first_, stepBack_, play_, stepForward_, last_}) {
    action->setEnabled(moves);
  }
  for (QWidget* widget : std::initializer_list<QWidget*>{loop_, speed_, slider_, time_}) {
    widget->setEnabled(moves);
  }
  if (moment) {
    showClip(*moment, framesOf(moment->clip)->duration());
    return;
  }
  slider_->setMarks({});
  slider_->setRange(0, 0);
  time_->setRange(0.0, 0.0);
  where_->setText(whyNoTime());
  keep_->setEnabled(false);
  keep_->setToolTip(tr("Show a moment of a clip to keep it as a pose of the study"));
}

void TimelinePanel::showClip(const study::ClipPose& moment, double duration) {
  const ClipFrames frames(duration);
  const int frame = frames.frameAt(moment.seconds);
  const bool onFrame = frames.seconds(frame) == moment.seconds;
  slider_->setRange(0, frames.last());
  slider_->setValue(frame);
  std::vector<double> marks;
  for (const study::Pose& pose : document_.study().poses) {
    const auto* clip = std::get_if<study::ClipPose>(&pose.what);
    if (clip != nullptr && clip->clip == moment.clip && clip->seconds <= duration) {
      const int before = frames.frameAt(clip->seconds);
      const double length = frames.seconds(std::min(before + 1, frames.last())) - frames.seconds(before);
      marks.push_back(before + (length > 0.0 ? (clip->seconds - frames.seconds(before)) / length : 0.0));
    }
  }
  slider_->setMarks(std::move(marks));
  time_->setRange(0.0, std::ceil(duration * 1000.0) / 1000.0);
  time_->setValue(moment.seconds);
  const QString place = onFrame ? tr("frame %1 of %2").arg(frame).arg(frames.last())
                                : tr("between frames %1 and %2 of %3").arg(frame).arg(frame + 1).arg(frames.last());
  where_->setText(tr("%1 %2 %3 s of %4 s")
                      .arg(place, QString(QChar(0x2013)), models::fixed(moment.seconds, onFrame ? 2 : 3),
                           models::fixed(duration, 2)));
  const study::Pose* kept = poseAt(document_.study(), moment);
  keep_->setEnabled(kept == nullptr);
  keep_->setToolTip(kept == nullptr
                        ? tr("Add this moment to the study's poses")
                        : tr("The study has this moment already: %1").arg(QString::fromStdString(kept->name)));
}

void TimelinePanel::showTime(double seconds) {
  if (const auto moment = shownMoment()) {
    const double duration = framesOf(moment->clip)->duration();
    document_.showPose(clipPoseText(moment->clip, std::clamp(seconds, 0.0, duration)));
    showState();
  }
}

void TimelinePanel::showFrame(int frame) {
  if (const auto moment = shownMoment()) {
    showTime(framesOf(moment->clip)->seconds(frame));
  }
}

void TimelinePanel::step(int frames) {
  const auto moment = shownMoment();
  if (!moment) {
    return;
  }
  setPlaying(false);
  const ClipFrames all = *framesOf(moment->clip);
  int frame = all.frameAt(moment->seconds);
  // From between two frames, a step back goes to the one before.
  frame += frames < 0 && all.seconds(frame) < moment->seconds ? frames + 1 : frames;
  showFrame(std::clamp(frame, 0, all.last()));
}

void TimelinePanel::setPlaying(bool on) {
  const auto moment = shownMoment();
  on = on && moment && framesOf(moment->clip)->last() > 0;
  if (on == isPlaying()) {
    return;
  }
  if (on) {
    if (moment->seconds >= framesOf(moment->clip)->duration()) {
      showFrame(0);
    }
    timer_.start();
    restartClock();
  } else {
    timer_.stop();
  }
  play_->setIcon(style()->standardIcon(on ? QStyle::SP_MediaPause : QStyle::SP_MediaPlay));
  play_->setText(on ? tr("Pause") : tr("Play"));
}

void TimelinePanel::restartClock() {
  const auto moment = shownMoment();
  playedFrom_ = moment ? moment->seconds : 0.0;
  clock_.start();
}

void TimelinePanel::tick() {
  if (busy_ && busy_()) {
    return;
  }
  const auto moment = shownMoment();
  if (!moment) {
    setPlaying(false);
    return;
  }
  const ClipFrames frames = *framesOf(moment->clip);
  double seconds = playedFrom_ + static_cast<double>(clock_.nsecsElapsed()) * 1e-9 * speed_->currentData().toDouble();
  const bool ended = seconds >= frames.duration();
  if (ended && loop_->isChecked()) {
    seconds = std::fmod(seconds, frames.duration());
    playedFrom_ = seconds;
    clock_.start();
  }
  {
    const QScopedValueRollback mine(ticking_, true);
    showFrame(frames.frameAt(seconds));
  }
  if (ended && !loop_->isChecked()) {
    setPlaying(false);
  }
}

void TimelinePanel::keepPose() {
  if (const auto moment = shownMoment()) {
    setPlaying(false);
    commands::addPose(document_, {clipPoseText(moment->clip, moment->seconds), *moment});
  }
}

bool TimelinePanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && watched->isWidgetType()) {
    const auto* key = static_cast<const QKeyEvent*>(event);
    const bool ours = key->key() == Qt::Key_Space || key->key() == Qt::Key_Left || key->key() == Qt::Key_Right;
    if (ours && (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier &&
        usesKey(static_cast<const QWidget*>(watched), key->key())) {
      event->accept();
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace lorica::panels
