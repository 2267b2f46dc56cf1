/// \file
/// Takes pictures of where shots come from and of single shots: usage lorica_shot_pictures OUT_FOLDER PREFIX STUDY.
/// The study gets a source of every type.

#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QTabWidget>
#include <QTableView>
#include <cstdio>
#include <functional>

#include "look.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/study/study_file.h"
#include "main_window.h"
#include "photographer.h"
#include "shot_sources.h"

namespace {

using lorica::document::ItemKind;
using lorica::document::ItemRef;
using lorica::gui::MainWindow;
using lorica::gui::patience;
using lorica::gui::Photographer;

void waitFor(const std::function<bool()>& holds) {
  if (!QTest::qWaitFor(holds, patience)) {
    std::fprintf(stderr, "something takes very long\n");
  }
}

/// Adds the sources; the list gets a file of its own.
void addSources(MainWindow& window, const QString& folder) {
  QFile file(folder + "/shots.csv");
  if (file.open(QIODevice::WriteOnly)) {
    file.write("x,y,z,az,el\n");
    for (int i = 0; i < 200; ++i) {
      file.write(QString("%1,%2,2,0,0\n").arg(-0.4 + 0.05 * (i % 17)).arg(0.2 + 0.11 * (i / 17)).toLatin1());
    }
  }
  lorica::study::Study study = window.document().study();
  const lorica::study::Study every = lorica::testsupport::studyWithEverySource();
  study.sources = every.sources;
  study.sources.front().name = "a sniper's window on the third floor of the house across the square";
  for (lorica::study::Source& source : study.sources) {
    source.list.path = source.list.path.empty() ? "" : QDir(folder).absoluteFilePath("shots.csv").toStdString();
  }
  study.stop = every.stop;
  study.analyses = every.analyses;
  study.overlap = every.overlap;
  lorica::commands::replaceStudy(window.document(), study, "Add sources");
}

/// Pictures of coverage by direction and over a motion.
void takeSurvey(Photographer& photographer, MainWindow& window) {
  lorica::study::Study study = window.document().study();
  study.sources.resize(1);
  study.runPoses = {"rest"};
  study.stop.reset();
  study.analyses.directions = lorica::study::DirectionGrid{20.0, 2000};
  study.analyses.motion = lorica::study::MotionSettings{"toe_touch", 10, 30.0};
  lorica::commands::replaceStudy(window.document(), study, "One source");
  photographer.settle("rest");
  window.showSurvey();
  photographer.take("survey_empty");
  if (const QString why = window.runs().start(); !why.isEmpty()) {
    std::fprintf(stderr, "no run: %s\n", qPrintable(why));
    return;
  }
  waitFor([&] { return window.runs().job() == nullptr; });
  window.showSurvey();
  photographer.take("survey_asked");
  window.survey().compute();
  waitFor([&] { return !window.survey().isBusy(); });
  photographer.take("survey_map");
  auto* what = window.survey().findChild<QComboBox*>("survey_what");
  what->setCurrentIndex(1);
  photographer.take("survey_open");
  what->setCurrentIndex(2);
  photographer.take("survey_motion");
}

/// Pictures of the gaps in the armor, in the table and on the skin, and of coverage where organs may lie elsewhere.
void takeGaps(Photographer& photographer, MainWindow& window) {
  lorica::study::Study study = window.document().study();
  study.runPoses = {"rest", "toe_touch@2"};
  study.analyses = {};
  study.analyses.gaps = lorica::study::GapSettings{{"liver", "body"}};
  study.analyses.anatomy = lorica::study::AnatomySettings{5};
  lorica::commands::replaceStudy(window.document(), study, "Gaps");
  photographer.settle("rest");
  if (const QString why = window.runs().start(); !why.isEmpty()) {
    std::fprintf(stderr, "no run: %s\n", qPrintable(why));
    return;
  }
  waitFor([&] { return window.runs().job() == nullptr; });
  photographer.take("analyses_offered");
  window.showSurvey();
  window.survey().compute();
  waitFor([&] { return !window.survey().isBusy(); });
  window.survey().findChild<QComboBox*>("survey_system")->setCurrentIndex(2);
  photographer.take("survey_gaps");
  window.survey().table().selectRow(0);
  photographer.settle(window.document().shownPose());
  Q_EMIT window.survey().table().activated(window.survey().table().currentIndex());
  photographer.take("survey_gap_picked");
  window.survey().findChild<QComboBox*>("survey_what")->setCurrentIndex(1);
  photographer.take("survey_places");
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  lorica::gui::useOwnLook();
  if (argc < 4) {
    std::fprintf(stderr, "usage: lorica_shot_pictures OUT_FOLDER PREFIX STUDY\n");
    return 2;
  }
  QDir().mkpath(argv[1]);
  MainWindow window;
  window.show();
  Photographer photographer(window, argv[1], argv[2]);
  if (!window.openFile(argv[3])) {
    return 3;
  }
  photographer.settle("rest");
  window.showShot();
  photographer.take("shot_empty");
  addSources(window, argv[1]);
  photographer.settle("rest");
  waitFor([&] { return window.document().plan() != nullptr; });
  window.showShotLines();
  QTest::qWait(2500);
  lorica::dialogs::ShotLineDialog& dialog = window.shotLines();
  int number = 0;
  for (const auto& source : std::vector(window.document().study().sources)) {
    window.document().select(ItemRef{ItemKind::source, source.name});
    window.view().fitSelection();
    QTest::qWait(400);
    const QByteArray name = "source_" + QByteArray::number(number++);
    photographer.take((name + "_dialog").constData(), &dialog);
    photographer.take(name.constData());
  }
  window.document().select(ItemRef{ItemKind::source, "window"});
  dialog.findChild<QDoubleSpinBox*>("width")->setValue(0.0);
  photographer.take("source_trouble", &dialog);
  dialog.findChild<QDoubleSpinBox*>("width")->setValue(0.5);
  dialog.findChild<QTabWidget*>("run_tabs")->setCurrentIndex(1);
  photographer.take("analyses", &dialog);
  dialog.hide();
  lorica::dialogs::ShotDisplay display;
  display.on = true;
  display.limit = 100;
  Q_EMIT dialog.shotDisplayChanged(display);
  window.document().select(std::nullopt);
  window.view().lookFrom(lorica::viewport::StandardView::left);
  window.view().fit();
  waitFor([&] { return window.view().frame()->shotsOfRun; });
  window.shot().inspect("window:1:7");
  waitFor([&] { return window.shot().inspection() != nullptr; });
  photographer.take("shot");
  window.shot().inspect("nowhere:1:7");
  QTest::qWait(500);
  photographer.take("shot_trouble");
  window.document().select(ItemRef{ItemKind::study, ""});
  photographer.take("study_form");
  takeSurvey(photographer, window);
  takeGaps(photographer, window);
  return 0;
}
