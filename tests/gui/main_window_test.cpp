#include "main_window.h"

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QDropEvent>
#include <QFile>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QMouseEvent>
#include <QProcess>
#include <QSignalSpy>
#include <QSlider>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QUndoStack>
#include <algorithm>
#include <functional>
#include <numeric>

#include "lorica/analysis/results.h"
#include "lorica/commands/edits.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/dialogs/human_dialog.h"
#include "lorica/dialogs/import_dialog.h"
#include "lorica/document/appearance.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"
#include "lorica/io/export.h"
#include "lorica/models/model_texts.h"
#include "lorica/study/study_file.h"
#include "welcome_page.h"

namespace lorica::gui {
namespace {

using document::ItemKind;
using document::ItemRef;
using viscera::OrganModel;

constexpr int patience = 30000;

/// A window on the sample study, saved in a folder of its own, drawn once.
class Window : public testing::Test {
 protected:
  Window() {
    study::Study study = study::parseStudy(study::templateText("sample"), "sample");
    study.sources.front().shots = 2000;
    study.trials = 2;
    study.runPoses = {"rest", "toe_touch@2"};
    file_ = QDir(folder_.path()).filePath("sample.lorica.json");
    study::saveStudy(study, file_.toStdString());
    window_.resize(1200, 800);
    window_.show();
  }

  void open() {
    ASSERT_TRUE(window_.openFile(file_));
    waitForFrame("rest");
  }
  /// Until this pose is what the view shows.
  void waitForFrame(const std::string& pose) {
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          const auto& frame = window_.view().frame();
          return window_.loader().isInStep() && frame != nullptr && frame->pose == pose &&
                 frame->study == window_.document().loaded() &&
                 frame->scene->models() == window_.document().shownModels() && !window_.engine().isBusy();
        },
        patience));
    QCoreApplication::processEvents();
  }
  std::string bytes() { return study::studyText(window_.document().study()); }
  QImage picture() { return window_.view().picture(); }

  /// Presses a button of the next message box, and keeps what it said.
  void answer(QMessageBox::StandardButton button) {
    auto* timer = new QTimer(&window_);
    QObject::connect(timer, &QTimer::timeout, &window_, [this, timer, button] {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        said_ = box->text() + " " + box->informativeText();
        timer->deleteLater();
        box->button(button)->click();
      }
    });
    timer->start(20);
  }

  QTemporaryDir folder_;
  QString file_;
  QString said_;
  MainWindow window_;
};

/// How many pixels differ clearly.
int differing(const QImage& a, const QImage& b) {
  if (a.size() != b.size()) {
    return a.width() * a.height();
  }
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y);
      const QRgb q = b.pixel(x, y);
      count += std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) + std::abs(qBlue(p) - qBlue(q)) > 40;
    }
  }
  return count;
}

/// Pixels that are clearly more of one primary than of the others: 0 red, 1 green, 2 blue.
int ofColour(const QImage& image, int primary) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QRgb p = image.pixel(x, y);
      const std::array channels{qRed(p), qGreen(p), qBlue(p)};
      const int mine = channels.at(static_cast<std::size_t>(primary));
      count += mine > 60 && 2 * mine > 3 * (channels[0] + channels[1] + channels[2] - mine);
    }
  }
  return count;
}

TEST_F(Window, ShowsTheBodyOfAStudyThatIsOpened) {
  EXPECT_EQ(window_.view().frame(), nullptr);
  open();
  const QImage shown = picture();
  window_.view().showFrame(nullptr);
  EXPECT_GT(differing(shown, picture()), 5000) << "a body, organs and armor cover this much at least";
}

TEST_F(Window, ScrubbingDeformsWhatIsSeenAndRestComesBackToThePixel) {
  open();
  QTest::qWait(400);  // until the view draws in full again
  const QImage rest = picture();
  window_.document().showPose("toe_touch@2");
  waitForFrame("toe_touch@2");
  EXPECT_GT(differing(rest, picture()), 5000);
  window_.document().showPose("rest");
  waitForFrame("rest");
  QTest::qWait(400);
  EXPECT_EQ(differing(rest, picture()), 0);
}

/// What signals of drawings told: how many were coarse and how many in full.
std::pair<int, int> coarseAndFull(const QSignalSpy& drawn) {
  const auto coarse = std::count_if(drawn.begin(), drawn.end(), [](const auto& told) { return told[1].toBool(); });
  return {static_cast<int>(coarse), static_cast<int>(drawn.size() - coarse)};
}

TEST_F(Window, WhereDrawingIsSlowItIsCoarseInMotionAndInFullAfterRest) {
  open();
  window_.view().setPatience(0.0);  // every drawing is too slow
  window_.document().showPose("toe_touch@2");
  waitForFrame("toe_touch@2");
  QTest::qWait(500);
  const QImage atRest = picture();
  QSignalSpy drawn(&window_.view(), &viewport::SceneView::drawn);
  for (const char* pose : {"toe_touch@1", "toe_touch@1.5", "toe_touch@2"}) {
    window_.document().showPose(pose);
    waitForFrame(pose);
  }
  ASSERT_TRUE(QTest::qWaitFor([&] { return coarseAndFull(drawn).second > 0; }, patience));
  EXPECT_GE(coarseAndFull(drawn).first, 1) << "in motion";
  EXPECT_FALSE(drawn.back()[1].toBool()) << "at rest";
  const auto count = drawn.size();
  QTest::qWait(500);
  EXPECT_EQ(drawn.size(), count) << "nothing moves any more";
  EXPECT_EQ(differing(atRest, picture()), 0);
}

