#pragma once

/// \file
/// A run as a table: the columns of summary.csv, readable.

#include <QAbstractTableModel>
#include <QSortFilterProxyModel>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "lorica/document/study_document.h"

namespace lorica::models {

class ResultsModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column {
    sourceColumn,
    systemColumn,
    modelColumn,
    poseColumn,
    structureColumn,
    kindColumn,
    classColumn,
    shotsColumn,
    anyColumn,
    firstColumn,
    unprotectedColumn,
    protectedColumn,
    ofShotsColumn,
    ofBodyHitsColumn,
    coverageColumn,
    lowColumn,
    highColumn,
    columnTotal
  };
  /// The number as it stands in summary.csv; invalid where that is blank. Of columns of text the text of the file; what
  /// is shown of a model is its name in the window.
  static constexpr int rawRole = Qt::UserRole;
  /// document::ItemRef of the row's structure; invalid for rows that count no single thing.
  static constexpr int itemRole = Qt::UserRole + 1;

  explicit ResultsModel(QObject* parent = nullptr);

  /// Null: no rows.
  void setRecord(std::shared_ptr<const document::RunRecord> record);
  const std::shared_ptr<const document::RunRecord>& record() const { return record_; }

  const analysis::ResultRow& row(int row) const { return record_->summary[static_cast<std::size_t>(row)]; }
  /// Different texts of a column, in the order of the rows.
  QStringList distinct(Column column) const;
  /// These rows exactly as they stand in summary.csv, with its header.
  QByteArray csv(const std::vector<int>& rows) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

 private:
  std::shared_ptr<const document::RunRecord> record_;
};

/// What a row of the results counts, when that is one thing of the project.
std::optional<document::ItemRef> itemOf(const analysis::ResultRow& row);

/// Chooses and sorts rows of a ResultsModel. Blank cells come last in either direction; unsorted, rows keep the order
/// of summary.csv.
class ResultsFilter : public QSortFilterProxyModel {
  Q_OBJECT

 public:
  explicit ResultsFilter(QObject* parent = nullptr);

  /// Keeps rows whose column has this text; an empty text keeps all. \pre a column of text
  void setWanted(ResultsModel::Column column, const QString& text);
  /// Keeps rows whose structure or class holds this text, in any case.
  void setText(const QString& text);
  /// Rows of the source model as they are shown.
  std::vector<int> shownRows() const;

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override;

 private:
  std::array<QString, ResultsModel::shotsColumn> wanted_;
  QString text_;
};

}  // namespace lorica::models
