#pragma once

/// \file
/// The deformation audit as tables: organs (deformation.csv) and pairs of organs (contacts.csv).

#include <QAbstractTableModel>
#include <QSortFilterProxyModel>
#include <optional>
#include <vector>

#include "lorica/analysis/deformation.h"
#include "lorica/document/item_ref.h"

namespace lorica::models {

/// What is measured of an organ, in the order of the columns.
enum class Measure { volume, outside, protrusion, overlap, gap, inverted, jacobian, stretch };
inline constexpr int measureTotal = 8;

struct MeasureText {
  Measure measure;
  QString title;    ///< with its unit
  QString meaning;  ///< one sentence or two
  QString unit;     ///< "%", " mm" and so on, as it follows a number
  int decimals;
};
MeasureText textOf(Measure measure);

/// A number of a table, or why there is none.
struct AuditCell {
  std::optional<double> value;  ///< in the column's unit
  QString why;                  ///< one sentence where there is no value; else what there is to say of it, or empty
};

struct AuditRow {
  QStringList texts;  ///< of the columns of text
  std::vector<AuditCell> cells;
  document::ItemRef item;  ///< the organ; of a pair, the first one
  QString tip;             ///< of the columns of text
  QByteArray csv;          ///< the row as it stands in the file, with its line end
};

struct AuditColumn {
  QString title;
  QString meaning;
  int decimals = 1;
  /// How bad a value is; of several poses that with the greatest is the worst.
  enum class Worse { larger, smaller, fartherFromZero } worse = Worse::larger;
};

struct AuditTableData {
  QByteArray csvHeader;
  int textColumns = 0;               ///< the last two are model and pose
  std::vector<AuditColumn> columns;  ///< those of text first
  std::vector<AuditRow> rows;        ///< in the order of the file
};

/// deformation.csv: organ, model, pose, then the measures.
AuditTableData organTable(const analysis::DeformationTables& tables);
/// contacts.csv: two organs, model, pose, then overlap, overlap beyond rest, mean and largest gap.
AuditTableData contactTable(const analysis::DeformationTables& tables);

class AuditTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  /// The number, invalid where there is none; texts for columns of text.
  static constexpr int rawRole = Qt::UserRole;
  /// document::ItemRef of the row's organ.
  static constexpr int itemRole = Qt::UserRole + 1;

  explicit AuditTable(QObject* parent = nullptr);

  void setTable(AuditTableData table);
  const AuditTableData& table() const { return data_; }
  int modelColumn() const { return data_.textColumns - 2; }
  int poseColumn() const { return data_.textColumns - 1; }
  /// Of each thing and model the row that is worst in a column; of equally bad ones that which is worse in the first of
  /// the other columns. Rows without a number are worst only where there is no other. \pre a column of numbers
  std::vector<bool> worstRows(int column) const;
  /// These rows exactly as they stand in the file, with its header.
  QByteArray csv(const std::vector<int>& rows) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

 private:
  QVariant textData(const AuditRow& row, int column, int role) const;
  QVariant cellData(const AuditRow& row, int column, int role) const;

  AuditTableData data_;
};

/// Sorts an AuditTable, and keeps of several poses the worst. Blank cells come last in either direction; rows that are
/// equal keep the order of the file.
class AuditFilter : public QSortFilterProxyModel {
  Q_OBJECT

 public:
  explicit AuditFilter(AuditTable& table, QObject* parent = nullptr);

  /// Keeps of each thing and model the row that is worst in this column; none: all rows.
  void keepWorst(std::optional<int> column);
  /// Rows of the table as they are shown.
  std::vector<int> shownRows() const;

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override;

 private:
  AuditTable& table_;
  std::optional<int> column_;
  std::vector<bool> worst_;
};

}  // namespace lorica::models
