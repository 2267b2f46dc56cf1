#pragma once

/// \file
/// A PDF as poppler's programs see it.

#include <QFile>
#include <QProcess>
#include <QRegularExpression>
#include <QStringList>
#include <QTemporaryDir>
#include <vector>

namespace lorica::test {

struct Word {
  int page = 0;
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;  ///< pt, from the upper left corner
  QString text;
};

class PdfText {
 public:
  explicit PdfText(const QByteArray& pdf) {
    QFile file(path());
    file.open(QFile::WriteOnly);
    file.write(pdf);
  }

  /// Lines as they stand on the pages.
  QStringList lines() const { return output("pdftotext", {"-layout", path(), "-"}).split('\n'); }
  QString text() const { return output("pdftotext", {"-raw", path(), "-"}).simplified(); }
  QString info() const { return output("pdfinfo", {path()}); }
  QString fonts() const { return output("pdffonts", {path()}); }
  int pages() const { return QRegularExpression("Pages:\\s+(\\d+)").match(info()).captured(1).toInt(); }
  std::vector<Word> words() const {
    static const QRegularExpression word(
        "<word xMin=\"([-0-9.]+)\" yMin=\"([-0-9.]+)\" xMax=\"([-0-9.]+)\" yMax=\"([-0-9.]+)\">(.*)</word>");
    std::vector<Word> all;
    int page = 0;
    for (const QString& line : output("pdftotext", {"-bbox", path(), "-"}).split('\n')) {
      page += line.contains("<page ") ? 1 : 0;
      if (const auto match = word.match(line); match.hasMatch()) {
        all.push_back({page, match.captured(1).toDouble(), match.captured(2).toDouble(), match.captured(3).toDouble(),
                       match.captured(4).toDouble(), match.captured(5)});
      }
    }
    return all;
  }

 private:
  QString path() const { return folder_.filePath("report.pdf"); }
  static QString output(const QString& program, const QStringList& arguments) {
    QProcess process;
    process.start(program, arguments);
    process.waitForFinished(60000);
    return QString::fromUtf8(process.readAllStandardOutput());
  }

  QTemporaryDir folder_;
};

}  // namespace lorica::test
