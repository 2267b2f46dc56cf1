#pragma once

/// \file
/// What is odd or wrong with the study.

#include <QWidget>

#include "lorica/document/study_document.h"
#include "lorica/models/problems_model.h"

class QLabel;
class QPushButton;
class QStackedWidget;
class QTableView;

namespace lorica::panels {

class ProblemsPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ProblemsPanel(document::StudyDocument& document, QWidget* parent = nullptr);

  models::ProblemsModel& model() const { return *model_; }
  QTableView& table() const { return *table_; }
  int errors() const { return model_->count(base::Severity::error); }
  int warnings() const { return model_->count(base::Severity::warning); }

 Q_SIGNALS:
  void countChanged(int errors, int warnings);

 private:
  void follow();
  /// Rows that are selected; all of them when none is.
  void copy() const;

  document::StudyDocument& document_;
  models::ProblemsModel* model_;
  QTableView* table_;
  QStackedWidget* pages_;
  QLabel* summary_;
  QPushButton* copy_;
};

}  // namespace lorica::panels
