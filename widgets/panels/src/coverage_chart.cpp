#include "lorica/panels/coverage_chart.h"

#include <QApplication>
#include <QChartView>
#include <QClipboard>
#include <QComboBox>
#include <QEvent>
#include <QMenu>
#include <QPainter>
#include <QStackedWidget>
#include <QToolButton>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "flow_layout.h"
#include "lorica/io/export.h"
#include "lorica/panels/bar_figure.h"
#include "panel_parts.h"

namespace lorica::panels {

namespace {

using analysis::ResultRow;

std::string chosen(const QComboBox& combo) {
  return combo.currentData().toString().toStdString();
}

void choose(QComboBox& combo, const std::string& text) {
  const int index = combo.findData(QString::fromStdString(text));
  if (index >= 0) {
    combo.setCurrentIndex(index);
  }
}

stats::Interval percent(const stats::Interval& share) {
  return {100.0 * share.low, 100.0 * share.high};
}

FigureBar barOf(const ResultRow& row, ChartMeasure measure) {
  FigureBar bar;
  switch (measure) {
    case ChartMeasure::ofBodyHits:
      bar.hits = row.count.withBody;
      bar.of = row.bodyHits;
      break;
    case ChartMeasure::ofShots:
      bar.hits = row.count.any;
      bar.of = row.shots;
      break;
    case ChartMeasure::coverage:
      bar.hits = row.count.shielded;
      bar.of = row.count.any;
      break;
  }
  if (bar.of > 0) {
    bar.value = 100.0 * static_cast<double>(bar.hits) / static_cast<double>(bar.of);
    bar.interval =
        percent(measure == ChartMeasure::coverage ? row.coverageInterval().value() : stats::wilson(bar.hits, bar.of));
  }
  return bar;
}

template <class Names>
QStringList listOf(const Names& names) {
  QStringList list;
  for (const auto& name : names) {
    list.append(QString::fromStdString(name));
  }
  return list;
}

std::string number(double value) {
  return QString::number(value, 'f', 6).toStdString();
}

}  // namespace

CoverageChart::CoverageChart(QWidget* parent) : QWidget(parent), pages_(new QStackedWidget(this)) {
  auto* content = new QWidget(this);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(panelMargin);
  column->addWidget(makeControls());
  column->addWidget(makeFigure(), 1);
  pages_->addWidget(makeEmptyPage(tr("No run yet. The chart shows the organs of a run."), this));
  pages_->addWidget(makeEmptyPage(tr("This run has no organ to show."), this));
  pages_->addWidget(content);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  layout->addWidget(pages_);
}

CoverageChart::~CoverageChart() = default;

QWidget* CoverageChart::makeControls() {
  auto* row = new QWidget(this);
  auto* flow = new FlowLayout(row);
  measure_ = makeChoice(tr("What the bars show"), this);
  measure_->addItem(tr("Hit, % of body hits"), static_cast<int>(ChartMeasure::ofBodyHits));
  measure_->addItem(tr("Hit, % of shots"), static_cast<int>(ChartMeasure::ofShots));
  measure_->addItem(tr("Coverage, %"), static_cast<int>(ChartMeasure::coverage));
  source_ = makeChoice(tr("Source of the shots"), this);
  pose_ = makeChoice(tr("Pose"), this);
  system_ = makeChoice(tr("Armor system"), this);
  for (QComboBox* combo : {measure_, source_, pose_, system_}) {
    flow->addWidget(combo);
    connect(combo, &QComboBox::currentIndexChanged, this, &CoverageChart::update);
  }
  auto* copy = new QToolButton(this);
  copy->setText(tr("Copy"));
  copy->setToolTip(tr("Copy the chart"));
  copy->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(copy);
  menu->addAction(tr("As a picture, dark on white"), this, &CoverageChart::copyImage);
  menu->addAction(tr("Numbers of the bars as CSV"), this, &CoverageChart::copyCsv);
  copy->setMenu(menu);
  flow->addWidget(copy);
  return row;
}

QWidget* CoverageChart::makeFigure() {
  figure_ = new BarFigure;
  view_ = new QChartView(figure_, this);
  view_->setRenderHint(QPainter::Antialiasing);
  view_->setFrameShape(QFrame::StyledPanel);
  view_->setMinimumSize(0, 0);
  connect(figure_, &BarFigure::hovered, this, [this](const QString& text) {
    if (text.isEmpty()) {
      QToolTip::hideText();
    } else {
      QToolTip::showText(QCursor::pos(), text, view_);
    }
  });
  connect(figure_, &BarFigure::picked, this, &CoverageChart::organPicked);
  figure_->setColours(palette().color(QPalette::Base), palette().color(QPalette::Text));
  return view_;
}

void CoverageChart::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && figure_ != nullptr) {
    figure_->setColours(palette().color(QPalette::Base), palette().color(QPalette::Text));
  }
}