TEST_F(Window, WhereDrawingIsFastItIsAlwaysInFull) {
  open();
  window_.view().setPatience(1e9);
  picture();  // nothing waits to be drawn any more
  QSignalSpy drawn(&window_.view(), &viewport::SceneView::drawn);
  window_.document().showPose("toe_touch@2");
  waitForFrame("toe_touch@2");
  QTest::qWait(500);
  EXPECT_EQ(coarseAndFull(drawn).first, 0);
  EXPECT_EQ(coarseAndFull(drawn).second, 1) << "one frame, one drawing";
}

TEST_F(Window, TurningTheCameraIsCoarseUntilTheButtonIsLetGo) {
  open();
  window_.view().setPatience(0.0);
  picture();
  QTest::qWait(500);  // until there are coarse triangles, and all rests
  auto* canvas = window_.view().findChild<QWidget*>();
  const QPoint middle = canvas->rect().center();
  QSignalSpy drawn(&window_.view(), &viewport::SceneView::drawn);
  QTest::mousePress(canvas, Qt::LeftButton, {}, middle);
  for (int i = 1; i <= 5; ++i) {
    QMouseEvent move(QEvent::MouseMove, middle + QPointF(10.0 * i, 0.0),
                     canvas->mapToGlobal(middle + QPoint(10 * i, 0)), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(canvas, &move);
    QTest::qWait(20);
  }
  QTest::qWait(500);
  EXPECT_GE(coarseAndFull(drawn).first, 1);
  EXPECT_EQ(coarseAndFull(drawn).second, 0) << "the button is held";
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, middle + QPoint(50, 0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return coarseAndFull(drawn).second > 0; }, patience));
  EXPECT_FALSE(drawn.back()[1].toBool());
}

TEST_F(Window, ManyMovesOfTheMouseGiveFewDrawings) {
  open();
  QTest::qWait(500);
  auto* canvas = window_.view().findChild<QWidget*>();
  const QPoint middle = canvas->rect().center();
  QSignalSpy drawn(&window_.view(), &viewport::SceneView::drawn);
  QTest::mousePress(canvas, Qt::LeftButton, {}, middle);
  const QImage before = picture();
  for (int i = 1; i <= 50; ++i) {
    const QPoint place = middle + QPoint(i, 0);
    QCoreApplication::postEvent(canvas, new QMouseEvent(QEvent::MouseMove, place, canvas->mapToGlobal(place),
                                                        Qt::NoButton, Qt::LeftButton, Qt::NoModifier));
  }
  drawn.clear();
  QTest::qWait(500);
  EXPECT_GE(drawn.size(), 1);
  EXPECT_LE(drawn.size(), 3);
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, middle + QPoint(50, 0));
  EXPECT_GT(differing(before, picture()), 1000) << "the camera has turned";
}

TEST_F(Window, AClickThatMovesNothingIsNoMotion) {
  open();
  window_.view().setPatience(0.0);
  QTest::qWait(500);
  auto* canvas = window_.view().findChild<QWidget*>();
  QSignalSpy drawn(&window_.view(), &viewport::SceneView::drawn);
  QTest::mouseClick(canvas, Qt::LeftButton, {}, canvas->rect().center());
  QTest::qWait(500);
  EXPECT_GE(drawn.size(), 1);
  EXPECT_EQ(coarseAndFull(drawn).first, 0);
}

TEST_F(Window, ManyMovesOfTheSliderGiveFewDrawingsAndTheNewestPose) {
  open();
  window_.document().showPose("toe_touch@0");
  waitForFrame("toe_touch@0");
  QTest::qWait(500);
  auto* slider = window_.findChild<QSlider*>("frame");
  ASSERT_NE(slider, nullptr);
  ASSERT_GE(slider->maximum(), 50);
  const auto milliseconds = [](const QElapsedTimer& clock) { return static_cast<double>(clock.nsecsElapsed()) / 1e6; };
  // What one drawing takes here and now, with all that shows it.
  double drawing = 0.0;
  for (int i = 0; i < 3; ++i) {
    QElapsedTimer clock;
    clock.start();
    picture();
    drawing = std::max(drawing, milliseconds(clock));
  }
  QSignalSpy drawn(&window_.view(), &viewport::SceneView::drawn);
  for (int i = 1; i <= 50; ++i) {
    QMetaObject::invokeMethod(
        slider, [slider, i] { slider->setValue(i); }, Qt::QueuedConnection);
  }
  double longest = 0.0;
  const auto isShown = [&] {
    const auto& frame = window_.view().frame();
    return slider->value() == 50 && frame->pose == window_.document().shownPose() && !window_.engine().isBusy();
  };
  QElapsedTimer total;
  total.start();
  while (total.elapsed() < patience && !isShown()) {
    QElapsedTimer turn;
    turn.start();
    QCoreApplication::processEvents();
    longest = std::max(longest, milliseconds(turn));
  }
  ASSERT_TRUE(isShown());
  EXPECT_LT(longest, 5.0 * drawing) << "the window takes input between drawings";
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return !drawn.empty() && window_.view().frame()->pose != "toe_touch@0"; }, patience));
  QTest::qWait(500);
  EXPECT_GE(drawn.size(), 1);
  EXPECT_LE(drawn.size(), 6) << "not one for every move";
}

