/// \file
/// lorica: the workbench.

#include <QApplication>
#include <QCommandLineParser>
#include <QTimer>
#include <algorithm>
#include <cstdio>

#include "look.h"
#include "lorica/study/provenance.h"
#include "lorica/study/study_file.h"
#include "main_window.h"

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  lorica::gui::useOwnLook();
  QApplication::setOrganizationName(QStringLiteral("lorica"));
  QApplication::setApplicationName(QStringLiteral("lorica"));
  QApplication::setApplicationVersion(QString::fromStdString(lorica::study::version()));
  QApplication::setDesktopFileName(QStringLiteral("lorica"));

  QCommandLineParser parser;
  parser.setApplicationDescription(QApplication::translate("main", "Compares body armor on a posable digital human."));
  parser.addHelpOption();
  parser.addVersionOption();
  const QCommandLineOption sample(QStringLiteral("sample"),
                                  QApplication::translate("main", "open a sample study that is built in"),
                                  QStringLiteral("name"));
  parser.addOption(sample);
  parser.addPositionalArgument(QStringLiteral("files"),
                               QApplication::translate("main", "a study, or the files of a body, organs and armor"),
                               QStringLiteral("[files...]"));
  parser.process(application);
  const std::vector<std::string> samples = lorica::study::templateNames();
  if (parser.isSet(sample) &&
      std::find(samples.begin(), samples.end(), parser.value(sample).toStdString()) == samples.end()) {
    std::fprintf(stderr, "lorica: there is no sample named \"%s\"; lorica-cli template --list names them\n",
                 qPrintable(parser.value(sample)));
    return 2;
  }

  lorica::gui::MainWindow window;
  window.show();
  // After the window is there: what follows may ask questions.
  QTimer::singleShot(0, &window, [&] {
    window.offerRecovery();
    if (window.document().hasStudy()) {
      return;
    }
    if (parser.isSet(sample)) {
      window.openSample(parser.value(sample).toStdString());
    } else {
      window.takeFiles(parser.positionalArguments());
    }
  });
  return QApplication::exec();
}
