#pragma once

/// \file
/// How organs deform, in numbers: a table of organs and one of pairs of organs, for the pose and the models that are
/// shown or for all poses, and bars that compare the models.

#include <QTimer>
#include <QWidget>

#include "lorica/jobs/deformation_controller.h"
#include "lorica/models/audit_table.h"

class QCheckBox;
class QChartView;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QStackedWidget;
class QTableView;
class QTabWidget;

namespace lorica::panels {

class BarFigure;

/// While it is seen it follows the pose and the models that are shown, once they have rested for a moment. Where one
/// model is shown, it is compared: a dynamic one with static_joint, a static one with dynamic.
class DeformationPanel : public QWidget {
  Q_OBJECT

 public:
  explicit DeformationPanel(document::StudyDocument& document, QWidget* parent = nullptr);
  ~DeformationPanel() override;

  using Report = std::shared_ptr<const jobs::DeformationReport>;
  /// What is shown; null before anything was measured.
  const Report& report() const { return report_; }
  void showReport(Report report);
  /// Measures the pose that is shown.
  void measurePose();
  /// Measures the poses that a run computes; of each organ the worst is shown.
  void measureAllPoses();

  jobs::DeformationController& controller() { return controller_; }
  models::AuditTable& organs() const { return *organs_.table; }
  models::AuditTable& contacts() const { return *contacts_.table; }
  const models::AuditFilter& organFilter() const { return *organs_.filter; }
  QTableView& organView() const { return *organs_.view; }
  const BarFigure& figure() const { return *figure_; }
  /// What stands above the tables: what was measured, and what is doubtful about it.
  QString caption() const;

 protected:
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Sheet {
    models::AuditTable* table = nullptr;
    models::AuditFilter* filter = nullptr;
    QTableView* view = nullptr;
  };

  QWidget* makeHeader();
  QWidget* makeChart();
  Sheet makeSheet(const char* name);
  std::vector<viscera::OrganModel> modelsToMeasure() const;
  bool isOfThePose() const;
  bool spansPoses() const { return report_ != nullptr && report_->tables.poses.size() > 1; }
  models::Measure measure() const;

  void follow();
  void updateState();
  void updateCaption();
  void updateRows();
  void updateChart();
  void takeSelection();
  void giveSelection(const QModelIndex& index);
  const Sheet& shownSheet() const;
  void copyShown() const;
  void copySelected() const;

  document::StudyDocument& document_;
  jobs::DeformationController controller_;
  Report report_;
  QTimer rest_;
  bool wantsAll_ = false;  ///< all poses were asked for, and nothing else since
  bool stopped_ = false;   ///< by the user: nothing is measured until asked for
  bool following_ = false;
  QString trouble_;

  Sheet organs_;
  Sheet contacts_;
  QStackedWidget* pages_ = nullptr;
  QLabel* empty_ = nullptr;
  QTabWidget* tabs_ = nullptr;
  QLabel* caption_ = nullptr;
  QPushButton* pose_ = nullptr;
  QPushButton* all_ = nullptr;
  QPushButton* stop_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QCheckBox* worst_ = nullptr;
  QComboBox* measure_ = nullptr;
  BarFigure* figure_ = nullptr;
  QChartView* chart_ = nullptr;
};

}  // namespace lorica::panels
