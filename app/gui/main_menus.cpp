/// \file
/// The menus and the tool bar of the window.

#include <QActionGroup>
#include <QDockWidget>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>
#include <QUndoStack>

#include "lorica/models/model_texts.h"
#include "lorica/study/provenance.h"
#include "lorica/study/study_file.h"
#include "main_window.h"
#include "model_chooser.h"

namespace lorica::gui {

void MainWindow::makeMenus() {
  makeFileMenu();
  makeEditMenu();
  makeViewMenu();
  makeAnalysisMenu();
  QMenu* help = menuBar()->addMenu(tr("&Help"));
  help->addAction(tr("&About Lorica"), this, [this] {
    QMessageBox::about(this, tr("About Lorica"),
                       tr("<b>Lorica %1</b><p>Compares designs of body armor on a digital human that takes the "
                          "postures of real tasks. The purpose is protective: it says which part of a person armor "
                          "covers, nothing about what a hit does.</p><p>Free software under the GNU General Public "
                          "License, version 3 or later.</p>")
                           .arg(QString::fromStdString(study::version())));
  });
}

void MainWindow::makeFileMenu() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  file->addAction(tr("&New study with the built-in human..."), QKeySequence::New, this, &MainWindow::newHumanStudy);
  file->addAction(tr("&Open..."), QKeySequence::Open, this, &MainWindow::chooseAndOpen);
  recentMenu_ = file->addMenu(tr("Open &recent"));
  recentMenu_->setToolTipsVisible(true);
  connect(recentMenu_, &QMenu::aboutToShow, this, &MainWindow::fillRecentMenu);
  QMenu* samples = file->addMenu(tr("Open a s&ample"));
  for (const std::string& name : study::templateNames()) {
    samples->addAction(QString::fromStdString(name), this, [this, name] {
      if (mayDiscard()) {
        openSample(name);
      }
    });
  }
  file->addAction(tr("&Import..."), QKeySequence(tr("Ctrl+I")), this, [this] { importFiles({}); });
  file->addSeparator();
  QAction* saveAction = file->addAction(tr("&Save"), QKeySequence::Save, this, &MainWindow::save);
  QAction* saveAsAction = file->addAction(tr("Save &as..."), QKeySequence::SaveAs, this, &MainWindow::saveAs);
  file->addSeparator();
  QAction* tables = file->addAction(tr("Save result &tables..."), this, [this] { saveTables(results_->run()); });
  QAction* report = file->addAction(tr("&Export report..."), this, &MainWindow::chooseReport);
  report->setObjectName(QStringLiteral("export_report"));
  QAction* picture = file->addAction(tr("Save &picture..."), this, &MainWindow::savePicture);
  file->addSeparator();
  file->addAction(tr("&Quit"), QKeySequence::Quit, this, &QWidget::close);
  file->setToolTipsVisible(true);
  const auto enable = [this, saveAction, saveAsAction, tables, report, picture] {
    saveAction->setEnabled(document_.hasStudy());
    saveAsAction->setEnabled(document_.hasStudy());
    picture->setEnabled(document_.hasStudy());
    tables->setEnabled(results_->run() != nullptr);
    report->setEnabled(results_->run() != nullptr);
    report->setToolTip(results_->run() != nullptr
                           ? tr("Tables, figures, pictures and methods of the run that is shown, as PDF")
                           : tr("There is no run to report on yet; run the study first (Ctrl+R)."));
  };
  enable();
  connect(file, &QMenu::aboutToShow, this, enable);
}