TEST_F(Window, WhatIsShownIsThePoseThatARunWouldShoot) {
  open();
  window_.document().showPose("toe_touch@2");
  waitForFrame("toe_touch@2");
  const jobs::Frame& frame = *window_.view().frame();
  const analysis::LoadedStudy& study = *frame.study;
  const analysis::PosedScene scene(study, frame.scene->models(), analysis::resolvePose(study, "toe_touch@2").pose,
                                   raycast::SceneUse::manyRays, {});
  EXPECT_EQ(frame.scene->body().skin, scene.body().skin);
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    EXPECT_EQ(frame.scene->organ(o, 0), scene.organ(o, 0)) << study.organs[o]->name;
  }
}

TEST_F(Window, TwoModelsStandSideBySideFromTheSameSide) {
  open();
  window_.document().showModels({OrganModel::staticJoint, OrganModel::dynamic});
  window_.document().showPose("toe_touch@2");
  waitForFrame("toe_touch@2");
  const QImage both = picture();
  const QImage left = both.copy(0, 0, both.width() / 2, both.height());
  const QImage right = both.copy(both.width() / 2, 0, both.width() / 2, both.height());
  const int apart = differing(left, right);
  EXPECT_GT(apart, 50) << "static organs stay behind";
  EXPECT_LT(apart, left.width() * left.height() / 8) << "the bodies are the same";
}

TEST_F(Window, RecolouringAnOrganChangesItsPixelsAndUndoBringsThemBack) {
  open();
  for (const study::ArmorSystem& system : window_.document().study().systems) {
    for (const study::ArmorPiece& piece : system.pieces) {
      commands::setVisible(window_.document(), piece.name, false);
    }
  }
  const std::string before = bytes();
  const int blueBefore = ofColour(picture(), 2);
  commands::setColour(window_.document(), "liver", std::array<std::uint8_t, 3>{20, 20, 240});
  EXPECT_GT(ofColour(picture(), 2), blueBefore + 100);
  window_.document().undoStack().undo();
  EXPECT_EQ(bytes(), before);
  EXPECT_NEAR(ofColour(picture(), 2), blueBefore, 20);
  window_.document().undoStack().redo();
  EXPECT_GT(ofColour(picture(), 2), blueBefore + 100);
}

TEST_F(Window, ARunGivesTheTableOfTheCommandLineByteForByte) {
  open();
  ASSERT_EQ(window_.runs().start(), QString());
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.runs().job() == nullptr; }, patience));
  ASSERT_EQ(window_.document().runs().size(), 1U);
  const models::ResultsModel& model = window_.results().model();
  std::vector<int> rows(static_cast<std::size_t>(model.rowCount()));
  std::iota(rows.begin(), rows.end(), 0);
  ASSERT_FALSE(rows.empty());
  const QString out = folder_.filePath("out");
  ASSERT_EQ(QProcess::execute(LORICA_CLI, {"run", file_, "--out", out, "--quiet"}), 0);
  const auto bytesOf = [](const QString& name) {
    QFile file(name);
    EXPECT_TRUE(file.open(QFile::ReadOnly)) << name.toStdString();
    return file.readAll();
  };
  EXPECT_EQ(model.csv(rows), bytesOf(out + "/summary.csv"));
  const QString own = folder_.filePath("own");
  const document::RunRecord& run = *window_.document().runs().front();
  analysis::writeResults(*run.study, run.result, own.toStdString());
  for (const char* name :
       {"/summary.csv", "/trials.csv", "/deformation.csv", "/contacts.csv", "/room.csv", "/provenance.json"}) {
    EXPECT_EQ(bytesOf(own + name), bytesOf(out + name)) << name;
  }
}

TEST_F(Window, TheReportOfARunIsWrittenInTheBackgroundAndWithoutARunTheMenuSaysWhyNot) {
  open();
  auto* action = window_.findChild<QAction*>("export_report");
  ASSERT_NE(action, nullptr);
  auto* menu = qobject_cast<QMenu*>(action->associatedObjects().value(0));
  ASSERT_NE(menu, nullptr);
  Q_EMIT menu->aboutToShow();
  EXPECT_FALSE(action->isEnabled());
  EXPECT_TRUE(action->toolTip().contains("no run")) << action->toolTip().toStdString();
  ASSERT_EQ(window_.runs().start(), QString());
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.runs().job() == nullptr; }, patience));
  Q_EMIT menu->aboutToShow();
  EXPECT_TRUE(action->isEnabled());
  const QString file = folder_.filePath("report.pdf");
  window_.exportReport(window_.document().runs().front(), file);
  ASSERT_NE(window_.saving(), nullptr) << "in the background";
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.saving() == nullptr; }, patience));
  QFile pdf(file);
  ASSERT_TRUE(pdf.open(QFile::ReadOnly));
  EXPECT_TRUE(pdf.readAll().startsWith("%PDF-"));
}

