#pragma once

/// \file
/// Runs as tables.

#include <QWidget>
#include <array>
#include <functional>

#include "lorica/models/results_model.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QStackedWidget;
class QTableView;

namespace lorica::panels {

class ResultsPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ResultsPanel(document::StudyDocument& document, QWidget* parent = nullptr);

  using Record = std::shared_ptr<const document::RunRecord>;
  /// The run that is shown; null before the first.
  const Record& run() const { return model_->record(); }
  void showRun(const Record& run);

  QTableView& table() const { return *table_; }
  models::ResultsModel& model() const { return *model_; }
  const models::ResultsFilter& filter() const { return *filter_; }
  /// What stands above the table: the run in one line, and what is doubtful about it.
  QString summary() const;
  QString caution() const;

 Q_SIGNALS:
  void runShown(const std::shared_ptr<const lorica::document::RunRecord>& run);
  void saveRequested(const std::shared_ptr<const lorica::document::RunRecord>& run);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct FilterCombo {
    models::ResultsModel::Column column;
    QComboBox* combo;
  };

  QWidget* makeHeader();
  QWidget* makeFilters();
  QWidget* makeTable();
  void followRuns();
  void updateSummary();
  void updateCaution();
  void updateCount();
  void refillFilters();
  void refilter(const std::function<void()>& change);
  /// Selects the rows of what is selected in the document.
  void takeSelection();
  void giveSelection();
  void copySelected() const;
  void copyShown() const;

  document::StudyDocument& document_;
  models::ResultsModel* model_;
  models::ResultsFilter* filter_;
  QStackedWidget* pages_;
  QComboBox* runs_ = nullptr;
  QLabel* summary_ = nullptr;
  QLabel* caution_ = nullptr;
  QLabel* count_ = nullptr;
  QLineEdit* text_ = nullptr;
  std::array<FilterCombo, 5> combos_{};
  QTableView* table_ = nullptr;
  std::size_t knownRuns_ = 0;
  bool following_ = false;  ///< the selection comes from the document
};

}  // namespace lorica::panels
