/// \file
/// What the panel of analyses shows once they are worked out: map, lines, tables.

#include <QChart>
#include <QChartView>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineSeries>
#include <QSortFilterProxyModel>
#include <QStackedWidget>
#include <QTableView>
#include <QValueAxis>
#include <algorithm>
#include <array>

#include "lorica/io/export.h"
#include "lorica/models/analysis_tables.h"
#include "lorica/models/numbers.h"
#include "lorica/panels/survey_panel.h"
#include "panel_parts.h"

namespace lorica::panels {

namespace {

using analysis::ResultRow;

std::string chosen(const QComboBox& combo) {
  return combo.currentData().toString().toStdString();
}

QString shownName(const std::string& name) {
  return QString::fromStdString(name);
}

/// Colours of lines, told apart by the colour-blind and in grey.
const std::array<QColor, 5> lineColours{QColor(120, 120, 120), QColor(0, 114, 178), QColor(213, 94, 0),
                                        QColor(0, 158, 115), QColor(204, 121, 167)};

const ResultRow* rowFor(const std::vector<ResultRow>& rows, const std::string& system, const std::string& model,
                        const std::string& structure) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ResultRow& row) {
    return row.system == system && row.model == model && row.structure == structure;
  });
  return found == rows.end() ? nullptr : &*found;
}

QString number(double value) {
  return QString::number(value, 'g', 8);
}

}  // namespace

bool SurveyPanel::showsMotion() const {
  return what_->currentData().toInt() == SurveyWhat::coverageOverTime;
}

MapData SurveyPanel::mapData() const {
  MapData made;
  const bool open = what_->currentData().toInt() == SurveyWhat::openByDirection;
  made.step = run_->study->study.analyses.directions.value_or(study::DirectionGrid()).step;
  made.title = open ? tr("Unprotected area") : tr("Coverage");
  made.unit = open ? QStringLiteral(" cm²") : QStringLiteral(" %");
  made.highest = open ? 0.0 : 100.0;
  std::vector<double> badness;  // per cell, as directions.csv marks the worst
  bool covers = false;
  for (const jobs::DirectionRows& here : survey_->directions) {
    if (run_->result.poses[here.pose] != chosen(*pose_)) {
      continue;
    }
    const ResultRow* row = rowFor(here.rows, chosen(*system_), chosen(*model_), chosen(*structure_));
    if (row == nullptr) {
      continue;
    }
    MapCell cell{here.azimuth, here.elevation, {}, {}};
    const double openArea = 1e4 * here.area * static_cast<double>(row->unprotected()) /
                            static_cast<double>(std::max<std::uint64_t>(1, row->shots));
    if (const auto coverage = row->coverage()) {
      cell.value = open ? openArea : 100.0 * *coverage;
    }
    cell.tip = tr("azimuth %1°, elevation %2°\n%3")
                   .arg(here.azimuth)
                   .arg(here.elevation)
                   .arg(cell.value ? tr("coverage %1 %, unprotected %2 cm²; %3 of %4 shots hit it")
                                         .arg(models::fixed(100.0 * *row->coverage(), 1), models::fixed(openArea, 1),
                                              models::grouped(row->count.any), models::grouped(row->shots))
                                   : tr("no shot hits it from there"));
    made.highest = open ? std::max(made.highest, cell.value.value_or(0.0)) : made.highest;
    covers = covers || row->count.shielded > 0;
    badness.push_back(open ? openArea : row->coverage() ? -row->coverageInterval()->high : -1.0);
    made.cells.push_back(std::move(cell));
  }
  for (std::size_t i = 0; covers && i < made.cells.size(); ++i) {
    const bool worse = made.cells[i].value && (!made.mark || badness[i] > badness[*made.mark]);
    made.mark = worse ? std::optional(i) : made.mark;
  }
  if (made.mark) {
    made.markText =
        tr("Worst direction, framed: %1").arg(QString(made.cells[*made.mark].tip).replace(u'\n', QLatin1String(", ")));
  }
  return made;
}