void CoverageChart::setRun(std::shared_ptr<const document::RunRecord> run) {
  const bool first = run_ == nullptr;
  run_ = std::move(run);
  if (run_ == nullptr) {
    update();
    return;
  }
  std::vector<std::string> sources;
  for (const analysis::ShotSource& source : run_->result.sources) {
    sources.push_back(source.source.name);
  }
  refill(*source_, listOf(sources));
  source_->setVisible(sources.size() > 1);
  refill(*pose_, listOf(run_->result.poses));
  refill(*system_, listOf(run_->result.systems));
  if (first && run_->result.systems.size() > 1) {
    // Unarmored comes first, and its coverage is nothing to look at.
    choose(*system_, run_->result.systems[1]);
  }
  update();
}

void CoverageChart::setMeasure(ChartMeasure measure) {
  measure_->setCurrentIndex(measure_->findData(static_cast<int>(measure)));
}

ChartMeasure CoverageChart::measure() const {
  return static_cast<ChartMeasure>(measure_->currentData().toInt());
}

void CoverageChart::setSource(const std::string& source) {
  choose(*source_, source);
}
void CoverageChart::setPose(const std::string& pose) {
  choose(*pose_, pose);
}
void CoverageChart::setSystem(const std::string& system) {
  choose(*system_, system);
}

void CoverageChart::update() {
  FigureData shown = data();
  pages_->setCurrentIndex(run_ == nullptr ? 0 : shown.series.empty() ? 1 : 2);
  figure_->setData(std::move(shown));
}

FigureData CoverageChart::data() const {
  FigureData data;
  if (run_ == nullptr) {
    return data;
  }
  const ChartMeasure what = measure();
  for (const ResultRow& row : run_->summary) {
    if (row.kind != "organ" || row.source != chosen(*source_) || row.pose != chosen(*pose_) ||
        row.system != chosen(*system_)) {
      continue;
    }
    if (data.series.empty() || data.series.back().model != row.model) {
      data.series.push_back({row.model, modelColour(row.model), {}});
    }
    if (data.series.size() == 1) {
      data.categories.push_back(row.structure);
    }
    data.series.back().bars.push_back(barOf(row, what));
  }
  const auto text = [](const QComboBox& combo) { return combo.currentData().toString(); };
  data.title = tr("Pose %1, system %2, shots from %3").arg(text(*pose_), text(*system_), text(*source_));
  if (run_->result.partial) {
    data.title = tr("Partial run. %1").arg(data.title);
  }
  data.categoryTitle = tr("Organ");
  switch (what) {
    case ChartMeasure::ofBodyHits:
      data.valueTitle = tr("Hit (% of body hits)");
      data.countText = tr("%1 of %2 body hits");
      data.blankNote = tr("no shot hit the body");
      break;
    case ChartMeasure::ofShots:
      data.valueTitle = tr("Hit (% of shots)");
      data.countText = tr("%1 of %2 shots");
      data.blankNote = tr("no shot");
      break;
    case ChartMeasure::coverage:
      data.valueTitle = tr("Coverage (% of hits)");
      data.countText = tr("%1 of %2 hits met armor first");
      data.blankNote = tr("not hit, no coverage");
      data.highest = 100.0;
      break;
  }
  return data;
}

QImage CoverageChart::toImage(const QSize& size, double pixelsPerPoint) const {
  // A view of its own: what is on the screen keeps its size and colours.
  auto* figure = new BarFigure;
  QChartView view(figure);
  view.setFrameShape(QFrame::NoFrame);
  view.setRenderHint(QPainter::Antialiasing);
  view.resize(size);
  figure->setColours(Qt::white, Qt::black);
  figure->setData(figure_->data());
  view.grab();  // lays it out
  QImage image((QSizeF(size) * pixelsPerPoint).toSize(), QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::white);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  view.render(&painter, QRectF(QPointF(), QSizeF(image.size())), view.viewport()->rect());
  return image;
}

QByteArray CoverageChart::csv() const {
  const auto line = [](const std::vector<std::string>& fields) { return io::csvRow(fields); };
  std::string text =
      line({"source", "system", "pose", "organ", "model", "measure", "count", "of", "pct", "pct_lo", "pct_hi"});
  static constexpr std::array<const char*, 3> measures{"hit_of_body_hits", "hit_of_shots", "coverage"};
  const FigureData& shown = figure_->data();
  for (std::size_t c = 0; c < shown.categories.size(); ++c) {
    for (const FigureSeries& series : shown.series) {
      const FigureBar& bar = series.bars[c];
      const bool any = bar.interval.has_value();
      text += line({chosen(*source_), chosen(*system_), chosen(*pose_), shown.categories[c], series.model,
                    measures.at(static_cast<std::size_t>(measure())), std::to_string(bar.hits), std::to_string(bar.of),
                    any ? number(bar.value) : "", any ? number(bar.interval->low) : "",
                    any ? number(bar.interval->high) : ""});
    }
  }
  return QByteArray::fromStdString(text);
}

void CoverageChart::copyCsv() const {
  QApplication::clipboard()->setText(QString::fromUtf8(csv()));
}

void CoverageChart::copyImage() const {
  // Large enough for its titles: a picture has to say by itself what it shows.
  QApplication::clipboard()->setImage(toImage(view_->size().expandedTo({900, 500}), 2.0));
}

}  // namespace lorica::panels
