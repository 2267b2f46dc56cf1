#include "lorica/report/report.h"

#include <QBuffer>
#include <QGuiApplication>

#include "chapters.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "picture_files.h"
#include "words.h"

namespace lorica::report {

namespace {

/// Blanks out the moments that Qt writes into the file's information, byte for byte: the report of a run is the same
/// whenever it is made.
void removeTimes(QByteArray& pdf) {
  for (const QByteArray& key : {QByteArrayLiteral("/CreationDate"), QByteArrayLiteral("/ModDate")}) {
    for (qsizetype at = pdf.indexOf(key); at >= 0; at = pdf.indexOf(key, at + 1)) {
      const qsizetype end = pdf.indexOf(')', at);
      if (end > at && end - at < 64) {
        std::fill(pdf.begin() + at, pdf.begin() + end + 1, ' ');
      }
    }
  }
}

struct Draft {
  QByteArray pdf;
  int pages = 0;
  std::vector<ContentsLine> contents;
};

Draft compose(const analysis::RunTables& run, const RunView& view, const PictureSet& pictures, const Draft& before,
              const base::Progress& progress) {
  Draft draft;
  QBuffer buffer(&draft.pdf);
  buffer.open(QIODevice::WriteOnly);
  const QString study = text(run.facts.study);
  {
    Sheet sheet(buffer, QGuiApplication::translate("lorica::report", "Coverage report: %1").arg(study), study,
                before.pages, progress);
    const Report report{sheet, run, view, pictures};
    writeTitle(report, before.contents);
    writeFindings(report);
    writePictureChapter(report);
    writeOrganCoverage(report);
    writeRegionCoverage(report);
    writeComparisons(report);
    writePieces(report);
    writeConvergence(report);
    writeMotion(report);
    writeDirections(report);
    writeGaps(report);
    writeAnatomy(report);
    writeDeformation(report);
    writeMethods(report);
    writeRecord(report);
    draft.pages = sheet.page();
    draft.contents = sheet.contents();
  }
  return draft;
}

}  // namespace

QByteArray reportPdf(const analysis::RunTables& run, const PictureSet& pictures, const base::Progress& progress) {
  LORICA_CHECK(qGuiApp != nullptr, "a QGuiApplication, which fonts need");
  const RunView view(run);
  // The first pass counts the pages, the second prints their number.
  const Draft first = compose(run, view, pictures, {}, progress.part(0.0, 0.5));
  Draft second = compose(run, view, pictures, first, progress.part(0.5, 1.0));
  removeTimes(second.pdf);
  return second.pdf;
}

void writeRunReport(const analysis::LoadedStudy& study, const analysis::RunResult& result,
                    const std::filesystem::path& folder, const std::filesystem::path& file, base::Threads threads,
                    const base::Progress& progress) {
  const analysis::RunTables run = analysis::readRunTables(folder);
  const PictureSet pictures = drawPictures(study, result, threads, progress.part(0.0, 0.7));
  const QByteArray pdf = reportPdf(run, pictures, progress.part(0.7, 1.0));
  std::vector<base::FileBytes> files = pictureFiles(pictures, run.facts.studyHash, folder);
  files.push_back({file, pdf.toStdString()});
  progress.check();
  base::writeFilesAtomically(files);
}

void writeReport(const std::filesystem::path& folder, const std::filesystem::path& file,
                 const base::Progress& progress) {
  const analysis::RunTables run = analysis::readRunTables(folder);
  const PictureSet pictures = readPictures(folder, run.facts);
  progress.report(0.1);
  const QByteArray pdf = reportPdf(run, pictures, progress.part(0.1, 1.0));
  base::writeFileAtomically(file, {pdf.constData(), static_cast<std::size_t>(pdf.size())});
}

}  // namespace lorica::report