TEST_F(Window, TheViewHasAllTheRoomUntilThereAreResults) {
  open();
  const auto dock = [this](const char* name) { return window_.findChild<QDockWidget*>(name); };
  EXPECT_FALSE(dock("results")->isVisible());
  EXPECT_FALSE(dock("chart")->isVisible());
  const int height = window_.view().height();
  ASSERT_EQ(window_.runs().start(), QString());
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.runs().job() == nullptr; }, patience));
  EXPECT_TRUE(dock("results")->isVisible());
  EXPECT_TRUE(dock("chart")->isVisible());
  QCoreApplication::processEvents();
  EXPECT_LT(window_.view().height(), height);
  EXPECT_GT(window_.view().height(), height / 3) << "the body is still seen";
}

TEST_F(Window, ResultsStandInFrontWhenARunFromTheDialogEnds) {
  open();
  window_.showShotLines();
  ASSERT_TRUE(window_.shotLines().isVisible());
  ASSERT_EQ(window_.runs().start(), "");
  EXPECT_TRUE(window_.shotLines().isVisible()) << "it shows the progress";
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.runs().job() == nullptr; }, patience));
  EXPECT_FALSE(window_.shotLines().isVisible());
  EXPECT_TRUE(window_.results().isVisible());
  EXPECT_TRUE(window_.chart().isVisible());
  EXPECT_FALSE(window_.survey().isVisible()) << "the study asks for none of it";
}

TEST_F(Window, WhatARunIsAskedForBesideIsOfferedBesideItsResults) {
  open();
  study::Analyses asked;
  asked.gaps = study::GapSettings{{"liver"}};
  commands::setAnalyses(window_.document(), asked);
  waitForFrame("rest");
  ASSERT_EQ(window_.runs().start(), "");
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.runs().job() == nullptr; }, patience));
  auto* dock = window_.findChild<QDockWidget*>("survey");
  EXPECT_FALSE(dock->isHidden());
  EXPECT_TRUE(window_.results().isVisible()) << "results are in front";
  window_.survey().compute();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window_.survey().isBusy(); }, patience));
  EXPECT_TRUE(window_.survey().survey()->gaps);
}

TEST_F(Window, TheStatusBarSaysPoseAndSelectionAndKeepsTimesToItsTooltip) {
  open();
  const auto text = [&](const char* name) { return window_.findChild<QLabel*>(QString::fromLatin1(name))->text(); };
  EXPECT_EQ(text("status_pose"), "Pose: rest");
  EXPECT_EQ(text("status_selection"), "");
  window_.document().showPose("toe_touch@2");
  window_.document().select(ItemRef{ItemKind::organ, "liver"});
  waitForFrame("toe_touch@2");
  EXPECT_EQ(text("status_pose"), "toe_touch at 2.00 of 4.00 s");
  EXPECT_EQ(text("status_selection"), "Selected: liver");
  picture();
  const auto* facts = window_.findChild<QLabel*>("status_pose")->parentWidget();
  EXPECT_TRUE(facts->toolTip().contains(" ms"));
  window_.document().close();
  EXPECT_EQ(text("status_pose"), "");
}

TEST_F(Window, ACancelledRunKeepsWhatWasFinishedAndTheWindowIsUsable) {
  open();
  commands::setSourceShots(window_.document(), "front", 50000000);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.runs().trouble().isEmpty(); }, patience));
  ASSERT_EQ(window_.runs().start(), QString());
  int turns = 0;
  ASSERT_TRUE(QTest::qWaitFor([&] { return ++turns > 5; }, patience)) << "the window goes on while it shoots";
  window_.runs().cancel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.runs().job() == nullptr; }, 5000));
  for (const auto& run : window_.document().runs()) {
    EXPECT_TRUE(run->result.partial);
  }
  window_.document().showPose("toe_touch@2");
  waitForFrame("toe_touch@2");
}

TEST_F(Window, ClosesCleanlyWhileARunGoesOn) {
  open();
  commands::setSourceShots(window_.document(), "front", 50000000);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.runs().trouble().isEmpty(); }, patience));
  ASSERT_EQ(window_.runs().start(), QString());
  QTest::qWait(100);
  answer(QMessageBox::Discard);
  EXPECT_TRUE(window_.close());
}

TEST_F(Window, SavesAndReopensTheStudyWithItsLook) {
  open();
  commands::setColour(window_.document(), "heart", std::array<std::uint8_t, 3>{1, 2, 3});
  commands::setOpacity(window_.document(), "body", 0.5);
  const std::string before = bytes();
  window_.document().save();
  EXPECT_FALSE(window_.document().isModified());
  ASSERT_TRUE(window_.openFile(file_));
  EXPECT_EQ(bytes(), before);
}

TEST_F(Window, AsksBeforeUnsavedEditsAreLost) {
  open();
  commands::setTrials(window_.document(), 9);
  EXPECT_TRUE(window_.isWindowModified());
  const std::string edited = bytes();
  answer(QMessageBox::Cancel);
  EXPECT_FALSE(window_.openFile(file_));
  EXPECT_EQ(bytes(), edited);
  EXPECT_TRUE(said_.contains("unsaved")) << said_.toStdString();
}

TEST_F(Window, AsksAboutAStudyThatWasNeverSaved) {
  study::Study imported = study::parseStudy(study::templateText("sample"), "sample");
  window_.document().setStudy(imported, folder_.filePath("imported.lorica.json").toStdString());
  answer(QMessageBox::Cancel);
  EXPECT_FALSE(window_.openFile(file_));
  EXPECT_EQ(window_.document().study(), imported);
}

