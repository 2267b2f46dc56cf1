/// \file
/// The report of a run, made in the background.

#include <QFileDialog>
#include <QTemporaryDir>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/report/report.h"
#include "main_window.h"

namespace lorica::gui {

namespace {

/// Tables as the command line leaves them, then the report that reads them.
void makeReport(const document::RunRecord& run, const std::filesystem::path& file, const base::Progress& progress) {
  const QTemporaryDir folder;
  if (!folder.isValid()) {
    throw base::InputError(folder.path().toStdString(), "",
                           "cannot be made to hold the tables of the report; free some room on the disk");
  }
  const std::filesystem::path tables = folder.path().toStdString();
  analysis::writeResults(*run.study, run.result, tables);
  if (!run.result.partial) {
    analysis::writeAnalyses(*run.study, run.result, {}, tables, progress.part(0.0, 0.5));
  }
  report::writeRunReport(*run.study, run.result, tables, file, {}, progress.part(0.5, 1.0));
}

}  // namespace

void MainWindow::chooseReport() {
  const auto run = results_->run();
  if (run == nullptr) {
    return;
  }
  const QString proposal = QStringLiteral("%1.pdf").arg(QString::fromStdString(run->study->study.name));
  QString file = QFileDialog::getSaveFileName(this, tr("Export the report as"), proposal, tr("PDF files (*.pdf)"));
  if (file.isEmpty()) {
    return;
  }
  if (!file.endsWith(QLatin1String(".pdf"), Qt::CaseInsensitive)) {
    file += QStringLiteral(".pdf");
  }
  exportReport(run, file);
}

void MainWindow::exportReport(const std::shared_ptr<const document::RunRecord>& run, const QString& file) {
  const std::filesystem::path path = file.toStdString();
  saveInBackground(
      tr("Making the report"), [run, path](const base::Progress& progress) { makeReport(*run, path, progress); },
      tr("The report is %1").arg(file), tr("The report cannot be written."));
}

}  // namespace lorica::gui
