#include "lorica/panels/deformation_panel.h"

#include <QApplication>
#include <QChartView>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QSplitter>
#include <QStackedWidget>
#include <QTabWidget>
#include <QTableView>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>

#include "flow_layout.h"
#include "lorica/models/model_texts.h"
#include "lorica/models/numbers.h"
#include "lorica/panels/bar_figure.h"
#include "panel_parts.h"

namespace lorica::panels {

using document::ItemRef;
using document::StudyDocument;
using models::AuditTable;
using models::Measure;
using viscera::OrganModel;

namespace {

constexpr int restMs = 400;  ///< without a change until measuring is worth its while
constexpr int progressSteps = 1000;
constexpr int chartWidth = 360;

QString shown(const std::string& text) {
  return QString::fromStdString(text);
}

/// Bars of what is worst in the poses, organ by organ, a series for each model.
FigureData figureOf(const AuditTable& table, const analysis::DeformationTables& tables, Measure measure) {
  FigureData figure;
  const models::MeasureText text = models::textOf(measure);
  figure.valueTitle = text.title;
  figure.categoryTitle = DeformationPanel::tr("Organ");
  figure.blankNote = DeformationPanel::tr("cannot be measured");
  figure.unit = text.unit;
  figure.decimals = text.decimals;
  figure.title = tables.poses.size() > 1
                     ? DeformationPanel::tr("%1, worst of %2 poses").arg(text.title).arg(tables.poses.size())
                     : DeformationPanel::tr("%1, pose %2").arg(text.title, shown(tables.poses.front()));
  figure.categories = tables.organs;
  for (const OrganModel model : tables.models) {
    const std::string name = viscera::name(model);
    figure.series.push_back({name, modelColour(name), std::vector<FigureBar>(tables.organs.size())});
  }
  if (table.rowCount() == 0) {
    return figure;
  }
  const std::vector<bool> worst = table.worstRows(table.table().textColumns + static_cast<int>(measure));
  for (std::size_t r = 0; r < worst.size(); ++r) {
    const models::AuditRow& row = table.table().rows[r];
    const auto series = std::find_if(figure.series.begin(), figure.series.end(), [&](const FigureSeries& one) {
      return row.texts[table.modelColumn()] == models::modelFromFile(one.model);
    });
    if (worst[r]) {
      const auto organ = std::find(figure.categories.begin(), figure.categories.end(), row.item.name);
      FigureBar& bar = series->bars[static_cast<std::size_t>(organ - figure.categories.begin())];
      const std::optional<double>& value = row.cells[static_cast<std::size_t>(measure)].value;
      bar.value = value.value_or(0.0);
      bar.measured = value.has_value();
    }
  }
  return figure;
}

}  // namespace

DeformationPanel::DeformationPanel(StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), controller_(document) {
  rest_.setSingleShot(true);
  rest_.setInterval(restMs);
  connect(&rest_, &QTimer::timeout, this, [this] {
    if (isVisible()) {
      measurePose();
    }
  });
  pages_ = new QStackedWidget(this);
  QWidget* emptyPage = makeEmptyPage({}, this);
  empty_ = emptyPage->findChild<QLabel*>();
  organs_ = makeSheet("deformation");
  contacts_ = makeSheet("contacts");
  tabs_ = new QTabWidget(this);
  tabs_->setDocumentMode(true);
  tabs_->addTab(organs_.view, tr("Organs"));
  tabs_->addTab(contacts_.view, tr("Contacts"));
  auto* split = new QSplitter(this);
  split->addWidget(tabs_);
  split->addWidget(makeChart());
  split->setStretchFactor(0, 2);
  split->setStretchFactor(1, 1);
  split->setSizes({2 * chartWidth, chartWidth});
  pages_->addWidget(emptyPage);
  pages_->addWidget(split);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  column->setSpacing(panelMargin);
  column->addWidget(makeHeader());
  column->addWidget(pages_, 1);

  using jobs::DeformationController;
  connect(&controller_, &DeformationController::started, this, [this] {
    connect(controller_.job(), &jobs::Job::progressed, this,
            [this](double share) { progress_->setValue(static_cast<int>(progressSteps * share)); });
    progress_->setValue(0);
    updateState();
  });
  connect(&controller_, &DeformationController::ended, this, &DeformationPanel::updateState);
  connect(&controller_, &DeformationController::finished, this, &DeformationPanel::showReport);
  connect(&controller_, &DeformationController::failed, this, [this](const QString& text) {
    trouble_ = text;
    updateState();
  });
  connect(&document_, &StudyDocument::replaced, this, [this] {
    wantsAll_ = false;
    stopped_ = false;
    showReport(nullptr);
  });
  for (const auto signal :
       {&StudyDocument::loadedChanged, &StudyDocument::shownPoseChanged, &StudyDocument::shownModelsChanged}) {
    connect(&document_, signal, this, &DeformationPanel::follow);
  }
  connect(&document_, &StudyDocument::selectionChanged, this, &DeformationPanel::takeSelection);
  updateState();
}

DeformationPanel::~DeformationPanel() = default;

QWidget* DeformationPanel::makeHeader() {
  auto* header = new QWidget(this);
  auto* row = new QHBoxLayout(header);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(2 * panelMargin);
  caption_ = new QLabel(this);
  caption_->setWordWrap(true);
  caption_->setTextFormat(Qt::PlainText);
  caption_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  auto* bar = new QWidget(this);
  auto* flow = new FlowLayout(bar);
  const auto button = [&](const QString& text, const char* name, const QString& tip) {
    auto* made = new QPushButton(text, this);
    made->setObjectName(QLatin1String(name));
    made->setToolTip(tip);
    flow->addWidget(made);
    return made;
  };
  pose_ = button(tr("This pose"), "measure_pose", tr("Measure the pose that is shown"));
  all_ = button(tr("All poses of the study"), "measure_all",
                tr("Measure every pose that a run computes, and show the worst of each organ"));
  progress_ = new QProgressBar(this);
  progress_->setRange(0, progressSteps);
  progress_->setTextVisible(false);
  progress_->setMaximumWidth(160);
  flow->addWidget(progress_);
  stop_ = button(tr("Stop"), "stop", tr("Stop measuring; what is shown stays"));
  measure_ = makeChoice(tr("What the bars compare, and by which the worst pose is chosen"), this);
  measure_->setObjectName(QStringLiteral("measure"));
  for (int m = 0; m < models::measureTotal; ++m) {
    const models::MeasureText text = models::textOf(static_cast<Measure>(m));
    measure_->addItem(text.title, m);
    measure_->setItemData(m, text.meaning, Qt::ToolTipRole);
  }
  measure_->setCurrentIndex(static_cast<int>(Measure::protrusion));
  flow->addWidget(measure_);
  worst_ = new QCheckBox(tr("Worst pose only"), this);
  worst_->setToolTip(tr("Of each organ and model only the pose that is worst in what the bars compare"));
  worst_->setChecked(true);
  flow->addWidget(worst_);
  auto* copyButton = button(tr("Copy as CSV"), "copy",
                            tr("Copy the rows that are shown, in the form of "
                               "deformation.csv or contacts.csv"));
  row->addWidget(bar, 3);
  row->addWidget(caption_, 2);
  connect(pose_, &QPushButton::clicked, this, &DeformationPanel::measurePose);
  connect(all_, &QPushButton::clicked, this, &DeformationPanel::measureAllPoses);
  connect(stop_, &QPushButton::clicked, this, [this] {
    stopped_ = true;
    rest_.stop();
    controller_.cancel();
  });
  connect(worst_, &QCheckBox::toggled, this, &DeformationPanel::updateRows);
  connect(measure_, &QComboBox::currentIndexChanged, this, &DeformationPanel::updateRows);
  connect(copyButton, &QPushButton::clicked, this, &DeformationPanel::copyShown);
  return header;
}

QWidget* DeformationPanel::makeChart() {
  figure_ = new BarFigure;
  chart_ = new QChartView(figure_, this);
  chart_->setRenderHint(QPainter::Antialiasing);
  chart_->setFrameShape(QFrame::StyledPanel);
  chart_->setMinimumSize(chartWidth / 2, 0);
  figure_->setColours(palette().color(QPalette::Base), palette().color(QPalette::Text));
  connect(figure_, &BarFigure::hovered, this, [this](const QString& text) {
    if (text.isEmpty()) {
      QToolTip::hideText();
    } else {
      QToolTip::showText(QCursor::pos(), text, chart_);
    }
  });
  connect(figure_, &BarFigure::picked, this, [this](const std::string& organ) {
    const ItemRef item{document::ItemKind::organ, organ};
    if (document::exists(document_, item)) {
      document_.select(item);
    }
  });
  return chart_;
}

DeformationPanel::Sheet DeformationPanel::makeSheet(const char* name) {
  Sheet sheet;
  sheet.table = new AuditTable(this);
  sheet.filter = new models::AuditFilter(*sheet.table, this);
  sheet.view = makeTable(this);
  sheet.view->setObjectName(QLatin1String(name));
  sheet.view->setModel(sheet.filter);
  sheet.view->setSortingEnabled(true);
  sheet.view->sortByColumn(0, Qt::AscendingOrder);
  connect(sheet.view->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          &DeformationPanel::giveSelection);
  onKey(*sheet.view, QKeySequence::Copy, [this] { copySelected(); });
  return sheet;
}

void DeformationPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  follow();
}

void DeformationPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && figure_ != nullptr) {
    figure_->setColours(palette().color(QPalette::Base), palette().color(QPalette::Text));
  }
}

QString DeformationPanel::caption() const {
  return caption_->text();
}

Measure DeformationPanel::measure() const {
  return static_cast<Measure>(measure_->currentData().toInt());
}

std::vector<OrganModel> DeformationPanel::modelsToMeasure() const {
  std::vector<OrganModel> wanted = document_.shownModels();
  if (wanted.size() == 1) {
    const bool dynamic = wanted.front() == OrganModel::dynamic || wanted.front() == OrganModel::dynamicThesis;
    wanted.push_back(dynamic ? OrganModel::staticJoint : OrganModel::dynamic);
  }
  // Always in the same order, whichever is shown on the left.
  std::sort(wanted.begin(), wanted.end());
  return wanted;
}

bool DeformationPanel::isOfThePose() const {
  return report_ != nullptr && report_->study == document_.loaded() &&
         report_->tables.poses == std::vector{document_.shownPose()} && report_->tables.models == modelsToMeasure();
}

void DeformationPanel::follow() {
  updateState();
  const auto& loaded = document_.loaded();
  // What took a while to measure stays until something else is asked for.
  if (!isVisible() || loaded == nullptr || loaded->organs.empty() || stopped_ || wantsAll_ || isOfThePose()) {
    rest_.stop();
    return;
  }
  rest_.start();
}