TEST_F(Window, AsksWhenWhatWasSavedIsUndone) {
  open();
  commands::setTrials(window_.document(), 9);
  window_.document().save();
  window_.document().undoStack().undo();
  answer(QMessageBox::Cancel);
  EXPECT_FALSE(window_.openFile(file_));
  EXPECT_TRUE(said_.contains("unsaved")) << said_.toStdString();
}

TEST_F(Window, AnUntouchedSampleGoesWithoutAQuestion) {
  window_.openSample("sample");
  EXPECT_TRUE(window_.openFile(file_));
  window_.openSample("sample");
  commands::setTrials(window_.document(), 9);
  answer(QMessageBox::Cancel);
  EXPECT_FALSE(window_.openFile(file_));
}

TEST_F(Window, TellsWhereADamagedFileIsWrongAndKeepsTheOpenStudy) {
  open();
  const std::string before = bytes();
  const QString damaged = folder_.filePath("damaged.lorica.json");
  QFile file(damaged);
  ASSERT_TRUE(file.open(QFile::WriteOnly));
  file.write("{\n  \"lorica_study\": 1,\n  \"human\": {\"builtin\": \"plain\"},,\n}\n");
  file.close();
  answer(QMessageBox::Ok);
  EXPECT_FALSE(window_.openFile(damaged));
  EXPECT_TRUE(said_.contains("damaged.lorica.json")) << said_.toStdString();
  EXPECT_TRUE(said_.contains("3")) << "the line: " << said_.toStdString();
  EXPECT_EQ(bytes(), before);
}

TEST_F(Window, AStudyThatCannotBeReadShowsItsProblem) {
  study::Study study = study::parseStudy(study::templateText("sample"), "sample");
  study.organs.front().joint = "no_such_joint";
  study::saveStudy(study, file_.toStdString());
  ASSERT_TRUE(window_.openFile(file_));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window_.document().problems().empty(); }, patience));
  EXPECT_EQ(window_.document().problems().front().severity, base::Severity::error);
  EXPECT_NE(window_.document().problems().front().text.find("no_such_joint"), std::string::npos);
}

TEST_F(Window, ADroppedOrganIsImportedIntoTheOpenStudy) {
  open();
  const geometry::TriangleMesh ball =
      geometry::ellipsoid(geometry::Vec3d(0.0, 1.25, 0.0), geometry::Vec3d::Constant(0.03), 2);
  const QString organ = folder_.filePath("thymus.ply");
  const io::SceneMesh mesh{"thymus", "organ", ball.positions, ball.triangles};
  io::writeScene(std::span(&mesh, 1), io::SceneFormat::ply, organ.toStdString());

  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(organ)});
  QDragEnterEvent enter({600, 400}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window_, &enter);
  ASSERT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(600, 400), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window_, &drop);
  // Accepts as soon as the files were read.
  bool seen = false;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, [&] {
    if (auto* dialog = qobject_cast<dialogs::ImportDialog*>(QApplication::activeModalWidget())) {
      dialog->accept();
      seen = true;
    }
  });
  timer.start(100);
  const auto hasIt = [&] {
    const auto& organs = window_.document().study().organs;
    return !organs.empty() && organs.back().name == "thymus";
  };
  ASSERT_TRUE(QTest::qWaitFor(hasIt, patience)) << (seen ? "the dialog was there" : "no dialog came");
  timer.stop();
  waitForFrame("rest");
  EXPECT_EQ(window_.view().frame()->study->organs.back()->name, "thymus");
  window_.document().undoStack().undo();
  EXPECT_FALSE(hasIt());
}

/// Chooses in the dialog for persons when it comes, then accepts it.
void chooseHuman(QObject* context, const std::function<void(dialogs::HumanDialog&)>& choose) {
  auto* timer = new QTimer(context);
  QObject::connect(timer, &QTimer::timeout, context, [timer, choose] {
    if (auto* dialog = qobject_cast<dialogs::HumanDialog*>(QApplication::activeModalWidget())) {
      timer->deleteLater();
      choose(*dialog);
      dialog->accept();
    }
  });
  timer->start(20);
}

TEST_F(Window, ANewStudyIsWhatTheDialogForPersonsChose) {
  study::Study chosen;
  chooseHuman(&window_, [&](dialogs::HumanDialog& dialog) { chosen = dialog.study(); });
  window_.newHumanStudy();
  EXPECT_EQ(window_.document().study(), chosen);
  EXPECT_EQ(chosen.systems.size(), 2U);
  EXPECT_FALSE(window_.document().hasFile());
  EXPECT_TRUE(window_.document().isModified());
  waitForFrame("rest");
  EXPECT_EQ(window_.view().frame()->study->organs.size(), chosen.organs.size());
  EXPECT_TRUE(window_.runs().trouble().isEmpty()) << window_.runs().trouble().toStdString();
}

TEST_F(Window, ANewStudyAsksBeforeUnsavedEditsAreLost) {
  open();
  commands::setTrials(window_.document(), 9);
  const std::string edited = bytes();
  chooseHuman(&window_, [&](dialogs::HumanDialog&) { answer(QMessageBox::Cancel); });
  window_.newHumanStudy();
  EXPECT_TRUE(said_.contains("unsaved")) << said_.toStdString();
  EXPECT_EQ(bytes(), edited);
}

