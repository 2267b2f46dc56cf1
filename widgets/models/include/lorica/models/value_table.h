#pragma once

/// \file
/// A table that is made once and only read: texts, and the numbers behind them to sort by.

#include <QAbstractTableModel>
#include <QString>
#include <optional>
#include <vector>

namespace lorica::models {

struct ValueColumn {
  QString title;
  QString tip{};
  bool isNumber = false;  ///< right-aligned
  bool tells = true;      ///< worth a column also where it is the same in every row
};

struct ValueCell {
  QString text;
  std::optional<double> number{};  ///< what to sort by; none: the text
  QString tip{};                   ///< empty: the text
};

/// \pre as many cells in each row as columns
struct TableContent {
  std::vector<ValueColumn> columns;
  std::vector<std::vector<ValueCell>> rows;
};

class ValueTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  /// What to sort by.
  static constexpr int orderRole = Qt::UserRole;

  using QAbstractTableModel::QAbstractTableModel;
  void setContent(TableContent content);
  const TableContent& content() const { return content_; }
  /// Whether a column says nothing: it is the same in every row of several, and does not tell all the same.
  bool isIdle(int column) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  TableContent content_;
};

}  // namespace lorica::models