void MainWindow::makeEditMenu() {
  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  QAction* undo = document_.undoStack().createUndoAction(this, tr("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = document_.undoStack().createRedoAction(this, tr("&Redo"));
  redo->setShortcut(QKeySequence::Redo);
  edit->addAction(undo);
  edit->addAction(redo);
  edit->addSeparator();
  QAction* person = edit->addAction(tr("Change the &person..."), this, &MainWindow::changePerson);
  person->setObjectName(QStringLiteral("change_person"));
  connect(edit, &QMenu::aboutToShow, this, [this, person] { person->setEnabled(hasBuiltinHuman()); });
}

void MainWindow::makeViewMenu() {
  using viewport::StandardView;
  QMenu* menu = menuBar()->addMenu(tr("&View"));
  const auto look = [&](const QString& text, const char* key, StandardView from) {
    menu->addAction(text, QKeySequence(QLatin1String(key)), this, [this, from] { view_->lookFrom(from); });
  };
  look(tr("From the &front"), "1", StandardView::front);
  look(tr("From the &back"), "2", StandardView::back);
  look(tr("From the person's &left"), "3", StandardView::left);
  look(tr("From the person's &right"), "4", StandardView::right);
  look(tr("From &above"), "5", StandardView::top);
  look(tr("From b&elow"), "6", StandardView::bottom);
  menu->addAction(tr("&Whole body"), QKeySequence(tr("F")), view_, &viewport::SceneView::fit);
  menu->addAction(tr("&Selected structure"), QKeySequence(tr("Shift+F")), view_, &viewport::SceneView::fitSelection);
  menu->addSeparator();
  for (QAction* action : {timeline_->playAction(), timeline_->stepBackAction(), timeline_->stepForwardAction()}) {
    menu->addAction(action);
  }
  menu->addSeparator();
  QAction* compass = menu->addAction(tr("A&zimuth and elevation of the selected source"));
  compass->setObjectName(QStringLiteral("compass"));
  compass->setCheckable(true);
  compass->setChecked(true);
  connect(compass, &QAction::toggled, view_, &viewport::SceneView::showCompass);
  makeColouringMenu(*menu->addMenu(tr("&Colours of organs say")));
  menu->addAction(tr("What &drives an organ"), this, [this] {
    inspectionDock_->show();
    inspectionDock_->raise();
  });
  menu->addSeparator();
  panelsMenu_ = menu->addMenu(tr("&Panels"));
  for (const QDockWidget* panel : findChildren<QDockWidget*>()) {
    panelsMenu_->addAction(panel->toggleViewAction());
  }
}

void MainWindow::makeColouringMenu(QMenu& menu) {
  auto* group = new QActionGroup(this);
  for (const models::ColouringText& text : models::colouringTexts()) {
    QAction* action = menu.addAction(text.label, this, [this, colouring = text.colouring] {
      document::Inspection wanted = document_.inspection();
      wanted.colouring = colouring;
      document_.inspect(wanted);
    });
    action->setCheckable(true);
    action->setToolTip(text.tip);
    group->addAction(action);
    connect(&menu, &QMenu::aboutToShow, action, [this, action, colouring = text.colouring] {
      action->setChecked(document_.inspection().colouring == colouring);
    });
  }
}

void MainWindow::makeAnalysisMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&Analysis"));
  QAction* shotLines =
      menu->addAction(tr("Shot &lines..."), QKeySequence(tr("Ctrl+L")), this, &MainWindow::showShotLines);
  QAction* run = menu->addAction(tr("&Run"), QKeySequence(tr("Ctrl+R")), this, [this] {
    if (const QString why = runs_.start(); !why.isEmpty()) {
      complain(tr("The study cannot be run."), why);
    }
  });
  menu->addAction(tr("&Stop the run"), &runs_, &jobs::RunController::cancel);
  menu->addSeparator();
  QAction* deformation =
      menu->addAction(tr("&Deformation of organs"), QKeySequence(tr("Ctrl+D")), this, &MainWindow::showDeformation);
  QAction* shot = menu->addAction(tr("Single s&hot"), this, &MainWindow::showShot);
  QAction* survey = menu->addAction(tr("&Analyses of a run"), this, &MainWindow::showSurvey);
  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName(QStringLiteral("tools"));
  bar->setMovable(false);
  bar->addAction(shotLines);
  bar->addAction(run);
  bar->addAction(deformation);
  bar->addSeparator();
  QAction* models = bar->addWidget(new ModelChooser(document_));
  studyActions_ = {shotLines, run, deformation, shot, survey, models};
}

}  // namespace lorica::gui