TEST_F(Window, AnotherPersonIsOneStepAndUndoGivesTheStudyBackToTheByte) {
  open();
  const std::string before = bytes();
  const human::Person woman{human::Sex::female, 1.60, 60.0};
  chooseHuman(&window_, [&](dialogs::HumanDialog& dialog) {
    dialog.setSex(woman.sex);
    dialog.setSizes(woman.stature, woman.mass);
  });
  window_.changePerson();
  EXPECT_EQ(window_.document().undoStack().count(), 1);
  EXPECT_EQ(window_.document().study().person, woman);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.document().loaded()->study.person == woman; }, 240000));
  waitForFrame("rest");
  EXPECT_NEAR(geometry::bounds(window_.view().frame()->scene->body().skin).sizes().y(), woman.stature, 0.002);
  window_.document().undoStack().undo();
  EXPECT_EQ(bytes(), before);
  waitForFrame("rest");
  EXPECT_NEAR(geometry::bounds(window_.view().frame()->scene->body().skin).sizes().y(), 1.755, 0.002);
}

TEST_F(Window, OnlyTheBuiltInHumanCanBeAnotherPerson) {
  open();
  auto* action = window_.findChild<QAction*>("change_person");
  ASSERT_NE(action, nullptr);
  auto* menu = qobject_cast<QMenu*>(action->associatedObjects().front());
  ASSERT_NE(menu, nullptr);
  Q_EMIT menu->aboutToShow();
  EXPECT_TRUE(action->isEnabled());
  study::Study study = window_.document().study();
  study.human.from = study::InputFile{"body.glb", "", std::nullopt, std::nullopt};
  window_.document().setStudy(study, file_.toStdString());
  Q_EMIT menu->aboutToShow();
  EXPECT_FALSE(action->isEnabled());
}

TEST_F(Window, AClickSelectsWhatIsSeenThere) {
  open();
  const QWidget* canvas = window_.view().findChild<QWidget*>();
  ASSERT_NE(canvas, nullptr);
  window_.view().lookFrom(viewport::StandardView::front);
  // The front plate covers the chest, somewhat above the middle of the picture.
  bool found = false;
  for (int y = canvas->height() / 6; y < canvas->height() / 2 && !found; y += 10) {
    QTest::mouseClick(const_cast<QWidget*>(canvas), Qt::LeftButton, {}, {canvas->width() / 2, y});
    found = window_.document().selection() == ItemRef{ItemKind::piece, "plate_front"};
  }
  EXPECT_TRUE(found);
}

TEST_F(Window, ASourceIsPlacedByAClickAsFarFromTheBodyAsItWas) {
  open();
  window_.showShotLines();
  auto* pick = window_.shotLines().findChild<QAbstractButton*>("pick");
  ASSERT_NE(pick, nullptr);
  window_.view().lookFrom(viewport::StandardView::left);
  auto* canvas = window_.view().findChild<QWidget*>();
  const auto& skin = window_.view().frame()->scene->body().skin;
  const geometry::Vec3d middle = geometry::bounds(skin).center();
  const double reach = (window_.document().study().sources.front().position - middle).norm();

  pick->setChecked(true);
  ASSERT_TRUE(window_.view().isPicking());
  QTest::mouseClick(canvas, Qt::LeftButton, {}, canvas->rect().center());
  EXPECT_FALSE(window_.view().isPicking());
  EXPECT_FALSE(pick->isChecked());
  const geometry::Vec3d placed = window_.document().study().sources.front().position;
  EXPECT_NEAR((placed - middle).norm(), reach, 0.002) << "in whole millimetres";
  EXPECT_GT(placed.x(), 0.95 * reach) << "seen from the person's left, +x";
  EXPECT_EQ(window_.document().undoStack().count(), 1);

  pick->setChecked(true);
  QTest::keyClick(canvas, Qt::Key_Escape);
  EXPECT_FALSE(window_.view().isPicking());
  EXPECT_FALSE(pick->isChecked());
  EXPECT_EQ(window_.document().study().sources.front().position, placed);
}

TEST_F(Window, StandardViewsAreOnKeysAndAreDifferent) {
  open();
  auto* canvas = window_.view().findChild<QWidget*>();
  window_.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window_));
  canvas->setFocus();
  QImage last = picture();
  for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_3, Qt::Key_5, Qt::Key_6, Qt::Key_4}) {
    QTest::keyClick(canvas, key);
    const QImage now = picture();
    EXPECT_GT(differing(last, now), 3000) << static_cast<int>(key);
    last = now;
  }
}

TEST_F(Window, WhatDrivesAnOrganIsDrawnWhereItIsAskedForAndMovesWithThePose) {
  using document::Driver;
  open();
  const QImage plain = picture();
  window_.document().inspect({"liver", Driver::lattice | Driver::controlPoints, document::Colouring::own});
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.view().frame()->driversOf == "liver"; }, patience));
  const QImage lattice = picture();
  EXPECT_GT(differing(plain, lattice), 1000);
  const auto atRest = window_.view().frame()->drivers.front().controlPoints;
  window_.document().inspect({"liver", Driver::sites | Driver::rays | Driver::frames, document::Colouring::own});
  EXPECT_GT(differing(lattice, picture()), 1000);
  window_.document().showPose("toe_touch@2");
  waitForFrame("toe_touch@2");
  EXPECT_EQ(window_.view().frame()->driversOf, "liver");
  const auto posed = window_.view().frame()->drivers.front().controlPoints;
  ASSERT_EQ(posed.size(), atRest.size());
  EXPECT_GT((posed.front() - atRest.front()).norm(), 0.1F);
  window_.document().showPose("rest");
  window_.document().inspect({});
  window_.document().showPose("toe_touch@1");
  waitForFrame("toe_touch@1");
  EXPECT_TRUE(window_.view().frame()->drivers.empty()) << "nothing is computed of what is not shown";
  window_.document().showPose("rest");
  waitForFrame("rest");
  EXPECT_LT(differing(plain, picture()), 100) << "as before";
}

