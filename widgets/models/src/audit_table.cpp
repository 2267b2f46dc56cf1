#include "lorica/models/audit_table.h"

#include <cmath>
#include <limits>
#include <map>

#include "lorica/base/error.h"
#include "lorica/models/numbers.h"

namespace lorica::models {

namespace {

double badness(const AuditColumn& column, const std::optional<double>& value) {
  if (!value) {
    return -std::numeric_limits<double>::infinity();
  }
  switch (column.worse) {
    case AuditColumn::Worse::larger:
      return *value;
    case AuditColumn::Worse::smaller:
      return -*value;
    case AuditColumn::Worse::fartherFromZero:
      return std::abs(*value);
  }
  return 0.0;
}

/// That of one column, then, where that is the same, of all the others in their order.
std::vector<double> badness(const AuditTableData& table, const AuditRow& row, std::size_t first) {
  std::vector<double> all;
  const auto of = [&](std::size_t cell) {
    return badness(table.columns[static_cast<std::size_t>(table.textColumns) + cell], row.cells[cell].value);
  };
  all.push_back(of(first));
  for (std::size_t cell = 0; cell < row.cells.size(); ++cell) {
    all.push_back(of(cell));
  }
  return all;
}

/// No "-0.00".
QString written(double value, int decimals) {
  const QString text = fixed(value, decimals);
  return text.startsWith('-') && text.toDouble() == 0.0 ? text.mid(1) : text;
}

}  // namespace

AuditTable::AuditTable(QObject* parent) : QAbstractTableModel(parent) {}

void AuditTable::setTable(AuditTableData table) {
  beginResetModel();
  data_ = std::move(table);
  endResetModel();
}

std::vector<bool> AuditTable::worstRows(int column) const {
  LORICA_CHECK(column >= data_.textColumns && column < columnCount(), "a column of numbers is needed");
  const auto at = static_cast<std::size_t>(column - data_.textColumns);
  // By everything but the pose.
  std::map<QStringList, std::size_t> worst;
  for (std::size_t r = 0; r < data_.rows.size(); ++r) {
    const AuditRow& row = data_.rows[r];
    const auto [known, isNew] = worst.emplace(row.texts.mid(0, poseColumn()), r);
    const AuditRow& other = data_.rows[known->second];
    if (!isNew && badness(data_, row, at) > badness(data_, other, at)) {
      known->second = r;
    }
  }
  std::vector<bool> marks(data_.rows.size());
  for (const auto& [thing, row] : worst) {
    marks[row] = true;
  }
  return marks;
}

QByteArray AuditTable::csv(const std::vector<int>& rows) const {
  QByteArray text = data_.csvHeader;
  for (const int row : rows) {
    text += data_.rows[static_cast<std::size_t>(row)].csv;
  }
  return text;
}

int AuditTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(data_.rows.size());
}

int AuditTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(data_.columns.size());
}

QVariant AuditTable::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid | CheckIndexOption::ParentIsInvalid)) {
    return {};
  }
  const AuditRow& row = data_.rows[static_cast<std::size_t>(index.row())];
  if (role == itemRole) {
    return QVariant::fromValue(row.item);
  }
  const bool isText = index.column() < data_.textColumns;
  if (role == Qt::TextAlignmentRole) {
    return QVariant((isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
  }
  return isText ? textData(row, index.column(), role) : cellData(row, index.column(), role);
}

QVariant AuditTable::textData(const AuditRow& row, int column, int role) const {
  switch (role) {
    case Qt::DisplayRole:
    case rawRole:
      return row.texts[column];
    case Qt::ToolTipRole:
      return row.tip.isEmpty() ? row.texts[column] : row.texts[column] + "\n" + row.tip;
    default:
      return {};
  }
}

QVariant AuditTable::cellData(const AuditRow& row, int column, int role) const {
  const AuditCell& cell = row.cells[static_cast<std::size_t>(column - data_.textColumns)];
  switch (role) {
    case Qt::DisplayRole:
      return cell.value ? written(*cell.value, data_.columns[static_cast<std::size_t>(column)].decimals) : QVariant();
    case rawRole:
      return cell.value ? QVariant(*cell.value) : QVariant();
    case Qt::ToolTipRole:
      return cell.why.isEmpty() ? QVariant() : cell.why;
    default:
      return {};
  }
}

namespace {

/// The unit below what it is the unit of: columns of numbers are narrow.
QString stacked(QString title) {
  if (const qsizetype blank = title.lastIndexOf(u' '); blank >= 0) {
    title[blank] = u'\n';
  }
  return title;
}

}  // namespace

QVariant AuditTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) {
    return {};
  }
  const AuditColumn& column = data_.columns[static_cast<std::size_t>(section)];
  switch (role) {
    case Qt::DisplayRole:
      return section < data_.textColumns ? column.title : stacked(column.title);
    case Qt::ToolTipRole:
      return column.meaning.isEmpty() ? QVariant() : column.meaning;
    case Qt::TextAlignmentRole:
      return QVariant((section < data_.textColumns ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    default:
      return {};
  }
}

AuditFilter::AuditFilter(AuditTable& table, QObject* parent) : QSortFilterProxyModel(parent), table_(table) {
  setSourceModel(&table);
}

void AuditFilter::keepWorst(std::optional<int> column) {
  column_ = column;
  worst_ = column && table_.rowCount() > 0 ? table_.worstRows(*column) : std::vector<bool>();
  invalidateFilter();
}

std::vector<int> AuditFilter::shownRows() const {
  std::vector<int> rows;
  for (int r = 0; r < rowCount(); ++r) {
    rows.push_back(mapToSource(index(r, 0)).row());
  }
  return rows;
}

bool AuditFilter::filterAcceptsRow(int row, const QModelIndex& /*parent*/) const {
  const auto at = static_cast<std::size_t>(row);
  return at >= worst_.size() || worst_[at];
}

bool AuditFilter::lessThan(const QModelIndex& left, const QModelIndex& right) const {
  const QVariant a = left.data(AuditTable::rawRole);
  const QVariant b = right.data(AuditTable::rawRole);
  if (!a.isValid() || !b.isValid()) {
    // Descending order asks with the sides swapped.
    return sortOrder() == Qt::AscendingOrder ? a.isValid() && !b.isValid() : !a.isValid() && b.isValid();
  }
  if (left.column() < table_.table().textColumns) {
    return a.toString().compare(b.toString(), Qt::CaseInsensitive) < 0;
  }
  return a.toDouble() < b.toDouble();
}

}  // namespace lorica::models
