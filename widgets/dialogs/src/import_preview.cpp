#include "import_preview.h"

#include <QHeaderView>
#include <QRegularExpression>
#include <QStyle>
#include <algorithm>

#include "import_parts.h"
#include "lorica/dialogs/import_dialog.h"

namespace lorica::dialogs {

namespace fs = std::filesystem;

namespace {

/// The same sentence without hints at options of the command line and at the study's text: here there are choices.
QString windowText(const std::string& issue) {
  QString text = QString::fromStdString(issue);
  static const QRegularExpression decides(
      QStringLiteral("; --(units|up) decides| \\(--(units|up) decides\\)|"
                     "; \"[a-z_]+\" in the study decides"));
  text.remove(decides);
  text.replace(QStringLiteral("give --units"), ImportDialog::tr("choose the unit of lengths"));
  return text;
}

}  // namespace

ImportPreview::ImportPreview(QWidget* parent) : QTableWidget(0, 3, parent) {
  setAccessibleName(ImportDialog::tr("What was understood"));
  setHorizontalHeaderLabels(
      {QString(), ImportDialog::tr("File or structure"), ImportDialog::tr("What was understood")});
  makeCalm(*this);
  setWordWrap(true);
  horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  horizontalHeader()->setSectionResizeMode(1, QHeaderView::Interactive);
  setColumnWidth(1, fontMetrics().averageCharWidth() * 26);
  horizontalHeader()->setSectionResizeMode(2, QHeaderView::Stretch);
  connect(horizontalHeader(), &QHeaderView::sectionResized, this, &QTableWidget::resizeRowsToContents,
          Qt::QueuedConnection);
  const int side = fontMetrics().height();
  setIconSize({side, side});
}

void ImportPreview::showIssues(const base::Issues& issues) {
  setRowCount(0);
  setRowCount(static_cast<int>(issues.size()));
  base::Issues sorted = issues;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const base::Issue& a, const base::Issue& b) { return a.severity > b.severity; });
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const base::Issue& issue = sorted[i];
    const int row = static_cast<int>(i);
    const QStyle::StandardPixmap icon = issue.severity == base::Severity::error     ? QStyle::SP_MessageBoxCritical
                                        : issue.severity == base::Severity::warning ? QStyle::SP_MessageBoxWarning
                                                                                    : QStyle::SP_MessageBoxInformation;
    const QString severity = issue.severity == base::Severity::error     ? ImportDialog::tr("Error")
                             : issue.severity == base::Severity::warning ? ImportDialog::tr("Warning")
                                                                         : ImportDialog::tr("Note");
    setItem(row, 0, new QTableWidgetItem(style()->standardIcon(icon), severity));
    const QString file = textOf(fs::path(issue.file).filename());
    const QString place = QString::fromStdString(issue.place);
    auto* where =
        new QTableWidgetItem(file.isEmpty() || place.isEmpty() ? file + place : file + QStringLiteral(": ") + place);
    where->setToolTip(QString::fromStdString(issue.file));
    setItem(row, 1, where);
    auto* what = new QTableWidgetItem(windowText(issue.text));
    what->setToolTip(what->text());
    setItem(row, 2, what);
    for (int section = 0; section < 3; ++section) {
      item(row, section)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    }
  }
  resizeRowsToContents();
}

}  // namespace lorica::dialogs