TEST_F(Window, OrgansAreColouredByTheirStrainOnceThePoseRests) {
  open();
  window_.document().showPose("belly_twist@1");
  waitForFrame("belly_twist@1");
  window_.document().inspect({"", {}, document::Colouring::strain});
  const QImage waiting = picture();
  QWidget* legend = window_.view().findChild<QWidget*>("legend");
  ASSERT_NE(legend, nullptr);
  EXPECT_TRUE(legend->isVisible());
  const int before = legend->height();
  ASSERT_TRUE(QTest::qWaitFor([&] { return legend->height() != before; }, patience)) << "the bar came";
  EXPECT_GT(differing(waiting, picture()), 1000);
  window_.document().showModels({OrganModel::staticJoint, OrganModel::dynamic});
  waitForFrame("belly_twist@1");
  window_.document().inspect({});
  EXPECT_FALSE(legend->isVisible());
}

TEST_F(Window, TheDeformationPanelMeasuresWhatTheViewShows) {
  open();
  window_.document().showPose("toe_touch@2");
  window_.showDeformation();
  const auto& panel = window_.deformation();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return panel.report() != nullptr && panel.report()->tables.poses == std::vector<std::string>{"toe_touch@2"};
      },
      patience));
  EXPECT_TRUE(panel.isVisible());
  panel.organView().selectRow(0);
  EXPECT_EQ(window_.document().selection()->kind, ItemKind::organ);
}

TEST_F(Window, TwoRecentStudiesOfOneNameAreToldApartByTheirFolders) {
  const QFontMetrics metrics(QApplication::font());
  const QString one = recentText("/data/vests/2026/spring/sample.lorica.json", metrics, 400);
  const QString other = recentText("/data/vests/2026/autumn/sample.lorica.json", metrics, 400);
  EXPECT_TRUE(one.startsWith("sample.lorica.json"));
  EXPECT_NE(one, other);
  const QString deep = recentText("/data/" + QString(400, 'x') + "/last/sample.lorica.json", metrics, 400);
  EXPECT_LE(metrics.horizontalAdvance(deep), 400);
  EXPECT_TRUE(deep.endsWith("/last")) << deep.toStdString();
  EXPECT_TRUE(recentText(QDir::homePath() + "/s/sample.lorica.json", metrics, 400).contains("~/s"));
}

TEST_F(Window, TheSelectedOrganFillsTheView) {
  open();
  window_.document().select(ItemRef{ItemKind::organ, "bladder"});
  const QImage whole = picture();
  window_.view().fitSelection();
  const QImage near = picture();
  EXPECT_GT(differing(whole, near), 20000);
  std::vector<std::string> others = document::drawnStructures(window_.document().study());
  std::erase(others, "bladder");
  commands::setAllVisible(window_.document(), others, false, "Hide the others");
  window_.document().select(std::nullopt);
  auto* canvas = window_.view().findChild<QWidget*>();
  QTest::mouseClick(canvas, Qt::LeftButton, {}, canvas->rect().center());
  EXPECT_EQ(window_.document().selection(), (ItemRef{ItemKind::organ, "bladder"})) << "in the middle of the picture";
}

/// Pixels from a place to a line.
double pixelsTo(const QPointF& place, const QPointF& from, const QPointF& to) {
  const QPointF along = to - from;
  const double length = QPointF::dotProduct(along, along);
  const double share = length > 0.0 ? std::clamp(QPointF::dotProduct(place - from, along) / length, 0.0, 1.0) : 0.0;
  const QPointF off = from + share * along - place;
  return std::hypot(off.x(), off.y());
}

