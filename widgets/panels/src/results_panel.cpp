#include "lorica/panels/results_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QStyle>
#include <QTableView>
#include <QTimer>
#include <algorithm>

#include "flow_layout.h"
#include "lorica/models/numbers.h"
#include "panel_parts.h"

namespace lorica::panels {

using document::ItemRef;
using models::ResultsModel;

namespace {

constexpr int longestName = 20;  ///< average characters of a column of names when a run is first shown

}  // namespace

ResultsPanel::ResultsPanel(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      model_(new ResultsModel(this)),
      filter_(new models::ResultsFilter(this)),
      pages_(new QStackedWidget(this)) {
  filter_->setSourceModel(model_);

  auto* content = new QWidget(this);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(panelMargin);
  column->addWidget(makeHeader());
  column->addWidget(makeFilters());
  column->addWidget(makeTable(), 1);
  pages_->addWidget(makeEmptyPage(tr("No run yet. Open Shot lines... and press Run."), this));
  pages_->addWidget(content);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  layout->addWidget(pages_);

  connect(&document_, &document::StudyDocument::runsChanged, this, &ResultsPanel::followRuns);
  connect(&document_, &document::StudyDocument::studyChanged, this, [this](document::Changes what) {
    if (what != document::Changes(document::Change::display)) {
      updateCaution();
    }
  });
  connect(&document_, &document::StudyDocument::selectionChanged, this, &ResultsPanel::takeSelection);
  followRuns();
}

QWidget* ResultsPanel::makeHeader() {
  auto* header = new QWidget(this);
  auto* column = new QVBoxLayout(header);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(panelMargin);

  auto* bar = new QHBoxLayout;
  bar->setSpacing(panelMargin);
  runs_ = makeChoice(tr("The run that is shown"), this);
  runs_->setObjectName(QStringLiteral("run"));
  summary_ = new QLabel(this);
  summary_->setWordWrap(true);
  summary_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* copy = new QPushButton(tr("Copy as CSV"), this);
  copy->setToolTip(tr("Copy all rows that are shown, in the form of summary.csv"));
  auto* save = new QPushButton(tr("Save tables..."), this);
  save->setToolTip(tr("Write the tables of coverage and deformation and provenance.json of this run"));
  bar->addWidget(runs_);
  bar->addWidget(summary_, 1);
  bar->addWidget(copy);
  bar->addWidget(save);
  column->addLayout(bar);

  caution_ = new QLabel(this);
  caution_->setWordWrap(true);
  caution_->setTextFormat(Qt::PlainText);
  QFont bold = font();
  bold.setBold(true);
  caution_->setFont(bold);
  column->addWidget(caution_);

  connect(runs_, &QComboBox::currentIndexChanged, this, [this](int index) {
    if (index >= 0) {
      showRun(document_.runs()[static_cast<std::size_t>(index)]);
    }
  });
  connect(copy, &QPushButton::clicked, this, &ResultsPanel::copyShown);
  connect(save, &QPushButton::clicked, this, [this] { Q_EMIT saveRequested(run()); });
  return header;
}

QWidget* ResultsPanel::makeFilters() {
  auto* row = new QWidget(this);
  auto* flow = new FlowLayout(row);
  const auto add = [&](std::size_t at, const QString& name, ResultsModel::Column column, const QString& tip) {
    QComboBox* combo = makeChoice(tip, this);
    combo->setObjectName(name);
    combos_[at] = {column, combo};
    flow->addWidget(combo);
    connect(combo, &QComboBox::currentIndexChanged, this,
            [this, combo, column] { refilter([&] { filter_->setWanted(column, combo->currentData().toString()); }); });
  };
  add(0, QStringLiteral("source"), ResultsModel::sourceColumn, tr("Show one source"));
  add(1, QStringLiteral("system"), ResultsModel::systemColumn, tr("Show one armor system"));
  add(2, QStringLiteral("model"), ResultsModel::modelColumn, tr("Show one model of the organs"));
  add(3, QStringLiteral("pose"), ResultsModel::poseColumn, tr("Show one pose"));
  add(4, QStringLiteral("kind"), ResultsModel::kindColumn, tr("Show one kind of structure"));
  text_ = new QLineEdit(this);
  text_->setPlaceholderText(tr("Find structure"));
  text_->setClearButtonEnabled(true);
  text_->setMaximumWidth(text_->fontMetrics().averageCharWidth() * 20);
  text_->setToolTip(tr("Show structures whose name or class holds this text"));
  flow->addWidget(text_);
  count_ = new QLabel(this);
  count_->setForegroundRole(QPalette::PlaceholderText);
  flow->addWidget(count_);
  connect(text_, &QLineEdit::textChanged, this,
          [this](const QString& text) { refilter([&] { filter_->setText(text); }); });
  return row;
}

QWidget* ResultsPanel::makeTable() {
  table_ = panels::makeTable(this);
  table_->setObjectName(QStringLiteral("results"));
  table_->setModel(filter_);
  table_->setSortingEnabled(true);
  table_->setTextElideMode(Qt::ElideMiddle);
  QHeaderView* header = table_->horizontalHeader();
  header->setSortIndicatorClearable(true);
  header->setSectionsMovable(true);
  // What one looks for comes first: which structure, in which circumstances, how well covered. Counts and what seldom
  // differs follow.
  using Model = ResultsModel;
  static constexpr std::array first{Model::structureColumn,   Model::systemColumn,    Model::modelColumn,
                                    Model::poseColumn,        Model::coverageColumn,  Model::lowColumn,
                                    Model::highColumn,        Model::anyColumn,       Model::protectedColumn,
                                    Model::unprotectedColumn, Model::ofBodyHitsColumn};
  for (std::size_t place = 0; place < first.size(); ++place) {
    header->moveSection(header->visualIndex(first.at(place)), static_cast<int>(place));
  }
  table_->sortByColumn(-1, Qt::AscendingOrder);
  auto* copy = new QAction(tr("Copy selected rows as CSV"), table_);
  copy->setShortcut(QKeySequence::Copy);
  copy->setShortcutContext(Qt::WidgetShortcut);
  onKey(*table_, QKeySequence::Copy, [this] { copySelected(); });
  table_->addAction(copy);
  table_->setContextMenuPolicy(Qt::ActionsContextMenu);
  connect(copy, &QAction::triggered, this, &ResultsPanel::copySelected);
  connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, &ResultsPanel::giveSelection);
  return table_;
}

void ResultsPanel::refilter(const std::function<void()>& change) {
  {
    // A current row that goes makes another one current, which nobody chose.
    const QScopedValueRollback<bool> guard(following_, true);
    change();
  }
  updateCount();
  takeSelection();
}

void ResultsPanel::followRuns() {
  const auto& runs = document_.runs();
  const bool isNew = runs.size() > knownRuns_;
  knownRuns_ = runs.size();
  {
    const QSignalBlocker quiet(runs_);
    runs_->clear();
    for (const Record& record : runs) {
      const QString name = QString::fromStdString(record->name);
      runs_->addItem(record->result.partial ? tr("%1 (partial)").arg(name) : name);
    }
  }
  const bool stays = std::find(runs.begin(), runs.end(), run()) != runs.end();
  showRun(runs.empty() ? nullptr : isNew || !stays ? runs.back() : run());
}

void ResultsPanel::showRun(const Record& run) {
  const auto& runs = document_.runs();
  const auto at = std::find(runs.begin(), runs.end(), run);
  pages_->setCurrentIndex(run == nullptr ? 0 : 1);
  {
    const QSignalBlocker quiet(runs_);
    runs_->setCurrentIndex(at == runs.end() ? -1 : static_cast<int>(at - runs.begin()));
  }
  if (run != this->run()) {
    const bool first = this->run() == nullptr;
    {
      const QScopedValueRollback<bool> guard(following_, true);
      model_->setRecord(run);
    }
    refillFilters();
    if (first && run != nullptr) {
      table_->resizeColumnsToContents();
      // Long names must not push the coverage out of sight; they are cut in the middle and whole in the tooltip.
      const int most = longestName * table_->fontMetrics().averageCharWidth();
      for (int column = 0; column < ResultsModel::shotsColumn; ++column) {
        table_->setColumnWidth(column, std::min(most, table_->columnWidth(column)));
      }
    }
    Q_EMIT runShown(run);
  }
  updateSummary();
  updateCaution();
  updateCount();
  takeSelection();
}

void ResultsPanel::refillFilters() {
  const std::array<QString, 5> all{tr("All sources"), tr("All systems"), tr("All models"), tr("All poses"),
                                   tr("All kinds")};
  for (std::size_t i = 0; i < combos_.size(); ++i) {
    const QStringList texts = model_->distinct(combos_[i].column);
    (combos_[i].column == ResultsModel::modelColumn ? refillModels : refill)(*combos_[i].combo, texts, all[i]);
    // The same in every row: nothing to choose, nothing to read.
    combos_[i].combo->setVisible(texts.size() > 1);
    table_->setColumnHidden(combos_[i].column, texts.size() < 2);
    filter_->setWanted(combos_[i].column, combos_[i].combo->currentData().toString());
  }
}

void ResultsPanel::updateSummary() {
  if (run() == nullptr) {
    summary_->clear();
    return;
  }
  const analysis::RunResult& result = run()->result;
  std::uint64_t least = 0;
  std::uint64_t most = 0;
  for (const analysis::ShotSource& source : result.sources) {
    least = least == 0 ? source.shots : std::min(least, source.shots);
    most = std::max(most, source.shots);
  }
  std::uint64_t shots = 0;
  std::uint64_t bodyHits = 0;
  std::uint64_t unresolved = 0;
  for (const analysis::SourcePoseResult& part : result.results) {
    unresolved += part.counts.unresolved;
    for (const shotline::Tally& trial : part.trials) {
      shots += trial.shots();
      bodyHits += trial.body(0).any;
    }
  }
  const QString perTrial =
      least == most ? models::grouped(most) : tr("%1 to %2").arg(models::grouped(least), models::grouped(most));
  const auto counted = [](std::size_t count, const QString& one, const QString& many) {
    return count == 1 ? one : many.arg(count);
  };
  QStringList parts{tr("%1 shots %2 %3 per source")
                        .arg(perTrial, QString(QChar(0xD7)), counted(result.trials, tr("1 trial"), tr("%1 trials"))),
                    counted(result.sources.size(), tr("1 source"), tr("%1 sources")),
                    counted(result.poses.size(), tr("1 pose"), tr("%1 poses"))};
  if (shots > 0) {
    parts << tr("%1\u00A0% hit the body")
                 .arg(models::fixed(100.0 * static_cast<double>(bodyHits) / static_cast<double>(shots), 1));
  }
  parts << tr("%1 unresolved").arg(models::grouped(unresolved));
  summary_->setText(parts.join(", ") + ".");
  summary_->setToolTip(
      tr("Unresolved shots are those whose crossings stayed unclear after tracing them again. "
         "They are counted all the same."));
}

void ResultsPanel::updateCaution() {
  QStringList texts;
  if (run() != nullptr) {
    if (run()->result.partial) {
      texts << tr("Partial: the run was cancelled; only its finished trials are counted.");
    }
    if (!document::sameNumbers(run()->study->study, document_.study())) {
      texts << tr("The study was changed after this run.");
    }
  }
  caution_->setText(texts.isEmpty() ? QString() : QString(QChar(0x26A0)) + " " + texts.join(" "));
  caution_->setVisible(!texts.isEmpty());
}

void ResultsPanel::updateCount() {
  const int shown = filter_->rowCount();
  const int all = model_->rowCount();
  count_->setText(shown == all ? tr("%1 rows").arg(models::grouped(static_cast<std::uint64_t>(all)))
                               : tr("%1 of %2 rows")
                                     .arg(models::grouped(static_cast<std::uint64_t>(shown)),
                                          models::grouped(static_cast<std::uint64_t>(all))));
}

QString ResultsPanel::summary() const {
  return summary_->text();
}

QString ResultsPanel::caution() const {
  return caution_->text();
}

void ResultsPanel::takeSelection() {
  if (following_ || run() == nullptr) {
    return;
  }
  const QScopedValueRollback<bool> guard(following_, true);
  const std::optional<ItemRef>& wanted = document_.selection();
  QItemSelection rows;
  QModelIndex first;
  for (int row = 0; wanted && row < filter_->rowCount(); ++row) {
    // A column that is hidden cannot be scrolled to.
    const QModelIndex index = filter_->index(row, ResultsModel::structureColumn);
    const QVariant item = index.data(ResultsModel::itemRole);
    if (item.isValid() && item.value<ItemRef>() == *wanted) {
      rows.select(index, index);
      first = first.isValid() ? first : index;
    }
  }
  table_->selectionModel()->setCurrentIndex(first, QItemSelectionModel::NoUpdate);
  table_->selectionModel()->select(rows, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  if (first.isValid()) {
    table_->scrollTo(first);
  }
}

void ResultsPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  // Only what is laid out can scroll to the selection.
  QTimer::singleShot(0, this, &ResultsPanel::takeSelection);
}

void ResultsPanel::giveSelection() {
  const QVariant item = table_->currentIndex().data(ResultsModel::itemRole);
  if (following_ || !item.isValid() || !document::exists(document_, item.value<ItemRef>())) {
    return;
  }
  // The rows the user takes stay as they are; the document's signal must not widen them.
  const QScopedValueRollback<bool> guard(following_, true);
  document_.select(item.value<ItemRef>());
}

void ResultsPanel::copySelected() const {
  std::vector<int> shown;
  for (const QModelIndex& index : table_->selectionModel()->selectedRows()) {
    shown.push_back(index.row());
  }
  // In the order they are seen.
  std::sort(shown.begin(), shown.end());
  std::vector<int> rows;
  rows.reserve(shown.size());
  for (const int row : shown) {
    rows.push_back(filter_->mapToSource(filter_->index(row, 0)).row());
  }
  if (!rows.empty()) {
    QApplication::clipboard()->setText(QString::fromUtf8(model_->csv(rows)));
  }
}

void ResultsPanel::copyShown() const {
  QApplication::clipboard()->setText(QString::fromUtf8(model_->csv(filter_->shownRows())));
}

}  // namespace lorica::panels
