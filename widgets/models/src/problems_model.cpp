#include "lorica/models/problems_model.h"

#include <QApplication>
#include <QIcon>
#include <QStyle>
#include <algorithm>

namespace lorica::models {

namespace {

QStyle::StandardPixmap iconOf(base::Severity severity) {
  switch (severity) {
    case base::Severity::error:
      return QStyle::SP_MessageBoxCritical;
    case base::Severity::warning:
      return QStyle::SP_MessageBoxWarning;
    case base::Severity::note:
      break;
  }
  return QStyle::SP_MessageBoxInformation;
}

QString whereOf(const base::Issue& issue) {
  const QString file = QString::fromStdString(issue.file);
  const QString place = QString::fromStdString(issue.place);
  return file.isEmpty() || place.isEmpty() ? file + place : file + ": " + place;
}

}  // namespace

ProblemsModel::ProblemsModel(QObject* parent) : QAbstractTableModel(parent) {}

void ProblemsModel::setIssues(base::Issues issues) {
  beginResetModel();
  issues_ = std::move(issues);
  std::stable_sort(issues_.begin(), issues_.end(),
                   [](const base::Issue& a, const base::Issue& b) { return a.severity > b.severity; });
  endResetModel();
}

int ProblemsModel::count(base::Severity severity) const {
  return static_cast<int>(std::count_if(issues_.begin(), issues_.end(),
                                        [severity](const base::Issue& issue) { return issue.severity == severity; }));
}

QString ProblemsModel::lines(const std::vector<int>& rows) const {
  QString text;
  for (const int row : rows) {
    text += QString::fromStdString(issues_.at(static_cast<std::size_t>(row)).line()) + '\n';
  }
  return text;
}

int ProblemsModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(issues_.size());
}

int ProblemsModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columnTotal;
}

QVariant ProblemsModel::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid | CheckIndexOption::ParentIsInvalid)) {
    return {};
  }
  const base::Issue& issue = issues_[static_cast<std::size_t>(index.row())];
  if (role == Qt::DecorationRole && index.column() == severityColumn) {
    return QApplication::style()->standardIcon(iconOf(issue.severity));
  }
  if (role == Qt::ToolTipRole) {
    return QString::fromStdString(issue.line());
  }
  if (role != Qt::DisplayRole) {
    return {};
  }
  switch (index.column()) {
    case severityColumn:
      return issue.severity == base::Severity::error     ? tr("Error")
             : issue.severity == base::Severity::warning ? tr("Warning")
                                                         : tr("Note");
    case whereColumn:
      return whereOf(issue);
    default:
      return QString::fromStdString(issue.text);
  }
}

QVariant ProblemsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) {
    return {};
  }
  switch (section) {
    case severityColumn:
      return tr("Severity");
    case whereColumn:
      return tr("Where");
    case textColumn:
      return tr("What");
    default:
      return {};
  }
}

}  // namespace lorica::models
