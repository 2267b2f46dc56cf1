#pragma once

/// \file
/// What the study of a run asks for beside the run: coverage of one structure by direction, as a map, and over a
/// motion, as lines; gaps in the armor and coverage over the places where organs may lie, as tables. It is computed
/// when it is asked for.

#include <QWidget>
#include <memory>

#include "lorica/jobs/job.h"
#include "lorica/jobs/run_survey.h"
#include "lorica/models/value_table.h"
#include "lorica/panels/direction_map.h"

class QChartView;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSortFilterProxyModel;
class QStackedWidget;
class QTableView;

namespace lorica::panels {

enum SurveyWhat { coverageByDirection, openByDirection, coverageOverTime, gapsInArmor, placesOfOrgans };

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
  QTableView& table() const { return *table_; }
  /// What is shown, a row for each cell of the map or point of a line; of tables the rows of gaps.csv or anatomy.csv.
  QByteArray csv() const;

 Q_SIGNALS:
  /// A gap was chosen, or (null) none is any more.
  void patchPicked(const std::shared_ptr<const lorica::jobs::SkinPatch>& patch);
  /// One wants to see a gap as the shots do.
  void patchLookedAt(const std::shared_ptr<const lorica::jobs::SkinPatch>& patch);

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
  bool showsTable() const;
  QWidget* makeTables();
  void fillTable();
  QByteArray csvOfTable() const;
  /// The gap of a row of the table; null when it shows none.
  std::shared_ptr<const jobs::SkinPatch> patchOf(const QModelIndex& shown) const;
  void pickPatch(std::shared_ptr<const jobs::SkinPatch> patch);

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
  QTableView* table_ = nullptr;
  models::ValueTable* values_ = nullptr;
  QSortFilterProxyModel* sorted_ = nullptr;
  std::vector<analysis::Gap> gaps_;                ///< of the table's rows
  std::optional<analysis::AnatomyResult> places_;  ///< with the table's rows; none while it shows gaps
  std::shared_ptr<const jobs::SkinPatch> picked_;
};

}  // namespace lorica::panels
