/// \file
/// Takes pictures of how organs deform: usage lorica_deformation_pictures OUT_FOLDER PREFIX STUDY ORGAN CLIP@SECONDS

#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QTest>
#include <cstdio>

#include "look.h"
#include "photographer.h"

namespace {

using lorica::document::Colouring;
using lorica::document::Driver;
using lorica::document::Drivers;
using lorica::gui::MainWindow;
using lorica::gui::patience;
using lorica::gui::Photographer;
using lorica::viscera::OrganModel;

void raise(MainWindow& window, const char* dock) {
  for (auto* one : window.findChildren<QDockWidget*>()) {
    if (one->objectName() == dock) {
      one->show();
      one->raise();
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  lorica::gui::useOwnLook();
  if (argc != 6) {
    std::fprintf(stderr, "usage: lorica_deformation_pictures OUT_FOLDER PREFIX STUDY ORGAN CLIP@SECONDS\n");
    return 2;
  }
  QDir().mkpath(argv[1]);
  MainWindow window;
  window.show();
  Photographer photographer(window, argv[1], argv[2]);
  if (!window.openFile(argv[3])) {
    return 3;
  }
  const std::string organ = argv[4];
  const std::string pose = argv[5];
  const auto inspect = [&](Drivers drivers, Colouring colouring) {
    window.document().inspect({organ, drivers, colouring});
    photographer.settle(window.document().shownPose());
    // Colours come when the pose has rested.
    QTest::qWait(colouring == Colouring::own ? 300 : 3000);
  };
  photographer.settle("rest");
  raise(window, "inspect");
  window.document().select(lorica::document::ItemRef{lorica::document::ItemKind::organ, organ});
  window.view().fitSelection();
  window.document().select(std::nullopt);
  inspect(Driver::lattice | Driver::controlPoints, Colouring::own);
  photographer.take("lattice_rest");
  inspect(Driver::sites | Driver::rays | Driver::frames, Colouring::own);
  photographer.take("sites_rest");
  window.document().showPose(pose);
  inspect(Driver::lattice | Driver::controlPoints, Colouring::own);
  photographer.take("lattice_posed");
  inspect(Driver::sites | Driver::rays | Driver::frames, Colouring::own);
  photographer.take("sites_posed");
  window.document().showModels({OrganModel::dynamicThesis, OrganModel::dynamic});
  inspect(Driver::lattice | Driver::controlPoints | Driver::sites | Driver::rays | Driver::frames, Colouring::own);
  photographer.take("drivers_side_by_side");
  window.document().showModels({OrganModel::staticJoint, OrganModel::dynamic});
  inspect(Driver::lattice | Driver::frames, Colouring::own);
  photographer.take("static_and_dynamic");
  inspect({}, Colouring::strain);
  photographer.take("strain");
  inspect({}, Colouring::protrusion);
  photographer.take("protrusion");
  window.showDeformation();
  if (!QTest::qWaitFor([&] { return window.deformation().report() != nullptr; }, patience)) {
    std::fprintf(stderr, "nothing was measured\n");
  }
  window.document().select(lorica::document::ItemRef{lorica::document::ItemKind::organ, organ});
  photographer.take("deformation");
  window.deformation().measureAllPoses();
  QTest::qWait(400);
  photographer.take("deformation_measuring");
  if (!QTest::qWaitFor([&] { return window.deformation().controller().job() == nullptr; }, patience)) {
    std::fprintf(stderr, "measuring all poses takes very long\n");
  }
  photographer.take("deformation_all");
  window.resize(1900, 1300);
  QTest::qWait(500);
  photographer.take("deformation_large");
  return 0;
}
