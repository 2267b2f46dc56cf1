/// \file
/// main() of the window tests: a QApplication around GoogleTest, on a display of its own where there is none.

#include <gtest/gtest.h>

#include <QApplication>
#include <QByteArray>
#include <QDir>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>

namespace {

/// Starts an X server on a free display; it ends with this program.
bool startDisplay(QProcess& server) {
  server.setStandardErrorFile(QProcess::nullDevice());
  server.start("Xvfb", {"-displayfd", "1", "-screen", "0", "1920x1200x24", "-nolisten", "tcp"});
  if (!server.waitForStarted(10000) || !server.waitForReadyRead(20000)) {
    return false;
  }
  const QByteArray number = server.readLine().trimmed();
  return !number.isEmpty() && qputenv("DISPLAY", ":" + number);
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) {
    return RUN_ALL_TESTS();
  }
  // Settings and recovery files of the tests are not those of the user.
  const QTemporaryDir home;
  for (const char* place : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"}) {
    qputenv(place, home.path().toUtf8());
  }
  QProcess server;
  if (qEnvironmentVariableIsEmpty("DISPLAY") && qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM") &&
      !startDisplay(server)) {
    qWarning("There is no display and Xvfb could not be started; packaging/setup.sh installs it");
    return 1;
  }
  int code = 0;
  {
    QApplication application(argc, argv);
    QApplication::setOrganizationName("lorica-test");
    QApplication::setApplicationName("lorica-test");
    code = RUN_ALL_TESTS();
  }
  if (server.state() != QProcess::NotRunning) {
    server.terminate();
    server.waitForFinished(5000);
  }
  return code;
}
