#pragma once

/// \file
/// The window: it only wires the document, the jobs, the view, panels and dialogs together.

#include <QList>
#include <QMainWindow>
#include <QStringList>
#include <filesystem>
#include <memory>

#include "lorica/dialogs/shot_line_dialog.h"
#include "lorica/document/recovery.h"
#include "lorica/document/study_document.h"
#include "lorica/jobs/frame_engine.h"
#include "lorica/jobs/run_controller.h"
#include "lorica/jobs/run_planner.h"
#include "lorica/jobs/study_loader.h"
#include "lorica/panels/coverage_chart.h"
#include "lorica/panels/deformation_panel.h"
#include "lorica/panels/inspection_panel.h"
#include "lorica/panels/problems_panel.h"
#include "lorica/panels/project_panel.h"
#include "lorica/panels/properties_panel.h"
#include "lorica/panels/results_panel.h"
#include "lorica/panels/shot_panel.h"
#include "lorica/panels/survey_panel.h"
#include "lorica/panels/timeline_panel.h"
#include "lorica/viewport/scene_view.h"

class QDockWidget;
class QLabel;
class QMenu;
class QProgressBar;
class QStackedWidget;
class QToolButton;

namespace lorica::gui {

class StatusFacts;
class WelcomePage;

class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow();
  ~MainWindow() override;

  document::StudyDocument& document() { return document_; }
  viewport::SceneView& view() { return *view_; }
  jobs::StudyLoader& loader() { return loader_; }
  jobs::RunController& runs() { return runs_; }
  jobs::FrameEngine& engine() { return engine_; }
  panels::ResultsPanel& results() { return *results_; }
  panels::CoverageChart& chart() { return *chart_; }
  panels::DeformationPanel& deformation() { return *deformation_; }
  panels::ShotPanel& shot() { return *shot_; }
  panels::SurveyPanel& survey() { return *survey_; }
  dialogs::ShotLineDialog& shotLines() { return *shotLines_; }

  /// Opens a study file; says why when it cannot be. \return whether it is open now
  bool openFile(const QString& file);
  /// Opens a sample built into the program.
  void openSample(const std::string& name);
  /// Takes studies and meshes that were dropped or named on the command line.
  void takeFiles(const QStringList& files);
  /// Offers what a crash left behind.
  void offerRecovery();
  void showShotLines();
  /// The panel that looks into single shots.
  void showShot();
  /// The panel of coverage by direction and over a motion.
  void showSurvey();
  void showDeformation();
  /// Asks for a person, armor and organs, and takes the study of them.
  void newHumanStudy();
  /// Writes the report of a run as PDF in the background: its tables, what they ask to be shot for, pictures.
  void exportReport(const std::shared_ptr<const document::RunRecord>& run, const QString& file);
  /// The job that writes tables or a report; null when none does.
  const jobs::Job* saving() const { return saving_.get(); }
  /// Asks whom the built-in human stands for. \pre the open study has the built-in human
  void changePerson();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void makePanels();
  void makeMenus();
  void makeFileMenu();
  void makeEditMenu();
  void makeViewMenu();
  void makeColouringMenu(QMenu& menu);
  void makeAnalysisMenu();
  void makeStatusBar();
  /// Shows what a run gave.
  void takeRun(bool partial);
  /// Opens the panels of results below the view, if they are not.
  void showResults();
  /// Shows a panel below the view; gives it some height when it is the first there.
  void showBelow(QDockWidget* dock);
  void showProblems();
  void connectAll();
  QDockWidget* dock(const QString& title, const char* name, QWidget* content, Qt::DockWidgetArea area);

  bool hasBuiltinHuman() const;
  void chooseAndOpen();
  bool save();
  bool saveAs();
  void importFiles(const QStringList& files);
  /// Writes the tables of a run to a folder, and in the background those that have to be shot for.
  void writeTables(const std::shared_ptr<const document::RunRecord>& run, const QString& folder);
  void saveTables(const std::shared_ptr<const document::RunRecord>& run);
  /// Writes something on another thread, with progress and cancel in the status bar. What was still being written is
  /// given up.
  /// \param saved said when it is done; \param failure said before the reason when it is not
  void saveInBackground(const QString& title, jobs::Job::Work work, const QString& saved, const QString& failure);
  /// Asks where the report of the run that is shown goes.
  void chooseReport();
  void savePicture();
  /// Asks what becomes of unsaved edits. \return whether to go on
  bool mayDiscard();
  void remember(const QString& file);
  QStringList recentFiles() const;
  void fillRecentMenu();
  void complain(const QString& what, const QString& why);

  void requestFrame();
  void takeFrame(const std::shared_ptr<const jobs::Frame>& frame);
  void updateTitle();
  void updatePages();
  void updateJobs();

  document::StudyDocument document_;
  document::Autosave autosave_;
  jobs::StudyLoader loader_;
  jobs::FrameEngine engine_;
  jobs::RunPlanner planner_;
  jobs::RunController runs_;
  std::unique_ptr<jobs::Job> saving_;  ///< of tables that have to be shot for
  dialogs::ShotDisplay shots_;
  bool chartWaits_ = false;    ///< hidden for what stands before the results, and comes back with them
  bool openedSample_ = false;  ///< the study is a built-in sample

  QStackedWidget* pages_ = nullptr;
  WelcomePage* welcome_ = nullptr;
  viewport::SceneView* view_ = nullptr;
  panels::TimelinePanel* timeline_ = nullptr;
  panels::ProjectPanel* project_ = nullptr;
  panels::PropertiesPanel* properties_ = nullptr;
  panels::ResultsPanel* results_ = nullptr;
  panels::CoverageChart* chart_ = nullptr;
  panels::ProblemsPanel* problems_ = nullptr;
  panels::InspectionPanel* inspection_ = nullptr;
  panels::DeformationPanel* deformation_ = nullptr;
  panels::ShotPanel* shot_ = nullptr;
  panels::SurveyPanel* survey_ = nullptr;
  dialogs::ShotLineDialog* shotLines_ = nullptr;
  QDockWidget* inspectionDock_ = nullptr;
  QDockWidget* resultsDock_ = nullptr;
  QDockWidget* chartDock_ = nullptr;
  QDockWidget* deformationDock_ = nullptr;
  QDockWidget* problemsDock_ = nullptr;
  QDockWidget* shotDock_ = nullptr;
  QDockWidget* surveyDock_ = nullptr;
  QList<QAction*> studyActions_;  ///< of the tool bar, nothing without a study
  QToolButton* problemCount_ = nullptr;
  QMenu* panelsMenu_ = nullptr;
  QMenu* recentMenu_ = nullptr;
  StatusFacts* facts_ = nullptr;
  QLabel* working_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QToolButton* cancel_ = nullptr;
};

}  // namespace lorica::gui