void SurveyPanel::drawLines() {
  QChart& chart = *lines_->chart();
  chart.removeAllSeries();
  for (QAbstractAxis* axis : chart.axes()) {
    chart.removeAxis(axis);
    delete axis;
  }
  chart.setBackgroundBrush(palette().color(QPalette::Base));
  chart.setBackgroundRoundness(0);
  chart.setMargins(QMargins(panelMargin, panelMargin, panelMargin, panelMargin));
  chart.legend()->setLabelColor(palette().color(QPalette::Text));
  chart.legend()->setAlignment(Qt::AlignRight);
  auto* time = new QValueAxis;
  auto* value = new QValueAxis;
  value->setRange(0.0, 100.0);
  // Units stand at the numbers: titles would take the height that lines need.
  value->setLabelFormat(QStringLiteral("%g %%"));
  time->setLabelFormat(QStringLiteral("%g s"));
  time->setTruncateLabels(false);
  chart.addAxis(time, Qt::AlignBottom);
  chart.addAxis(value, Qt::AlignLeft);
  double end = 0.0;
  QString worst;
  for (std::size_t s = 0; s < run_->result.systems.size(); ++s) {
    auto* line = new QLineSeries;
    line->setName(QString::fromStdString(run_->result.systems[s]));
    line->setPen(QPen(lineColours[s % lineColours.size()], 2.0));
    line->setPointsVisible(true);
    std::optional<QPointF> lowest;
    for (const jobs::FrameRows& frame : survey_->frames) {
      const ResultRow* row = rowFor(frame.rows, run_->result.systems[s], chosen(*model_), chosen(*structure_));
      if (row == nullptr || row->source != chosen(*source_) || !row->coverage()) {
        continue;
      }
      const QPointF point(frame.seconds, 100.0 * *row->coverage());
      line->append(point);
      end = std::max(end, frame.seconds);
      lowest = !lowest || point.y() < lowest->y() ? point : *lowest;
    }
    chart.addSeries(line);
    line->attachAxis(time);
    line->attachAxis(value);
    if (lowest && line->name().toStdString() == chosen(*system_)) {
      worst = tr("%1 is lowest at %2 s: %3 %.")
                  .arg(line->name(), models::fixed(lowest->x(), 2), models::fixed(lowest->y(), 1));
    }
  }
  time->setRange(0.0, end > 0.0 ? end : 1.0);
  for (QAbstractAxis* axis : chart.axes()) {
    axis->setLabelsColor(palette().color(QPalette::Text));
    axis->setTitleBrush(palette().color(QPalette::Text));
  }
  worst_->setText(worst);
}

void SurveyPanel::refreshFigure() {
  if (survey_ == nullptr) {
    return;
  }
  const bool motion = showsMotion();
  const bool table = showsTable();
  figures_->setCurrentIndex(table ? 2 : motion ? 1 : 0);
  structure_->setVisible(!table);
  pose_->setVisible(!motion && !table && pose_->count() > 1);
  source_->setVisible(motion && source_->count() > 1);
  model_->setVisible(model_->count() > 1);
  pickPatch({});
  if (table) {
    fillTable();
  } else if (motion) {
    drawLines();
  } else {
    MapData made = mapData();
    worst_->setText(made.markText);
    map_->setData(std::move(made));
  }
}

bool SurveyPanel::showsTable() const {
  const int what = what_->currentData().toInt();
  return what == SurveyWhat::gapsInArmor || what == SurveyWhat::placesOfOrgans;
}

QWidget* SurveyPanel::makeTables() {
  table_ = makeTable(this);
  table_->setObjectName(QStringLiteral("survey_table"));
  values_ = new models::ValueTable(this);
  sorted_ = new QSortFilterProxyModel(this);
  sorted_->setSourceModel(values_);
  sorted_->setSortRole(models::ValueTable::orderRole);
  table_->setModel(sorted_);
  table_->setSortingEnabled(true);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->horizontalHeader()->setSortIndicatorClearable(true);
  table_->sortByColumn(-1, Qt::AscendingOrder);
  connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& row) { pickPatch(patchOf(row)); });
  connect(table_, &QTableView::activated, this, [this](const QModelIndex& row) {
    if (auto patch = patchOf(row)) {
      Q_EMIT patchLookedAt(patch);
    }
  });
  return table_;
}

