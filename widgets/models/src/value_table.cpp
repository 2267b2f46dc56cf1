#include "lorica/models/value_table.h"

#include <algorithm>
#include <limits>

#include "lorica/base/error.h"

namespace lorica::models {

void ValueTable::setContent(TableContent content) {
  for (const auto& row : content.rows) {
    LORICA_CHECK(row.size() == content.columns.size(), "a cell for each column");
  }
  beginResetModel();
  content_ = std::move(content);
  endResetModel();
}

bool ValueTable::isIdle(int column) const {
  const auto at = static_cast<std::size_t>(column);
  const auto& rows = content_.rows;
  return !content_.columns.at(at).tells &&
         std::all_of(rows.begin(), rows.end(), [&](const auto& row) { return row[at].text == rows.front()[at].text; });
}

int ValueTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(content_.rows.size());
}

int ValueTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(content_.columns.size());
}

QVariant ValueTable::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
    return {};
  }
  const auto column = static_cast<std::size_t>(index.column());
  const ValueCell& cell = content_.rows[static_cast<std::size_t>(index.row())][column];
  switch (role) {
    case Qt::DisplayRole:
      return cell.text;
    case Qt::ToolTipRole:
      return cell.tip.isEmpty() ? cell.text : cell.tip;
    case Qt::TextAlignmentRole:
      return QVariant::fromValue(Qt::AlignVCenter |
                                 (content_.columns[column].isNumber ? Qt::AlignRight : Qt::AlignLeft));
    case orderRole:
      if (content_.columns[column].isNumber) {
        // What has no number stands below all that have one.
        return cell.number.value_or(-std::numeric_limits<double>::infinity());
      }
      return cell.number ? QVariant(*cell.number) : QVariant(cell.text);
    default:
      return {};
  }
}

QVariant ValueTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) {
    return {};
  }
  const ValueColumn& column = content_.columns[static_cast<std::size_t>(section)];
  switch (role) {
    case Qt::DisplayRole:
      return column.title;
    case Qt::ToolTipRole:
      return column.tip.isEmpty() ? QVariant() : QVariant(column.tip);
    case Qt::TextAlignmentRole:
      return QVariant::fromValue(Qt::AlignVCenter | (column.isNumber ? Qt::AlignRight : Qt::AlignLeft));
    default:
      return {};
  }
}

}  // namespace lorica::models
