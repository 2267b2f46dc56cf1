#pragma once

/// \file
/// Which pose is shown: rest, a pose of the study, or a moment of a motion clip, still or playing.

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <optional>
#include <string>

#include "lorica/document/study_document.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;
class QStackedWidget;
class QToolButton;

namespace lorica::panels {

class ElidedLabel;
class MarkedSlider;

/// A clip cut into moments to step through: 30 a second from its start, and its very end.
class ClipFrames {
 public:
  static constexpr double perSecond = 30.0;

  /// \pre duration >= 0, seconds
  explicit ClipFrames(double duration);
  double duration() const { return duration_; }
  /// The frame at the clip's end; 0 for a clip without length.
  int last() const { return last_; }
  /// Time of a frame, 0 to last(): that of the last one is the duration, exactly.
  double seconds(int frame) const;
  /// The frame at a time, or the one before it. Inverse of seconds().
  int frameAt(double seconds) const;

 private:
  double duration_;
  int last_;
};

/// CLIP@SECONDS in the fewest digits that read back as the same time.
std::string clipPoseText(const std::string& clip, double seconds);

class TimelinePanel : public QWidget {
  Q_OBJECT

 public:
  explicit TimelinePanel(document::StudyDocument& document, QWidget* parent = nullptr);

  /// While this says yes, playing leaves frames out instead of asking for more.
  void setBusyCheck(std::function<bool()> busy) { busy_ = std::move(busy); }
  bool isPlaying() const { return timer_.isActive(); }

  /// Space, Left and Right, anywhere in the window but where something is typed or chosen.
  QAction* playAction() const { return play_; }
  QAction* stepForwardAction() const { return stepForward_; }
  QAction* stepBackAction() const { return stepBack_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void makeActions();
  QWidget* makeControls();
  void refresh();
  void refillPoses();
  void choosePose();
  void showState();
  void showClip(const study::ClipPose& moment, double duration);
  QString whyNoTime() const;
  /// The clip and time that are shown; none at rest and in poses of turned joints.
  std::optional<study::ClipPose> shownMoment() const;
  std::optional<ClipFrames> framesOf(const std::string& clip) const;
  void showTime(double seconds);
  void showFrame(int frame);
  void step(int frames);
  void setPlaying(bool on);
  void restartClock();
  void tick();
  void keepPose();

  document::StudyDocument& document_;
  std::function<bool()> busy_;
  QStackedWidget* pages_;
  QComboBox* poses_ = nullptr;
  QAction* play_ = nullptr;
  QAction* stepForward_ = nullptr;
  QAction* stepBack_ = nullptr;
  QAction* first_ = nullptr;
  QAction* last_ = nullptr;
  QToolButton* loop_ = nullptr;
  QComboBox* speed_ = nullptr;
  MarkedSlider* slider_ = nullptr;
  ElidedLabel* where_ = nullptr;
  QDoubleSpinBox* time_ = nullptr;
  QToolButton* keep_ = nullptr;
  QTimer timer_;
  QElapsedTimer clock_;
  double playedFrom_ = 0.0;  ///< seconds of the clip when the clock was started
  bool ticking_ = false;
  bool refreshing_ = false;
};

}  // namespace lorica::panels
