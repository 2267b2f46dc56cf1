/// \file
/// Takes pictures of the window with a study, in the states a person meets: usage lorica_pictures OUT_FOLDER PREFIX
/// STUDY CLIP@SECONDS...

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QDir>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QTest>
#include <QTimer>
#include <cstdio>

#include "look.h"
#include "lorica/dialogs/human_dialog.h"
#include "main_window.h"
#include "photographer.h"

namespace {

using lorica::gui::MainWindow;
using lorica::gui::patience;
using lorica::gui::Photographer;
using lorica::viscera::OrganModel;

/// Takes a picture of the dialog that `open` shows, then dismisses it.
template <class Open>
void takeModal(Photographer& photographer, const char* name, const Open& open) {
  QTimer::singleShot(4000, [&] {
    if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget())) {
      photographer.take(name, dialog);
      dialog->reject();
    }
  });
  open();
}

/// Pictures of the dialog for a new study: with the first person, while another is made, with that one.
void takePerson(Photographer& photographer, MainWindow& window) {
  QTimer::singleShot(1000, [&] {
    auto* dialog = qobject_cast<lorica::dialogs::HumanDialog*>(QApplication::activeModalWidget());
    if (dialog == nullptr) {
      return;
    }
    const auto settle = [&] {
      return QTest::qWaitFor([&] { return dialog->shownPerson() == dialog->person(); }, patience);
    };
    settle();
    photographer.take("new_human", dialog);
    dialog->setSex(lorica::human::Sex::female);
    dialog->setPercentile(5);
    QTest::qWait(800);
    photographer.take("new_human_making", dialog);
    settle();
    photographer.take("new_human_small", dialog);
    dialog->setSex(lorica::human::Sex::male);
    dialog->setSizes(1.98, 140.0);
    settle();
    photographer.take("new_human_large", dialog);
    dialog->reject();
  });
  window.newHumanStudy();
}

}  // namespace

int main(int argc, char** argv) {
  QElapsedTimer sinceStart;
  sinceStart.start();
  QApplication application(argc, argv);
  lorica::gui::useOwnLook();
  if (argc < 4) {
    std::fprintf(stderr, "usage: lorica_pictures OUT_FOLDER PREFIX STUDY CLIP@SECONDS...\n");
    return 2;
  }
  QDir().mkpath(argv[1]);
  MainWindow window;
  window.show();
  Photographer photographer(window, argv[1], argv[2]);
  if (!window.openFile(argv[3])) {
    return 3;
  }
  if (QTest::qWaitFor([&] { return window.view().frame() != nullptr; }, patience)) {
    std::printf("the body is there after %.2f s\n", static_cast<double>(sinceStart.elapsed()) / 1000.0);
  }
  photographer.settle("rest");
  photographer.take("rest");
  for (int i = 4; i < argc; ++i) {
    window.document().showPose(argv[i]);
    photographer.settle(argv[i]);
    photographer.take(QByteArray(argv[i]).replace('@', '_').constData());
  }
  window.document().showModels({OrganModel::staticJoint, OrganModel::dynamic});
  photographer.settle(window.document().shownPose());
  photographer.take("side_by_side");
  // As it is while the camera turns where drawing is slow: coarse until the button is let go.
  window.view().setPatience(0.0);
  QTest::qWait(600);
  auto* canvas = window.view().findChild<QWidget*>();
  const QPoint middle = canvas->rect().center();
  QTest::mousePress(canvas, Qt::LeftButton, {}, middle);
  for (const int across : {5, 10}) {
    QMouseEvent move(QEvent::MouseMove, middle + QPoint(across, 0), canvas->mapToGlobal(middle + QPoint(across, 0)),
                     Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(canvas, &move);
  }
  photographer.take("turning");
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, middle + QPoint(10, 0));
  window.view().setPatience(50.0);
  window.showShotLines();
  QTest::qWait(3000);
  photographer.take("shot_lines", &window.shotLines());
  lorica::dialogs::ShotDisplay display;
  display.on = true;
  display.limit = 400;
  Q_EMIT window.shotLines().shotDisplayChanged(display);
  window.document().select(
      lorica::document::ItemRef{lorica::document::ItemKind::source, window.document().study().sources.front().name});
  QTest::qWait(1500);
  photographer.take("shots");
  const QString why = window.runs().start();
  if (!why.isEmpty()) {
    std::fprintf(stderr, "no run: %s\n", qPrintable(why));
  }
  QTest::qWait(700);
  photographer.take("running");
  if (!QTest::qWaitFor([&] { return window.runs().job() == nullptr; }, patience)) {
    std::fprintf(stderr, "the run takes very long\n");
  }
  if (const auto& organs = window.document().study().organs; !organs.empty()) {
    window.document().select(lorica::document::ItemRef{lorica::document::ItemKind::organ, organs.front().name});
  }
  photographer.take("after_run");
  photographer.take("shot_lines_after", &window.shotLines());
  for (auto* dock : window.findChildren<QDockWidget*>()) {
    if (dock->objectName() == "problems") {
      dock->show();
      dock->raise();
    }
  }
  photographer.take("problems");
  window.shotLines().hide();
  takeModal(photographer, "import",
            [&] { window.takeFiles({"../shared/data/makehuman-male/armor/tactical_vest.glb"}); });
  takeModal(photographer, "error", [&] { window.openFile("no_such_study.lorica.json"); });
  takeModal(photographer, "about", [&] {
    for (QAction* action : window.findChildren<QAction*>()) {
      if (action->text() == "&About Lorica") {
        action->trigger();
      }
    }
  });
  takeModal(photographer, "change_person", [&] { window.changePerson(); });
  takePerson(photographer, window);
  window.document().close();
  photographer.take("empty");
  return 0;
}