void DeformationPanel::measurePose() {
  const auto& loaded = document_.loaded();
  if (loaded == nullptr || loaded->organs.empty()) {
    return;
  }
  wantsAll_ = false;
  stopped_ = false;
  trouble_.clear();
  controller_.start({document_.shownPose()}, modelsToMeasure());
}

void DeformationPanel::measureAllPoses() {
  const auto& loaded = document_.loaded();
  if (loaded == nullptr || loaded->organs.empty()) {
    return;
  }
  wantsAll_ = true;
  stopped_ = false;
  trouble_.clear();
  rest_.stop();
  controller_.start(analysis::defaultPoses(loaded->study), modelsToMeasure());
}

void DeformationPanel::showReport(Report report) {
  report_ = std::move(report);
  {
    const QScopedValueRollback<bool> guard(following_, true);
    const analysis::DeformationTables none;
    const analysis::DeformationTables& tables = report_ == nullptr ? none : report_->tables;
    organs_.table->setTable(models::organTable(tables));
    contacts_.table->setTable(models::contactTable(tables));
  }
  updateRows();
  for (const Sheet& sheet : {organs_, contacts_}) {
    sheet.view->setColumnHidden(sheet.table->poseColumn(), !spansPoses());
    sheet.view->resizeColumnsToContents();
  }
  updateState();
  takeSelection();
}

void DeformationPanel::updateRows() {
  const bool worst = spansPoses() && worst_->isChecked();
  const int column = organs_.table->table().textColumns + static_cast<int>(measure());
  const QScopedValueRollback<bool> guard(following_, true);
  organs_.filter->keepWorst(worst ? std::optional(column) : std::nullopt);
  // A pair is at its worst where it overlaps most.
  contacts_.filter->keepWorst(worst ? std::optional(contacts_.table->table().textColumns) : std::nullopt);
  updateChart();
}

