#pragma once

/// \file
/// One shot in full: what it goes through in the pose that is shown. It is clicked in the view or named as
/// SOURCE:TRIAL:SHOT.

#include <QWidget>
#include <memory>
#include <optional>

#include "lorica/jobs/shot_inspector.h"
#include "lorica/models/shot_table.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QTableView;
class QToolButton;

namespace lorica::panels {

class ShotPanel : public QWidget {
  Q_OBJECT

 public:
  /// \pre the document outlives it
  explicit ShotPanel(document::StudyDocument& document, QWidget* parent = nullptr);
  /// Looks into a shot; says why when there is none of that name. Empty: into none any more.
  void inspect(const QString& name);
  const models::ShotTable& table() const { return *table_; }
  /// The shot that is shown; null while there is none.
  const std::shared_ptr<const jobs::ShotInspection>& inspection() const { return inspection_; }
  bool isBusy() const { return inspector_.isBusy(); }

 Q_SIGNALS:
  /// Another shot is shown, or none (null).
  void inspected(std::shared_ptr<const lorica::jobs::ShotInspection> inspection);

 private:
  void ask();
  void present(std::shared_ptr<const jobs::ShotInspection> inspection, const QString& trouble);
  void refreshChoices();
  void refreshTable();

  document::StudyDocument& document_;
  jobs::ShotInspector inspector_;
  QString name_;
  std::shared_ptr<const jobs::ShotInspection> inspection_;
  models::ShotTable* table_;
  QLineEdit* edit_;
  QComboBox* systems_;
  QComboBox* models_;
  QToolButton* copy_;
  QLabel* summary_;
  QTableView* view_;
};

}  // namespace lorica::panels