TEST_F(Window, AClickOnADrawnShotLooksIntoThatShotAsTheCommandLineDoes) {
  open();
  window_.showShot();  // a click would open it and make the view smaller
  QTest::qWait(300);
  window_.view().lookFrom(viewport::StandardView::left);
  window_.view().fit();
  dialogs::ShotDisplay display;
  display.on = true;
  display.limit = 60;
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.document().plan() != nullptr; }, patience));
  Q_EMIT window_.shotLines().shotDisplayChanged(display);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto& frame = window_.view().frame();
        return frame->shotsOfRun && !frame->shots.empty() && !window_.engine().isBusy();
      },
      patience));
  picture();
  struct Line {
    const analysis::ShotPath* shot;
    QPointF from;
    QPointF to;
    QPointF middle;
  };
  std::vector<Line> lines;
  for (const analysis::ShotPath& shot : window_.view().frame()->shots) {
    if (!shot.crossings.empty()) {
      const auto at = [&](double distance) {
        return window_.view().placeOf(shot.origin.cast<double>() + distance * shot.direction.cast<double>());
      };
      const double last = shot.crossings.back().distance;
      lines.push_back({&shot, at(4.0), at(last + 0.15), at(0.5 * (shot.crossings.front().distance + last))});
    }
  }
  QSignalSpy clicked(&window_.view(), &viewport::SceneView::shotClicked);
  auto* canvas = window_.view().findChild<QWidget*>();
  int tried = 0;
  QString name;
  for (const Line& line : lines) {
    const bool alone = std::all_of(lines.begin(), lines.end(), [&](const Line& other) {
      return other.shot == line.shot || pixelsTo(line.middle, other.from, other.to) > 6.0;
    });
    if (alone && tried < 5) {
      ++tried;
      QTest::mouseClick(canvas, Qt::LeftButton, {}, line.middle.toPoint());
      ASSERT_EQ(clicked.count(), tried);
      EXPECT_EQ(clicked.last()[0].toString(), QString("front:1:%1").arg(line.shot->number));
      name = clicked.last()[0].toString();
    }
  }
  ASSERT_GE(tried, 3) << "of " << lines.size();

  ASSERT_TRUE(
      QTest::qWaitFor([&] { return window_.shot().inspection() != nullptr && !window_.shot().isBusy(); }, patience));
  EXPECT_GT(window_.shot().table().rowCount(), 0);
  // What the command line says of the same shot: every passage that the table lists stands in its report.
  QProcess cli;
  cli.start(LORICA_CLI, {"run", file_, "--out", folder_.filePath("shot"), "--quiet", "--shot-report", name});
  ASSERT_TRUE(cli.waitForFinished(60000));
  const QString report = QString::fromUtf8(cli.readAllStandardOutput()).section("pose toe_touch", 0, 0).simplified();
  ASSERT_TRUE(report.contains(name)) << report.toStdString();
  for (int row = 0; row < window_.shot().table().rowCount(); ++row) {
    QStringList cells;
    for (int column = 0; column < 10; ++column) {
      cells.append(window_.shot().table().index(row, column).data().toString());
    }
    for (const models::ModelText& model : models::modelTexts()) {
      if (cells[2] == model.label) {
        cells[2] = QString::fromStdString(viscera::name(model.model));
      }
    }
    const QString passage = cells.join(u' ').simplified();
    const QString gap = QString("%1 to %2 %3 mm gap").arg(cells[3], cells[4], cells[5]);
    EXPECT_TRUE(report.contains(cells[0] == "gap" ? gap : passage)) << passage.toStdString();
  }

  const QImage marked = picture();
  window_.shot().inspect({});
  EXPECT_GT(differing(marked, picture()), 30) << "the shot was marked";
  // Behind the shots there is still the body.
  window_.document().select(std::nullopt);
  QTest::mouseClick(canvas, Qt::LeftButton, Qt::ShiftModifier, lines.front().middle.toPoint());
  EXPECT_TRUE(window_.document().selection());
}

TEST_F(Window, AShotThatIsNotThereIsToldInASentence) {
  open();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.document().plan() != nullptr; }, patience));
  const auto* said = window_.shot().findChild<QLabel*>("shot_summary");
  for (const char* bad : {"front", "front:1", "front:0:3", "front:1:x", "nowhere:1:3", "front:1:2000", "front:9:3"}) {
    window_.shot().inspect(bad);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window_.shot().isBusy(); }, patience));
    EXPECT_EQ(window_.shot().inspection(), nullptr) << bad;
    EXPECT_TRUE(said->text().endsWith(u'.') && said->text().size() > 20) << bad << ": " << said->text().toStdString();
    EXPECT_FALSE(said->text().startsWith("Click a shot")) << bad;
  }
  window_.shot().inspect("front:2:1999");
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.shot().inspection() != nullptr; }, patience));
}

TEST_F(Window, AzimuthAndElevationAreDrawnAroundTheBodyOfASelectedSource) {
  open();
  const QImage plain = picture();
  window_.document().select(ItemRef{ItemKind::source, "front"});
  picture();  // texts are laid out by the first drawing
  const QImage drawn = picture();
  EXPECT_GT(differing(plain, drawn), 500);
  auto* toggle = window_.findChild<QAction*>("compass");
  ASSERT_NE(toggle, nullptr);
  toggle->setChecked(false);
  EXPECT_GT(differing(drawn, picture()), 500) << "the view menu hides it";
  toggle->setChecked(true);
  picture();
  EXPECT_LT(differing(drawn, picture()), 50);
}

TEST_F(Window, ShotsAreDrawnUpToTheLimitAndFilteredByWhatTheyMeet) {
  open();
  const QImage without = picture();
  dialogs::ShotDisplay display;
  display.on = true;
  display.limit = 200;
  display.onlyFirstHit.clear();
  Q_EMIT window_.shotLines().shotDisplayChanged(display);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.view().frame()->shots.size() == 200; }, patience));
  const int all = differing(without, picture());
  EXPECT_GT(all, 200);
  display.onlyFirstHit = "armor";
  Q_EMIT window_.shotLines().shotDisplayChanged(display);
  QTest::qWait(500);
  const int armor = differing(without, picture());
  EXPECT_LT(armor, all);
  EXPECT_GT(armor, 0);
}

}  // namespace
}  // namespace lorica::gui