void DeformationPanel::updateState() {
  const auto& loaded = document_.loaded();
  const bool can = loaded != nullptr && !loaded->organs.empty();
  const bool busy = controller_.job() != nullptr;
  pose_->setEnabled(can);
  all_->setEnabled(can);
  progress_->setVisible(busy);
  stop_->setVisible(busy);
  worst_->setVisible(spansPoses());
  pages_->setCurrentIndex(report_ == nullptr ? 0 : 1);
  QString text;
  if (!document_.hasStudy()) {
    text = tr("No study is open.");
  } else if (loaded == nullptr) {
    text = tr("The study is being read.");
  } else if (!can) {
    text = tr("The study has no organ to measure.");
  } else if (!trouble_.isEmpty()) {
    text = trouble_;
  } else {
    text = busy ? tr("Measuring the organs...") : tr("Nothing is measured yet. Press This pose.");
  }
  empty_->setText(text);
  updateCaption();
}

void DeformationPanel::updateCaption() {
  if (report_ == nullptr) {
    caption_->hide();
    return;
  }
  const analysis::DeformationTables& tables = report_->tables;
  QStringList names;
  for (const OrganModel model : tables.models) {
    names << models::modelLabel(model);
  }
  QString text = spansPoses() ? tr("%1 poses, %2.").arg(tables.poses.size()).arg(names.join(tr(" against ")))
                              : tr("Pose %1, %2.").arg(shown(tables.poses.front()), names.join(tr(" against ")));
  if (!spansPoses() && tables.restRoom && tables.rooms.front() && tables.restRoom->torso > 0.0) {
    const double change = 100.0 * (tables.rooms.front()->torso / tables.restRoom->torso - 1.0);
    text +=
        " " + tr("The room inside the skin of the torso changes by %1%2 %.")
                  .arg(change < 0.0 ? QString(QChar(0x2212)) : QStringLiteral("+"), models::fixed(std::abs(change), 1));
  }
  if (report_->study != document_.loaded()) {
    text += " " + QString(QChar(0x26A0)) + " " + tr("The study was changed since.");
  } else if (!spansPoses() && !isOfThePose() && controller_.job() == nullptr) {
    text += " " + QString(QChar(0x26A0)) + " " + tr("The view shows something else.");
  }
  if (!trouble_.isEmpty()) {
    text += " " + trouble_;
  }
  caption_->setText(text);
  caption_->show();
}

void DeformationPanel::updateChart() {
  figure_->setData(report_ == nullptr ? FigureData() : figureOf(*organs_.table, report_->tables, measure()));
}

void DeformationPanel::takeSelection() {
  if (following_) {
    return;
  }
  const QScopedValueRollback<bool> guard(following_, true);
  const std::optional<ItemRef>& wanted = document_.selection();
  for (const Sheet& sheet : {organs_, contacts_}) {
    QItemSelection rows;
    QModelIndex first;
    for (int row = 0; wanted && row < sheet.filter->rowCount(); ++row) {
      const QModelIndex index = sheet.filter->index(row, 0);
      if (index.data(AuditTable::itemRole).value<ItemRef>() == *wanted) {
        rows.select(index, index);
        first = first.isValid() ? first : index;
      }
    }
    sheet.view->selectionModel()->setCurrentIndex(first, QItemSelectionModel::NoUpdate);
    sheet.view->selectionModel()->select(rows, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    if (first.isValid()) {
      sheet.view->scrollTo(first);
    }
  }
}

void DeformationPanel::giveSelection(const QModelIndex& index) {
  const QVariant item = index.data(AuditTable::itemRole);
  if (following_ || !item.isValid() || !document::exists(document_, item.value<ItemRef>())) {
    return;
  }
  // The row the user takes stays as it is; the document's signal must not widen it.
  const QScopedValueRollback<bool> guard(following_, true);
  document_.select(item.value<ItemRef>());
}

const DeformationPanel::Sheet& DeformationPanel::shownSheet() const {
  return tabs_->currentWidget() == contacts_.view ? contacts_ : organs_;
}

void DeformationPanel::copyShown() const {
  const Sheet& sheet = shownSheet();
  QApplication::clipboard()->setText(QString::fromUtf8(sheet.table->csv(sheet.filter->shownRows())));
}

void DeformationPanel::copySelected() const {
  const Sheet& sheet = shownSheet();
  std::vector<int> rows;
  for (const QModelIndex& index : sheet.view->selectionModel()->selectedRows()) {
    rows.push_back(index.row());
  }
  // In the order they are seen.
  std::sort(rows.begin(), rows.end());
  for (int& row : rows) {
    row = sheet.filter->mapToSource(sheet.filter->index(row, 0)).row();
  }
  if (!rows.empty()) {
    QApplication::clipboard()->setText(QString::fromUtf8(sheet.table->csv(rows)));
  }
}

}  // namespace lorica::panels
