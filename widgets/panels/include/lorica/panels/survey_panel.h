#pragma once

/// \file
/// Coverage of one structure by direction, as a map, and over a motion, as lines: what the study of a run asks for
/// beside the run. It is computed when it is asked for.

#include <QWidget>
#include <memory>

#include "lorica/jobs/job.h"
#include "lorica/jobs/run_survey.h"
#include "lorica/panels/direction_map.h"

class QChartView;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QStackedWidget;

namespace lorica::panels {

class SurveyPanel : public QWidget {
  Q_OBJECT

 public:
  explicit SurveyPanel(QWidget* parent = nullptr);
  ~SurveyPanel() override;

  /// Null: nothing to show.
  void setRun(std::shared_ptr<const document::RunRecord> run);
  /// Computes what the run's study asks for.
  void compute();
  bool isBusy() const { return job_ != nullptr; }
  /// Null until it is computed.
  const std::shared_ptr<const jobs::RunSurvey>& survey() const { return survey_; }
  const DirectionMap& map() const { return *map_; }
  const QChartView& lines() const { return *lines_; }
  /// What is shown, a row for each cell of the map or point of a line.
  QByteArray csv() const;

 protected:
  void changeEvent(QEvent* event) override;

 private:
  QWidget* makeControls();
  void refreshChoices();
  void refreshPages();
  void refreshFigure();
  bool showsMotion() const;
  MapData mapData() const;
  void drawLines();

  std::shared_ptr<const document::RunRecord> run_;
  std::shared_ptr<const jobs::RunSurvey> survey_;
  std::unique_ptr<jobs::Job> job_;
  QString trouble_;
  QStackedWidget* pages_;
  QComboBox* what_ = nullptr;
  QComboBox* structure_ = nullptr;
  QComboBox* system_ = nullptr;
  QComboBox* model_ = nullptr;
  QComboBox* pose_ = nullptr;
  QComboBox* source_ = nullptr;
  QLabel* words_ = nullptr;
  QLabel* worst_ = nullptr;
  QPushButton* compute_ = nullptr;
  QPushButton* stop_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QStackedWidget* figures_ = nullptr;
  DirectionMap* map_ = nullptr;
  QChartView* lines_ = nullptr;
};

}  // namespace lorica::panels
