#include "report_command.h"

#include <fmt/format.h>

#include <QGuiApplication>
#include <QHashSeed>
#include <array>
#include <memory>
#include <string>

#include "commands.h"
#include "console.h"
#include "lorica/report/report.h"

namespace lorica::cli {

namespace {

/// What fonts and pictures need of Qt, without a display.
class Drawing {
 public:
  Drawing() {
    // Qt writes fonts into a PDF in the order of a hash.
    QHashSeed::setDeterministicGlobalSeed();
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) {
      qputenv("QT_QPA_PLATFORM", "offscreen");
    }
    // Its remarks about the machine are no findings of ours.
    qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
    application_ = std::make_unique<QGuiApplication>(count_, arguments_.data());
  }

 private:
  int count_ = 1;
  std::string name_ = "lorica-cli";
  std::array<char*, 2> arguments_{name_.data(), nullptr};
  std::unique_ptr<QGuiApplication> application_;
};

}  // namespace

void requireReports() {}

void writeRunReport(const analysis::LoadedStudy& study, const analysis::RunResult& result,
                    const std::filesystem::path& folder, base::Threads threads, bool quiet) {
  const Drawing drawing;
  Stage stage("drawing the report", quiet);
  report::writeRunReport(study, result, folder, folder / "report.pdf", threads, stage.progress());
}

int reportFolder(const std::filesystem::path& folder, const std::filesystem::path& out) {
  const Drawing drawing;
  Stage stage("drawing the report", false);
  report::writeReport(folder, out, stage.progress());
  return done;
}

}  // namespace lorica::cli
