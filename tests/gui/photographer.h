#pragma once

/// \file
/// Takes pictures of the window for people to look at.

#include <QTest>
#include <cstdio>

#include "main_window.h"

namespace lorica::gui {

inline constexpr int patience = 120000;

class Photographer {
 public:
  Photographer(MainWindow& window, QString folder, QString prefix)
      : window_(window), folder_(std::move(folder)), prefix_(std::move(prefix)) {}

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
