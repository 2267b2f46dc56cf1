#include "lorica/panels/survey_panel.h"

#include <QChart>
#include <QChartView>
#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QLabel>
#include <QLineSeries>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <QValueAxis>
#include <algorithm>
#include <array>

#include "flow_layout.h"
#include "lorica/io/export.h"
#include "lorica/models/numbers.h"
#include "panel_parts.h"

namespace lorica::panels {

namespace {

using analysis::ResultRow;

enum What { coverageByDirection, openByDirection, coverageOverTime };
constexpr int progressSteps = 1000;

std::string chosen(const QComboBox& combo) {
  return combo.currentData().toString().toStdString();
}

QStringList listOf(const std::vector<std::string>& names) {
  QStringList list;
  for (const std::string& name : names) {
    list.append(QString::fromStdString(name));
  }
  return list;
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

SurveyPanel::SurveyPanel(QWidget* parent) : QWidget(parent), pages_(new QStackedWidget(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  layout->addWidget(pages_);
  pages_->addWidget(makeEmptyPage(
      tr("Coverage by direction or over a motion is shown here for a run whose study asks for it (Analysis > Shot "
         "lines, Analyses)."),
      this));
  auto* ask = new QWidget(this);
  auto* column = new QVBoxLayout(ask);
  words_ = new QLabel(ask);
  words_->setWordWrap(true);
  words_->setAlignment(Qt::AlignCenter);
  words_->setTextFormat(Qt::PlainText);
  column->addStretch(1);
  column->addWidget(words_);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  column->addStretch(1);
  compute_ = new QPushButton(tr("Compute"), ask);
  compute_->setObjectName(QStringLiteral("survey_compute"));
  progress_ = new QProgressBar(ask);
  progress_->setRange(0, progressSteps);
  progress_->setMaximumWidth(fontMetrics().averageCharWidth() * 40);
  stop_ = new QPushButton(tr("Stop"), ask);
  stop_->setObjectName(QStringLiteral("survey_stop"));
  row->addStretch(1);
  for (QWidget* widget : std::initializer_list<QWidget*>{compute_, progress_, stop_}) {
    row->addWidget(widget);
  }
  row->addStretch(1);
  pages_->addWidget(ask);
  auto* content = new QWidget(this);
  auto* lower = new QVBoxLayout(content);
  lower->setContentsMargins(0, 0, 0, 0);
  lower->setSpacing(panelMargin);
  lower->addWidget(makeControls());
  figures_ = new QStackedWidget(content);
  map_ = new DirectionMap(figures_);
  lines_ = new QChartView(new QChart, figures_);
  lines_->setRenderHint(QPainter::Antialiasing);
  lines_->setMinimumSize(0, 0);
  figures_->addWidget(map_);
  figures_->addWidget(lines_);
  lower->addWidget(figures_, 1);
  worst_ = new QLabel(content);
  worst_->setWordWrap(true);
  worst_->setTextFormat(Qt::PlainText);
  lower->addWidget(worst_);
  pages_->addWidget(content);
  connect(compute_, &QPushButton::clicked, this, &SurveyPanel::compute);
  connect(stop_, &QPushButton::clicked, this, [this] {
    if (job_ != nullptr) {
      job_->cancel();
    }
  });
  refreshPages();
}

SurveyPanel::~SurveyPanel() = default;

QWidget* SurveyPanel::makeControls() {
  auto* bar = new QWidget(this);
  auto* flow = new FlowLayout(bar);
  what_ = makeChoice(tr("What is shown"), this);
  structure_ = makeChoice(tr("Structure"), this);
  system_ = makeChoice(tr("Armor system"), this);
  model_ = makeChoice(tr("Organ model"), this);
  pose_ = makeChoice(tr("Pose"), this);
  source_ = makeChoice(tr("Source of the shots"), this);
  const std::array<std::pair<QComboBox*, const char*>, 6> named{{{what_, "survey_what"},
                                                                 {structure_, "survey_structure"},
                                                                 {system_, "survey_system"},
                                                                 {model_, "survey_model"},
                                                                 {pose_, "survey_pose"},
                                                                 {source_, "survey_source"}}};
  for (const auto& [combo, name] : named) {
    combo->setObjectName(QLatin1String(name));
    flow->addWidget(combo);
    connect(combo, &QComboBox::currentIndexChanged, this, &SurveyPanel::refreshFigure);
  }
  auto* copy = new QToolButton(this);
  copy->setText(tr("Copy as CSV"));
  connect(copy, &QToolButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(QString::fromUtf8(csv())); });
  flow->addWidget(copy);
  return bar;
}

void SurveyPanel::setRun(std::shared_ptr<const document::RunRecord> run) {
  if (run == run_) {
    return;
  }
  jobs::abandon(job_, this);
  run_ = std::move(run);
  survey_.reset();
  trouble_.clear();
  refreshPages();
}

void SurveyPanel::compute() {
  if (run_ == nullptr || !jobs::asksForSurvey(*run_) || job_ != nullptr) {
    return;
  }
  trouble_.clear();
  auto made = std::make_shared<jobs::RunSurvey>();
  job_ = std::make_unique<jobs::Job>(
      tr("Shooting by direction and over the motion"),
      [made, run = run_](const base::Progress& progress) { *made = jobs::surveyOf(run, progress); });
  connect(job_.get(), &jobs::Job::progressed, this,
          [this](double share) { progress_->setValue(static_cast<int>(progressSteps * share)); });
  connect(job_.get(), &jobs::Job::finished, this, [this, made] { survey_ = made; });
  connect(job_.get(), &jobs::Job::failed, this, [this](const QString& text) { trouble_ = text; });
  connect(job_.get(), &jobs::Job::ended, this, [this] {
    job_.release()->deleteLater();
    refreshPages();
  });
  progress_->setValue(0);
  job_->start();
  refreshPages();
}

void SurveyPanel::refreshPages() {
  const bool asks = run_ != nullptr && jobs::asksForSurvey(*run_);
  pages_->setCurrentIndex(!asks ? 0 : survey_ == nullptr ? 1 : 2);
  if (asks && survey_ == nullptr) {
    const study::Analyses& asked = run_->study->study.analyses;
    QStringList parts;
    if (asked.directions) {
      parts.append(tr("coverage in steps of %1°").arg(asked.directions->step));
    }
    if (asked.motion) {
      parts.append(tr("coverage over %1").arg(QString::fromStdString(asked.motion->clip)));
    }
    words_->setText(!trouble_.isEmpty()
                        ? trouble_
                        : tr("%1 asks for %2.").arg(QString::fromStdString(run_->name), parts.join(tr(" and "))));
    compute_->setVisible(job_ == nullptr);
    progress_->setVisible(job_ != nullptr);
    stop_->setVisible(job_ != nullptr);
  }
  if (survey_ != nullptr) {
    refreshChoices();
  }
}

void SurveyPanel::refreshChoices() {
  {
    const std::array quiet{QSignalBlocker(what_),  QSignalBlocker(structure_), QSignalBlocker(system_),
                           QSignalBlocker(model_), QSignalBlocker(pose_),      QSignalBlocker(source_)};
    what_->clear();
    if (!survey_->directions.empty()) {
      what_->addItem(tr("Coverage by direction"), coverageByDirection);
      what_->addItem(tr("Unprotected area by direction"), openByDirection);
    }
    if (!survey_->frames.empty()) {
      what_->addItem(tr("Coverage over time"), coverageOverTime);
    }
    const std::vector<ResultRow>& rows =
        survey_->directions.empty() ? survey_->frames.front().rows : survey_->directions.front().rows;
    std::vector<std::string> structures;
    for (const ResultRow& row : rows) {
      if (row.kind != "armor" && row.structure != "miss" && row.structure != "armor" &&
          std::find(structures.begin(), structures.end(), row.structure) == structures.end()) {
        structures.push_back(row.structure);
      }
    }
    refill(*structure_, listOf(structures));
    const bool first = system_->count() == 0;
    refill(*system_, listOf(run_->result.systems));
    if (first && system_->count() > 1) {
      system_->setCurrentIndex(1);
    }
    std::vector<std::string> models;
    std::vector<std::string> sources;
    for (const viscera::OrganModel model : run_->result.models) {
      models.push_back(viscera::name(model));
    }
    for (const analysis::ShotSource& source : run_->result.sources) {
      sources.push_back(source.source.name);
    }
    refill(*model_, listOf(models));
    refill(*pose_, listOf(run_->result.poses));
    refill(*source_, listOf(sources));
  }
  refreshFigure();
}

bool SurveyPanel::showsMotion() const {
  return what_->currentData().toInt() == coverageOverTime;
}

MapData SurveyPanel::mapData() const {
  MapData made;
  const bool open = what_->currentData().toInt() == openByDirection;
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
  figures_->setCurrentIndex(motion ? 1 : 0);
  pose_->setVisible(!motion && pose_->count() > 1);
  source_->setVisible(motion && source_->count() > 1);
  if (motion) {
    drawLines();
  } else {
    MapData made = mapData();
    worst_->setText(made.markText);
    map_->setData(std::move(made));
  }
}

QByteArray SurveyPanel::csv() const {
  std::string text;
  if (survey_ == nullptr) {
    return {};
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

void SurveyPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && lines_ != nullptr) {
    refreshFigure();
  }
}

}  // namespace lorica::panels
