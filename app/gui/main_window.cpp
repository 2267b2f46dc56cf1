#include "main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolButton>
#include <QVBoxLayout>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/commands/edits.h"
#include "lorica/dialogs/file_kinds.h"
#include "lorica/dialogs/human_dialog.h"
#include "lorica/dialogs/import_dialog.h"
#include "lorica/study/study_file.h"
#include "status_facts.h"
#include "welcome_page.h"

namespace lorica::gui {

namespace {

namespace fs = std::filesystem;
using document::StudyDocument;

constexpr int recentLimit = 8;
constexpr int recentWidth = 560;
constexpr int statusSeconds = 8;
constexpr int belowHeight = 300;  ///< of the panels below the view when they open

fs::path pathOf(const QString& text) {
  return fs::path(text.toStdU16String());
}
QString textOf(const fs::path& path) {
  return QString::fromStdU16String(path.u16string());
}

QString studyFilter() {
  return MainWindow::tr("Lorica studies (*.lorica.json *.json)");
}

}  // namespace

MainWindow::MainWindow()
    : autosave_(document_, document::Autosave::defaultFolder()),
      loader_(document_),
      planner_(document_),
      runs_(document_) {
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
  makePanels();
  makeMenus();
  makeStatusBar();
  connectAll();
  updateTitle();
  updatePages();
  updateJobs();
  resize(1440, 900);
}

MainWindow::~MainWindow() {
  // Panels look at the document until they are gone, so they go first, and unseen.
  hide();
  view_->showFrame(nullptr);
  qDeleteAll(findChildren<QWidget*>(Qt::FindDirectChildrenOnly));
}

QDockWidget* MainWindow::dock(const QString& title, const char* name, QWidget* content, Qt::DockWidgetArea area) {
  auto* made = new QDockWidget(title, this);
  made->setObjectName(QLatin1String(name));
  made->setWidget(content);
  addDockWidget(area, made);
  return made;
}

void MainWindow::makePanels() {
  pages_ = new QStackedWidget;
  welcome_ = new WelcomePage;
  welcome_->setRecentFiles(recentFiles());
  pages_->addWidget(welcome_);
  auto* work = new QWidget;
  auto* column = new QVBoxLayout(work);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  view_ = new viewport::SceneView(document_);
  timeline_ = new panels::TimelinePanel(document_);
  column->addWidget(view_, 1);
  column->addWidget(timeline_);
  pages_->addWidget(work);
  setCentralWidget(pages_);

  project_ = new panels::ProjectPanel(document_);
  properties_ = new panels::PropertiesPanel(document_);
  results_ = new panels::ResultsPanel(document_);
  chart_ = new panels::CoverageChart;
  problems_ = new panels::ProblemsPanel(document_);
  inspection_ = new panels::InspectionPanel(document_);
  deformation_ = new panels::DeformationPanel(document_);
  shot_ = new panels::ShotPanel(document_);
  survey_ = new panels::SurveyPanel;
  setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  QDockWidget* projectDock = dock(tr("Project"), "project", project_, Qt::LeftDockWidgetArea);
  QDockWidget* propertiesDock = dock(tr("Properties"), "properties", properties_, Qt::LeftDockWidgetArea);
  inspectionDock_ = dock(tr("Inspect"), "inspect", inspection_, Qt::LeftDockWidgetArea);
  tabifyDockWidget(propertiesDock, inspectionDock_);
  propertiesDock->raise();
  resultsDock_ = dock(tr("Results"), "results", results_, Qt::BottomDockWidgetArea);
  chartDock_ = dock(tr("Chart"), "chart", chart_, Qt::BottomDockWidgetArea);
  problemsDock_ = dock(tr("Problems"), "problems", problems_, Qt::BottomDockWidgetArea);
  deformationDock_ = dock(tr("Deformation"), "deformation", deformation_, Qt::BottomDockWidgetArea);
  shotDock_ = dock(tr("Shot"), "shot", shot_, Qt::BottomDockWidgetArea);
  tabifyDockWidget(resultsDock_, deformationDock_);
  tabifyDockWidget(resultsDock_, shotDock_);
  surveyDock_ = dock(tr("Analyses"), "survey", survey_, Qt::BottomDockWidgetArea);
  tabifyDockWidget(resultsDock_, surveyDock_);
  tabifyDockWidget(resultsDock_, problemsDock_);
  resizeDocks({projectDock, propertiesDock}, {440, 300}, Qt::Vertical);
  resizeDocks({projectDock}, {320}, Qt::Horizontal);
  // The view has all the room until there is something to read below it.
  for (QDockWidget* below : {resultsDock_, chartDock_, deformationDock_, shotDock_, surveyDock_, problemsDock_}) {
    below->hide();
  }
  // The chart is of the results: what stands in their place has the chart's room too.
  connect(resultsDock_, &QDockWidget::visibilityChanged, this, [this](bool inFront) {
    if (!isVisible() || resultsDock_->isHidden()) {
      return;
    }
    if (inFront) {
      chartDock_->setHidden(!chartWaits_ && chartDock_->isHidden());
      chartWaits_ = false;
    } else {
      chartWaits_ = chartWaits_ || !chartDock_->isHidden();
      chartDock_->hide();
    }
  });
  shotLines_ = new dialogs::ShotLineDialog(document_, runs_, this);
}

void MainWindow::makeStatusBar() {
  working_ = new QLabel;
  progress_ = new QProgressBar;
  progress_->setRange(0, 1000);
  progress_->setMaximumWidth(200);
  progress_->setTextVisible(false);
  problemCount_ = new QToolButton;
  problemCount_->setAutoRaise(true);
  problemCount_->setToolTip(tr("What is odd about the study"));
  problemCount_->hide();
  connect(problemCount_, &QToolButton::clicked, this, &MainWindow::showProblems);
  cancel_ = new QToolButton;
  cancel_->setText(tr("Cancel"));
  facts_ = new StatusFacts(document_);
  for (QWidget* widget : std::initializer_list<QWidget*>{working_, progress_, cancel_, facts_, problemCount_}) {
    statusBar()->addPermanentWidget(widget);
  }
  connect(cancel_, &QToolButton::clicked, this, [this] {
    if (runs_.job() != nullptr) {
      runs_.cancel();
    } else if (saving_ != nullptr) {
      saving_->cancel();
    } else {
      loader_.cancel();
    }
  });
}

void MainWindow::connectAll() {
  connect(&document_, &StudyDocument::fileChanged, this, &MainWindow::updateTitle);
  connect(&document_, &StudyDocument::replaced, this, [this] {
    openedSample_ = false;
    engine_.setStudy(nullptr);
    view_->showFrame(nullptr);
    facts_->setFrame(nullptr);
    if (document_.runs().empty()) {
      resultsDock_->hide();
      chartDock_->hide();
    }
    problemsDock_->setHidden(problemsDock_->isHidden() || !document_.hasStudy());
    updatePages();
  });
  connect(&document_, &StudyDocument::loadedChanged, this, [this] {
    engine_.setStudy(document_.loaded());
    requestFrame();
  });
  connect(&document_, &StudyDocument::shownPoseChanged, this, &MainWindow::requestFrame);
  connect(&document_, &StudyDocument::shownModelsChanged, this, &MainWindow::requestFrame);
  connect(&document_, &StudyDocument::inspectionChanged, this, [this] {
    if (document_.inspection().showsDrivers()) {
      requestFrame();  // which brings what is drawn now
    }
  });
  connect(&engine_, &jobs::FrameEngine::frameReady, this, &MainWindow::takeFrame);
  connect(&engine_, &jobs::FrameEngine::failed, this,
          [this](const QString& text) { statusBar()->showMessage(text, 1000 * statusSeconds); });
  timeline_->setBusyCheck([this] { return engine_.isBusy(); });
  connect(view_, &viewport::SceneView::drawn, facts_, &StatusFacts::setDrawingTime);

  connect(&loader_, &jobs::StudyLoader::started, this, [this] {
    connect(loader_.job(), &jobs::Job::progressed, this, &MainWindow::updateJobs);
    updateJobs();
  });
  connect(&loader_, &jobs::StudyLoader::ended, this, &MainWindow::updateJobs);
  connect(&runs_, &jobs::RunController::started, this, [this] {
    connect(runs_.job(), &jobs::Job::progressed, this, &MainWindow::updateJobs);
    updateJobs();
  });
  connect(&runs_, &jobs::RunController::ended, this, &MainWindow::updateJobs);
  connect(&runs_, &jobs::RunController::finished, this, &MainWindow::takeRun);
  connect(&runs_, &jobs::RunController::failed, this,
          [this](const QString& text) { complain(tr("The run failed."), text); });

  connect(results_, &panels::ResultsPanel::runShown, chart_, &panels::CoverageChart::setRun);
  connect(results_, &panels::ResultsPanel::runShown, survey_, &panels::SurveyPanel::setRun);
  connect(results_, &panels::ResultsPanel::saveRequested, this, &MainWindow::saveTables);
  connect(chart_, &panels::CoverageChart::organPicked, this, [this](const std::string& organ) {
    document_.select(document::ItemRef{document::ItemKind::organ, organ});
  });
  connect(problems_, &panels::ProblemsPanel::countChanged, this, [this](int errors, int warnings) {
    const int count = errors + warnings;
    problemsDock_->setWindowTitle(count == 0 ? tr("Problems") : tr("Problems (%1)").arg(count));
    problemCount_->setText(count == 1 ? tr("1 problem") : tr("%1 problems").arg(count));
    problemCount_->setVisible(count > 0);
    if (errors > 0) {
      showProblems();
    }
  });
  connect(&autosave_, &document::Autosave::failed, this,
          [this](const QString& text) { statusBar()->showMessage(text, 1000 * statusSeconds); });

  connect(shotLines_, &dialogs::ShotLineDialog::shotDisplayChanged, this, [this](const dialogs::ShotDisplay& display) {
    shots_ = display;
    view_->setShotFilter(display.onlyFirstHit);
    requestFrame();
  });
  connect(&document_, &StudyDocument::planChanged, this, [this] {
    if (shots_.on) {
      requestFrame();  // with the shots of the run as it is now
    }
  });
  connect(view_, &viewport::SceneView::shotClicked, this, [this](const QString& name) {
    showShot();
    shot_->inspect(name);
  });
  connect(survey_, &panels::SurveyPanel::patchPicked, this,
          [this](const std::shared_ptr<const jobs::SkinPatch>& patch) {
            view_->markPatch(patch);
            if (patch != nullptr && document_.loaded() != nullptr && document_.loaded()->body == patch->body) {
              document_.showPose(patch->pose);
            }
          });
  connect(survey_, &panels::SurveyPanel::patchLookedAt, this,
          [this](const std::shared_ptr<const jobs::SkinPatch>& patch) {
            if (!patch->towards.isZero()) {
              view_->lookAlong(patch->towards, patch->centre);
            }
          });
  connect(shot_, &panels::ShotPanel::inspected, view_, &viewport::SceneView::markShot);
  connect(shotLines_, &dialogs::ShotLineDialog::pickRequested, this, [this](bool on) {
    const auto& sources = document_.study().sources;
    const auto source = std::find_if(sources.begin(), sources.end(),
                                     [this](const study::Source& s) { return s.name == shotLines_->source(); });
    view_->pickSource(on && source != sources.end() ? std::optional(source->position) : std::nullopt);
  });
  connect(view_, &viewport::SceneView::pickCancelled, shotLines_, &dialogs::ShotLineDialog::endPicking);
  connect(view_, &viewport::SceneView::picked, shotLines_, &dialogs::ShotLineDialog::setPickedPoint);

  connect(welcome_, &WelcomePage::openRequested, this, &MainWindow::chooseAndOpen);
  connect(welcome_, &WelcomePage::humanRequested, this, &MainWindow::newHumanStudy);
  connect(properties_, &panels::PropertiesPanel::personRequested, this, &MainWindow::changePerson);
  connect(welcome_, &WelcomePage::importRequested, this, [this] { importFiles({}); });
  connect(welcome_, &WelcomePage::sampleRequested, this, [this] { openSample(study::templateNames().front()); });
  connect(welcome_, &WelcomePage::fileRequested, this, &MainWindow::openFile);
}

// --- files ----------------------------------------------------------------------------------------------------------

void MainWindow::complain(const QString& what, const QString& why) {
  QMessageBox box(QMessageBox::Warning, tr("Lorica"), what, QMessageBox::Ok, this);
  box.setInformativeText(why);
  box.exec();
}

bool MainWindow::openFile(const QString& file) {
  if (!mayDiscard()) {
    return false;
  }
  try {
    document_.open(pathOf(file));
  } catch (const base::Error& error) {
    complain(tr("The study cannot be opened."), QString::fromUtf8(error.what()));
    return false;
  }
  remember(file);
  return true;
}

void MainWindow::openSample(const std::string& name) {
  document_.setStudy(study::parseStudy(study::templateText(name), name),
                     pathOf(QDir::current().filePath(QString::fromStdString(name) + QStringLiteral(".lorica.json"))));
  openedSample_ = true;
}

void MainWindow::newHumanStudy() {
  dialogs::HumanDialog dialog(dialogs::HumanDialog::Purpose::newStudy, {}, this);
  if (dialog.exec() == QDialog::Accepted && mayDiscard()) {
    document_.setStudy(dialog.study(), dialogs::freeStudyFile(pathOf(QDir::currentPath()), "human"));
  }
}

bool MainWindow::hasBuiltinHuman() const {
  return document_.hasStudy() && std::holds_alternative<study::Builtin>(document_.study().human.from);
}

void MainWindow::changePerson() {
  if (!hasBuiltinHuman()) {
    return;
  }
  dialogs::HumanDialog dialog(dialogs::HumanDialog::Purpose::changePerson, document_.study().person, this);
  if (dialog.exec() == QDialog::Accepted) {
    commands::setPerson(document_, dialog.person());
  }
}

void MainWindow::chooseAndOpen() {
  const QString file = QFileDialog::getOpenFileName(this, tr("Open a study"), {}, studyFilter());
  if (!file.isEmpty()) {
    openFile(file);
  }
}

bool MainWindow::save() {
  if (!document_.hasFile()) {
    return saveAs();
  }
  try {
    document_.save();
  } catch (const base::Error& error) {
    complain(tr("The study cannot be saved."), QString::fromUtf8(error.what()));
    return false;
  }
  return true;
}

bool MainWindow::saveAs() {
  const fs::path& proposal = document_.hasFile() ? document_.savedFile() : document_.file();
  QString file = QFileDialog::getSaveFileName(this, tr("Save the study as"), textOf(proposal), studyFilter());
  if (file.isEmpty()) {
    return false;
  }
  if (!file.endsWith(QLatin1String(".json"))) {
    file += QStringLiteral(".lorica.json");
  }
  try {
    document_.saveAs(pathOf(file));
  } catch (const base::Error& error) {
    complain(tr("The study cannot be saved."), QString::fromUtf8(error.what()));
    return false;
  }
  remember(file);
  return true;
}

void MainWindow::importFiles(const QStringList& files) {
  dialogs::ImportDialog dialog(document_, this);
  std::vector<fs::path> paths;
  for (const QString& file : files) {
    paths.push_back(pathOf(file));
  }
  dialog.addFiles(paths);
  if (dialog.exec() != QDialog::Accepted) {
    return;
  }
  if (dialog.addsToOpenStudy()) {
    commands::replaceStudy(document_, dialog.study(), dialog.addText());
  } else if (mayDiscard()) {
    document_.setStudy(dialog.study(), dialog.suggestedFile());
  }
}

void MainWindow::takeFiles(const QStringList& files) {
  QStringList meshes;
  for (const QString& file : files) {
    if (dialogs::isStudyFile(pathOf(file))) {
      openFile(file);
      return;
    }
    meshes.push_back(file);
  }
  if (!meshes.isEmpty()) {
    importFiles(meshes);
  }
}

void MainWindow::saveTables(const std::shared_ptr<const document::RunRecord>& run) {
  if (run == nullptr) {
    return;
  }
  const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder for the tables and provenance.json"));
  if (folder.isEmpty()) {
    return;
  }
  writeTables(run, folder);
}

void MainWindow::writeTables(const std::shared_ptr<const document::RunRecord>& run, const QString& folder) {
  try {
    analysis::writeResults(*run->study, run->result, pathOf(folder));
  } catch (const base::Error& error) {
    complain(tr("The tables cannot be saved."), QString::fromUtf8(error.what()));
    return;
  }
  statusBar()->showMessage(tr("The tables are in %1").arg(folder), 1000 * statusSeconds);
  if (!jobs::asksForSurvey(*run)) {
    return;
  }
  saveInBackground(
      tr("Working out the analyses"),
      [run, folder = pathOf(folder)](const base::Progress& progress) {
        analysis::writeAnalyses(*run->study, run->result, {}, folder, progress);
      },
      tr("All tables are in %1").arg(folder), tr("The tables cannot be saved."));
}

void MainWindow::saveInBackground(const QString& title, jobs::Job::Work work, const QString& saved,
                                  const QString& failure) {
  jobs::abandon(saving_, this);
  saving_ = std::make_unique<jobs::Job>(title, std::move(work));
  connect(saving_.get(), &jobs::Job::progressed, this, &MainWindow::updateJobs);
  connect(saving_.get(), &jobs::Job::finished, this,
          [this, saved] { statusBar()->showMessage(saved, 1000 * statusSeconds); });
  connect(saving_.get(), &jobs::Job::failed, this, [this, failure](const QString& text) { complain(failure, text); });
  connect(saving_.get(), &jobs::Job::ended, this, [this] {
    saving_.release()->deleteLater();
    updateJobs();
  });
  saving_->start();
  updateJobs();
}

void MainWindow::savePicture() {
  QString file = QFileDialog::getSaveFileName(this, tr("Save the picture as"), {}, tr("PNG pictures (*.png)"));
  if (file.isEmpty()) {
    return;
  }
  if (!file.endsWith(QLatin1String(".png"), Qt::CaseInsensitive)) {
    file += QStringLiteral(".png");
  }
  if (!view_->picture().save(file)) {
    complain(tr("The picture cannot be saved."), tr("%1 cannot be written; choose another place.").arg(file));
  }
}

bool MainWindow::mayDiscard() {
  // A sample that nobody touched can be had again.
  const bool untouchedSample = openedSample_ && document_.undoStack().count() == 0;
  if (!document_.isModified() || untouchedSample) {
    return true;
  }
  QMessageBox box(QMessageBox::Question, tr("Lorica"), tr("%1 has unsaved edits.").arg(document_.displayName()),
                  QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
  box.setInformativeText(tr("Save them first?"));
  switch (box.exec()) {
    case QMessageBox::Save:
      return save();
    case QMessageBox::Discard:
      return true;
    default:
      return false;
  }
}

QStringList MainWindow::recentFiles() const {
  return QSettings().value(QStringLiteral("recent")).toStringList();
}

void MainWindow::remember(const QString& file) {
  QStringList files = recentFiles();
  const QString absolute = QFileInfo(file).absoluteFilePath();
  files.removeAll(absolute);
  files.prepend(absolute);
  files = files.mid(0, recentLimit);
  QSettings().setValue(QStringLiteral("recent"), files);
  welcome_->setRecentFiles(files);
}

void MainWindow::fillRecentMenu() {
  recentMenu_->clear();
  for (const QString& file : recentFiles()) {
    const QString text = recentText(file, recentMenu_->fontMetrics(), recentWidth).replace('&', QLatin1String("&&"));
    QAction* action = recentMenu_->addAction(text, this, [this, file] { openFile(file); });
    action->setToolTip(file);
  }
  if (recentMenu_->isEmpty()) {
    recentMenu_->addAction(tr("none yet"))->setEnabled(false);
  }
}

void MainWindow::offerRecovery() {
  for (const document::Recovered& found : document::findRecovered(document::Autosave::defaultFolder())) {
    QMessageBox box(QMessageBox::Question, tr("Lorica"),
                    tr("Lorica ended before %1 was saved.").arg(textOf(found.file.filename())), QMessageBox::NoButton,
                    this);
    box.setInformativeText(tr("It was kept as it stood on %1.").arg(QString::fromStdString(found.when)));
    const QPushButton* take = box.addButton(tr("Recover"), QMessageBox::AcceptRole);
    const QPushButton* drop = box.addButton(tr("Throw away"), QMessageBox::DestructiveRole);
    box.addButton(tr("Later"), QMessageBox::RejectRole);
    box.exec();
    if (take == box.clickedButton()) {
      document_.restore(found.study, found.file, found.hadFile);
      autosave_.writeNow();
      document::discardRecovered(found);
      return;
    }
    if (drop == box.clickedButton()) {
      document::discardRecovered(found);
    }
  }
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!mayDiscard()) {
    event->ignore();
    return;
  }
  runs_.cancel();
  document_.close();
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event) {
  QStringList files;
  for (const QUrl& url : event->mimeData()->urls()) {
    if (url.isLocalFile()) {
      files.push_back(url.toLocalFile());
    }
  }
  event->acceptProposedAction();
  // The one who dropped must not wait for a dialog.
  QTimer::singleShot(0, this, [this, files] { takeFiles(files); });
}

// --- what is shown --------------------------------------------------------------------------------------------------

void MainWindow::showShotLines() {
  shotLines_->show();
  shotLines_->raise();
  shotLines_->activateWindow();
}

void MainWindow::takeRun(bool partial) {
  showResults();
  const auto& run = document_.runs().back();
  if (jobs::asksForSurvey(*run)) {
    // Beside the results, where one sees that there is more to have.
    surveyDock_->show();
    resultsDock_->raise();
  }
  // The dialog would stand before what it was opened for; it keeps all that was put in.
  if (shotLines_->isVisible()) {
    shotLines_->hide();
    activateWindow();
  }
  statusBar()->showMessage(partial ? tr("The run was stopped; what was finished is kept and marked as partial.")
                                   : tr("%1 is finished.").arg(QString::fromStdString(run->name)),
                           1000 * statusSeconds);
}

void MainWindow::showResults() {
  const bool opens = resultsDock_->isHidden() && chartDock_->isHidden();
  resultsDock_->show();
  resultsDock_->raise();
  if (opens) {
    chartDock_->show();
    resizeDocks({resultsDock_, chartDock_}, {660, 460}, Qt::Horizontal);
    resizeDocks({resultsDock_}, {belowHeight}, Qt::Vertical);
  }
}

void MainWindow::showBelow(QDockWidget* dock) {
  const QList<QDockWidget*> sharers{resultsDock_, deformationDock_, shotDock_, surveyDock_, problemsDock_};
  const bool opens =
      std::all_of(sharers.begin(), sharers.end(), [](const QDockWidget* one) { return one->isHidden(); });
  dock->show();
  dock->raise();
  if (opens) {
    resizeDocks({dock}, {belowHeight}, Qt::Vertical);
  }
}

void MainWindow::showProblems() {
  showBelow(problemsDock_);
}

void MainWindow::showShot() {
  showBelow(shotDock_);
}

void MainWindow::showSurvey() {
  showBelow(surveyDock_);
}

void MainWindow::showDeformation() {
  showBelow(deformationDock_);
}

void MainWindow::requestFrame() {
  if (document_.loaded() == nullptr) {
    return;
  }
  jobs::FrameRequest request;
  request.pose = document_.shownPose();
  request.models = document_.shownModels();
  if (shots_.on) {
    request.shotSource = shots_.source;
    request.shotLimit = shots_.limit;
    const auto& plan = document_.plan();
    if (plan != nullptr && plan->study == document_.loaded() && shots_.source < plan->result.sources.size()) {
      request.planned = plan->result.sources[shots_.source];
    }
  }
  if (document_.inspection().showsDrivers()) {
    request.driversOf = document_.inspection().organ;
  }
  view_->expectFrame();
  engine_.request(std::move(request));
}

void MainWindow::takeFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  if (frame->study != document_.loaded()) {
    return;
  }
  view_->showFrame(frame);
  facts_->setFrame(frame);
}

void MainWindow::updateTitle() {
  setWindowTitle(document_.hasStudy() ? tr("%1[*] - Lorica").arg(document_.displayName()) : tr("Lorica"));
  setWindowModified(document_.hasStudy() && document_.isModified());
}

void MainWindow::updatePages() {
  pages_->setCurrentIndex(document_.hasStudy() ? 1 : 0);
  for (QAction* action : studyActions_) {
    action->setEnabled(document_.hasStudy());
  }
}

void MainWindow::updateJobs() {
  const jobs::Job* job = runs_.job() != nullptr ? runs_.job() : saving_ != nullptr ? saving_.get() : loader_.job();
  for (QWidget* widget : {static_cast<QWidget*>(working_), static_cast<QWidget*>(progress_)}) {
    widget->setVisible(job != nullptr);
  }
  cancel_->setVisible(job != nullptr);
  if (job != nullptr) {
    const QString left = job->timeLeft();
    working_->setText(left.isEmpty() ? job->title() : tr("%1, %2").arg(job->title(), left));
    progress_->setValue(static_cast<int>(1000.0 * job->progress()));
  }
}

}  // namespace lorica::gui
