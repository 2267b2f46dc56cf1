#pragma once

/// \file
/// Where shots come from, what is shot at, and the run. Every edit is a command on the document; the window stays
/// usable beside it.

#include <QDialog>
#include <QElapsedTimer>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "lorica/jobs/run_controller.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QListWidget;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QToolButton;

namespace lorica::panels {
class PropertyForm;
class SourceDraft;
}  // namespace lorica::panels

namespace lorica::dialogs {

/// Which shots are drawn in the view.
struct ShotDisplay {
  bool on = false;
  std::size_t source = 0;  ///< index into Study::sources
  std::size_t limit = 300;
  /// Only shots that meet this first: "hits" (anything), "body", "armor", "organs" or a structure; empty: all shots,
  /// also those that miss.
  std::string onlyFirstHit = "hits";
  bool operator==(const ShotDisplay&) const = default;
};

class ShotLineDialog : public QDialog {
  Q_OBJECT

 public:
  /// \pre both outlive the dialog
  ShotLineDialog(document::StudyDocument& document, jobs::RunController& runs, QWidget* parent = nullptr);
  ~ShotLineDialog() override;

  /// A point picked in the view becomes the source's position, and picking ends.
  void setPickedPoint(const geometry::Vec3d& point);
  /// Picking ended without a point.
  void endPicking();
  const ShotDisplay& shotDisplay() const { return display_; }
  /// Name of the source that is edited; empty when the study has none.
  const std::string& source() const { return source_; }

 Q_SIGNALS:
  /// Whether clicks in the view should pick a point.
  void pickRequested(bool on);
  void shotDisplayChanged(lorica::dialogs::ShotDisplay display);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  QWidget* makeSourceSide();
  QWidget* makeRunSide();
  QWidget* makeRunPage();
  QWidget* makeViewRows();
  QWidget* makeRunRow();
  void refresh();
  void refreshSources();
  void refreshPoses();
  void refreshStructures();
  void refreshRun();
  void writePoses();
  void checkAllPoses(bool on);
  void renameSource();
  void updateDisplay();
  void measure();
  QString estimateText() const;
  QString whyNotRun() const;
  void runStarted();
  void runEnded();

  document::StudyDocument& document_;
  jobs::RunController& runs_;
  std::string source_;
  std::set<std::string> extraPoses_;  ///< clips at a time that the run listed once, beside the study's poses
  bool noPose_ = false;               ///< none is checked, which a study cannot say
  bool refreshing_ = false;
  ShotDisplay display_;

  QWidget* sourceSide_ = nullptr;
  QWidget* runSide_ = nullptr;
  QComboBox* sources_ = nullptr;
  QToolButton* duplicateSource_ = nullptr;
  QToolButton* removeSource_ = nullptr;
  QToolButton* renameSource_ = nullptr;
  panels::PropertyForm* sourceForm_ = nullptr;
  std::shared_ptr<panels::SourceDraft> draft_;
  QPushButton* pick_ = nullptr;
  QListWidget* poses_ = nullptr;
  panels::PropertyForm* runForm_ = nullptr;
  panels::PropertyForm* analysesForm_ = nullptr;
  QCheckBox* showShots_ = nullptr;
  QSpinBox* limit_ = nullptr;
  QComboBox* firstHit_ = nullptr;
  QLabel* estimate_ = nullptr;
  QLabel* outcome_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QPushButton* run_ = nullptr;
  QPushButton* cancel_ = nullptr;

  std::unique_ptr<jobs::Job> measuring_;
  std::optional<jobs::SpeedEstimate> speed_;
  QString measured_;  ///< what of the study the speed was measured for
  QElapsedTimer clock_;
  double shotsAsked_ = 0.0;
  double posesAsked_ = 0.0;
  QString result_;  ///< how the last run ended
};

}  // namespace lorica::dialogs
