#pragma once

#include <QAbstractTableModel>
#include <vector>

#include "lorica/base/issue.h"

namespace lorica::models {

/// Issues as a table, errors first; issues of one severity keep their order.
class ProblemsModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column { severityColumn, whereColumn, textColumn, columnTotal };

  explicit ProblemsModel(QObject* parent = nullptr);

  void setIssues(base::Issues issues);
  const base::Issues& issues() const { return issues_; }
  int count(base::Severity severity) const;
  /// Lines as lorica-cli prints them, one for each row.
  QString lines(const std::vector<int>& rows) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

 private:
  base::Issues issues_;
};

}  // namespace lorica::models
