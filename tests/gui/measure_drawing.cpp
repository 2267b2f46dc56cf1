/// \file
/// Measures how long drawing keeps the window's thread from taking input: usage lorica_drawing STUDY CLIP. For one and
/// two organ models: at rest, while a clip is scrubbed and while the camera turns.

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <vector>

#include "look.h"
#include "main_window.h"

namespace {

using lorica::gui::MainWindow;
using lorica::viscera::OrganModel;

constexpr int patience = 120000;
constexpr int moves = 40;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

class Meter {
 public:
  explicit Meter(MainWindow& window) : window_(window) {}

  void settle() {
    const bool settled = QTest::qWaitFor(
        [&] {
          const auto& frame = window_.view().frame();
          return window_.loader().isInStep() && frame != nullptr && !window_.engine().isBusy() &&
                 frame->pose == window_.document().shownPose() &&
                 frame->scene->models() == window_.document().shownModels();
        },
        patience);
    if (!settled) {
      std::fprintf(stderr, "%s was not shown\n", window_.document().shownPose().c_str());
    }
    QTest::qWait(1500);
  }

  void atRest() {
    std::vector<double> times;
    for (int i = 0; i < 7; ++i) {
      QElapsedTimer clock;
      clock.start();
      window_.view().picture();
      times.push_back(static_cast<double>(clock.nsecsElapsed()) / 1e6);
    }
    std::printf("  picture in full      %6.0f ms\n", median(times));
  }

  /// Events come as fast as they are taken; what is told is how long single turns of the event loop took.
  template <class Step>
  void inMotion(const char* name, const Step& step) {
    std::vector<double> turns;
    QElapsedTimer total;
    total.start();
    for (int i = 0; i < moves; ++i) {
      step(i);
      // Input comes every 16 ms at the fastest.
      QElapsedTimer tick;
      tick.start();
      do {
        QElapsedTimer turn;
        turn.start();
        QCoreApplication::processEvents();
        turns.push_back(static_cast<double>(turn.nsecsElapsed()) / 1e6);
      } while (tick.elapsed() < 16);
    }
    const double seconds = static_cast<double>(total.elapsed()) / 1000.0;
    std::sort(turns.begin(), turns.end());
    std::vector<double> drawings;
    std::copy_if(turns.begin(), turns.end(), std::back_inserter(drawings), [](double ms) { return ms > 5.0; });
    std::printf("  %-20s %6.0f ms a drawing (median of %zu), longest block %.0f ms, %d moves in %.1f s\n", name,
                median(drawings), drawings.size(), turns.back(), moves, seconds);
    settle();
  }

 private:
  MainWindow& window_;
};

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  lorica::gui::useOwnLook();
  if (argc != 3) {
    std::fprintf(stderr, "usage: lorica_drawing STUDY CLIP\n");
    return 2;
  }
  MainWindow window;
  window.show();
  if (!window.openFile(argv[1])) {
    return 3;
  }
  Meter meter(window);
  meter.settle();
  auto* canvas = window.view().findChild<QWidget*>();
  std::printf("%s, view of %d x %d\n", argv[1], canvas->width(), canvas->height());
  const std::vector<std::vector<OrganModel>> choices{{OrganModel::dynamic},
                                                     {OrganModel::staticJoint, OrganModel::dynamic}};
  for (const auto& models : choices) {
    window.document().showModels(models);
    meter.settle();
    std::printf(" %zu model%s\n", models.size(), models.size() == 1 ? "" : "s");
    meter.atRest();
    meter.inMotion("scrubbing", [&](int i) {
      window.document().showPose(std::string(argv[2]) + "@" + std::to_string(0.05 * (i % 20)));
    });
    const QPointF middle = canvas->rect().center();
    const auto mouse = [&](QEvent::Type type, Qt::MouseButton button, Qt::MouseButtons buttons, int i) {
      const QPointF place = middle + QPointF(3.0 * i, i % 7);
      QCoreApplication::postEvent(
          canvas, new QMouseEvent(type, place, canvas->mapToGlobal(place), button, buttons, Qt::NoModifier));
    };
    mouse(QEvent::MouseButtonPress, Qt::LeftButton, Qt::LeftButton, 0);
    meter.inMotion("turning the camera", [&](int i) { mouse(QEvent::MouseMove, Qt::NoButton, Qt::LeftButton, i + 1); });
    mouse(QEvent::MouseButtonRelease, Qt::LeftButton, Qt::NoButton, moves);
    meter.settle();
  }
  return 0;
}
