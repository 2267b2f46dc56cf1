#pragma once

/// \file
/// What one shot goes through, as a table.

#include <QAbstractTableModel>
#include <QStringList>
#include <vector>

#include "lorica/analysis/shot_report.h"

namespace lorica::models {

/// A passage of the shot through a structure, or a gap between structures. Texts as `lorica-cli run --shot-report`
/// prints them: lengths from the shot's start in mm, angles in degrees.
struct ShotRow {
  QString structure;  ///< "gap" of a gap
  QString kind;       ///< body, armor or organ; empty of a gap
  QString group;      ///< system of a piece, model of an organ; the table shows the window's name of a model
  QString enter;
  QString exit;
  QString thickness;
  QString normalThickness;
  QString obliquityIn;
  QString obliquityOut;
  QString depth;
  QString isProtected;  ///< "yes" or "no": whether armor is met before; empty for armor and gaps
};

/// The rows under one armor system and with the organs of one model, in the order in which they begin.
std::vector<ShotRow> shotRows(const analysis::ShotDetails& shot, const study::Overlap& overlap,
                              const std::string& system, const std::string& model);
/// A sentence on what the shot meets: armor in order, organs in order, and whether armor comes before the organs.
QString shotSummary(const analysis::ShotDetails& shot, const std::string& system, const std::string& model);

class ShotTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  using QAbstractTableModel::QAbstractTableModel;
  void setRows(std::vector<ShotRow> rows);
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  /// All rows with a line of names.
  QString csv() const;

 private:
  std::vector<ShotRow> rows_;
};

}  // namespace lorica::models