void SurveyPanel::fillTable() {
  const analysis::RunResult& result = run_->result;
  const std::string system = chosen(*system_);
  const std::string model = chosen(*model_);
  gaps_.clear();
  places_.reset();
  if (what_->currentData().toInt() == SurveyWhat::gapsInArmor) {
    for (const analysis::Gap& gap : *survey_->gaps) {
      if (result.systems[gap.system] == system && viscera::name(result.models[gap.model]) == model) {
        gaps_.push_back(gap);
      }
    }
    values_->setContent(models::gapTable(result, gaps_));
    worst_->setText(gaps_.empty() ? tr("No shot reaches what is to be protected past %1.").arg(shownName(system))
                                  : tr("Click a row to see the gap on the skin; double-click to look at it from where "
                                       "it is shot through."));
  } else {
    places_ = *survey_->anatomy;
    const auto records = analysis::anatomyRecords(*run_->study, result, *places_);
    std::vector<analysis::AnatomyRecord> kept;
    places_->rows.clear();
    for (std::size_t r = 0; r < records.size(); ++r) {
      if (records[r].run.system == system && records[r].run.model == model) {
        kept.push_back(records[r]);
        places_->rows.push_back(survey_->anatomy->rows[r]);
      }
    }
    values_->setContent(models::anatomyTable(kept, places_->draws));
    worst_->setText(
        tr("Organs were moved %1 times by what is published of their places. The interval says how sure the "
           "shots make the coverage, the percentiles how sure the anatomy makes it.")
            .arg(places_->draws));
  }
  for (int column = 0; column < values_->columnCount(); ++column) {
    table_->setColumnHidden(column, values_->isIdle(column));
  }
  table_->resizeColumnsToContents();
}

std::shared_ptr<const jobs::SkinPatch> SurveyPanel::patchOf(const QModelIndex& shown) const {
  const int row = sorted_->mapToSource(shown).row();
  if (!shown.isValid() || row >= static_cast<int>(gaps_.size())) {
    return nullptr;
  }
  const analysis::Gap& gap = gaps_[static_cast<std::size_t>(row)];
  if (gap.number == 0) {
    return nullptr;
  }
  return std::make_shared<jobs::SkinPatch>(jobs::SkinPatch{run_->study->body, run_->result.poses[gap.pose],
                                                           gap.patch.triangles, gap.patch.centre, gap.towards});
}

void SurveyPanel::pickPatch(std::shared_ptr<const jobs::SkinPatch> patch) {
  if (patch != nullptr || picked_ != nullptr) {
    picked_ = std::move(patch);
    Q_EMIT patchPicked(picked_);
  }
}

QByteArray SurveyPanel::csv() const {
  std::string text;
  if (survey_ == nullptr) {
    return {};
  }
  if (showsTable()) {
    return csvOfTable();
  }
  if (!showsMotion()) {
    const MapData& shown = map_->data();
    text = io::csvRow(std::vector<std::string>{"azimuth_deg", "elevation_deg",
                                               shown.unit.contains(u'%') ? "coverage_pct" : "unprotected_area_cm2"});
    for (const MapCell& cell : shown.cells) {
      text +=
          io::csvRow(std::vector<std::string>{number(cell.azimuth).toStdString(), number(cell.elevation).toStdString(),
                                              cell.value ? number(*cell.value).toStdString() : ""});
    }
    return QByteArray::fromStdString(text);
  }
  text = io::csvRow(std::vector<std::string>{"system", "time_s", "coverage_pct"});
  for (const QAbstractSeries* series : lines_->chart()->series()) {
    for (const QPointF& point : static_cast<const QLineSeries*>(series)->points()) {
      text += io::csvRow(std::vector<std::string>{series->name().toStdString(), number(point.x()).toStdString(),
                                                  number(point.y()).toStdString()});
    }
  }
  return QByteArray::fromStdString(text);
}

QByteArray SurveyPanel::csvOfTable() const {
  // In the order they are seen.
  std::vector<std::size_t> order;
  for (int row = 0; row < sorted_->rowCount(); ++row) {
    order.push_back(static_cast<std::size_t>(sorted_->mapToSource(sorted_->index(row, 0)).row()));
  }
  if (places_) {
    analysis::AnatomyResult seen = *places_;
    seen.rows.clear();
    for (const std::size_t row : order) {
      seen.rows.push_back(places_->rows[row]);
    }
    return QByteArray::fromStdString(analysis::anatomyCsv(*run_->study, run_->result, seen));
  }
  std::vector<analysis::Gap> seen;
  for (const std::size_t row : order) {
    seen.push_back(gaps_[row]);
  }
  return QByteArray::fromStdString(analysis::gapsCsv(run_->result, seen));
}

}  // namespace lorica::panels
