#pragma once

/// \file
/// Takes pictures of the window for people to look at.

#include <QApplication>
#include <QTest>
#include <cstdio>

#include "main_window.h"

namespace lorica::gui {

inline constexpr int patience = 120000;

class Photographer {
 public:
  Photographer(MainWindow& window, QString folder, QString prefix)
      : window_(window), folder_(std::move(folder)), prefix_(std::move(prefix)) {
    // LORICA_PICTURE_SIZE=1920x1080: of the window, in place of its own.
    const QStringList size = qEnvironmentVariable("LORICA_PICTURE_SIZE").split(u'x');
    if (size.size() == 2) {
      window.resize(size[0].toInt(), size[1].toInt());
    }
    // LORICA_PICTURE_DARK=1: as on a dark desktop.
    if (qEnvironmentVariableIsSet("LORICA_PICTURE_DARK")) {
      QPalette dark(QColor(53, 53, 53), QColor(42, 42, 42));
      dark.setColor(QPalette::Base, QColor(30, 30, 30));
      dark.setColor(QPalette::Highlight, QColor(42, 110, 180));
      QApplication::setPalette(dark);
    }
  }

  void settle(const std::string& pose) {
    const bool there = QTest::qWaitFor(
        [&] {
          const auto& frame = window_.view().frame();
          return window_.loader().isInStep() && frame != nullptr && frame->pose == pose &&
                 frame->scene->models() == window_.document().shownModels() && !window_.engine().isBusy();
        },
        patience);
    if (!there) {
      std::fprintf(stderr, "%s was not shown\n", pose.c_str());
    }
    QTest::qWait(600);
  }
  void take(const char* name, QWidget* what = nullptr) {
    QTest::qWait(200);
    (what != nullptr ? what : &window_)->grab().save(folder_ + "/" + prefix_ + "_" + name + ".png");
  }

 private:
  MainWindow& window_;
  QString folder_;
  QString prefix_;
};

}  // namespace lorica::gui
