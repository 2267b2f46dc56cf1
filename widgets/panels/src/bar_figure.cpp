#include "lorica/panels/bar_figure.h"

#include <QBarSet>
#include <QFontMetricsF>
#include <QGraphicsLayout>
#include <QGraphicsSceneResizeEvent>
#include <QLegend>
#include <QPainter>
#include <algorithm>
#include <array>
#include <utility>

#include "lorica/models/model_texts.h"
#include "lorica/models/numbers.h"
#include "panel_parts.h"

namespace lorica::panels {

namespace {

constexpr double groupWidth = 0.72;  ///< of a category's share of the axis
constexpr int longestLabel = 22;     ///< average letters
constexpr int linesOfASmallFigure = 18;
constexpr double valuesShare = 0.5;  ///< of the height of a figure that its bars have at least

/// Of the figure's height, what names that stand may take: QtCharts cuts off what is longer.
constexpr double standingShare = 0.27;

/// Labels of the axis: readable, at most so wide, all different.
QStringList labelsOf(const std::vector<std::string>& names, const QFontMetricsF& metrics, double width) {
  QStringList labels;
  for (const std::string& name : names) {
    const QString whole = QString::fromStdString(name);
    const QString label = metrics.elidedText(QString(whole).replace('_', ' '), Qt::ElideMiddle, width);
    labels.append(labels.contains(label) ? whole : label);
  }
  return labels;
}

}  // namespace

QColor modelColour(const std::string& model) {
  // Of Okabe and Ito's colours; the two that are compared most differ in grey as well.
  static constexpr std::array<std::pair<const char*, QRgb>, 4> colours{{{"static_joint", 0xFF0072B2},
                                                                        {"static_skin", 0xFF56B4E9},
                                                                        {"dynamic_thesis", 0xFFD55E00},
                                                                        {"dynamic", 0xFFE69F00}}};
  for (const auto& [name, colour] : colours) {
    if (model == name) {
      return QColor(colour);
    }
  }
  return QColor(Qt::gray);
}

/// Lines over the bars. It asks the figure where they belong whenever it is drawn, so that they cannot lag behind.
class BarFigure::Intervals : public QGraphicsItem {
 public:
  explicit Intervals(BarFigure& figure) : QGraphicsItem(&figure), figure_(figure) { setZValue(100); }

  void setColours(const QColor& ink, const QColor& halo) {
    ink_ = ink;
    halo_ = halo;
  }
  void follow() {
    prepareGeometryChange();
    update();
  }

  QRectF boundingRect() const override { return figure_.rect(); }
  void paint(QPainter* painter, const QStyleOptionGraphicsItem* /*option*/, QWidget* /*widget*/) override {
    painter->setRenderHint(QPainter::Antialiasing);
    // A halo, so that lines are seen on dark bars too.
    painter->save();
    painter->setClipRect(figure_.plotArea().adjusted(0, 0, 0, -2));  // the axis keeps its line
    painter->setPen(QPen(halo_, 3.5, Qt::SolidLine, Qt::SquareCap));
    paintAll(*painter);
    painter->restore();
    painter->setPen(QPen(ink_, 1.2));
    paintAll(*painter);
  }

 private:
  void paintAll(QPainter& painter) const {
    const FigureData& data = figure_.data();
    for (std::size_t s = 0; s < data.series.size(); ++s) {
      for (std::size_t c = 0; c < data.categories.size(); ++c) {
        paintOne(painter, s, c);
      }
    }
  }

  void paintOne(QPainter& painter, std::size_t series, std::size_t category) const {
    const FigureBar& bar = figure_.data().series[series].bars[category];
    if (bar.measured) {
      return;
    }
    const QLineF line = figure_.intervalLine(series, category);
    const double cap = figure_.capWidth();
    if (bar.interval) {
      painter.drawLine(line);
      for (const QPointF& end : {line.p1(), line.p2()}) {
        painter.drawLine(end - QPointF(cap, 0), end + QPointF(cap, 0));
      }
      return;
    }
    const QPointF middle = line.p1() - QPointF(0, cap + 2);
    painter.drawLine(middle - QPointF(cap, cap), middle + QPointF(cap, cap));
    painter.drawLine(middle - QPointF(cap, -cap), middle + QPointF(cap, -cap));
  }

  BarFigure& figure_;
  QColor ink_ = Qt::black;
  QColor halo_ = Qt::white;
};

BarFigure::BarFigure(QGraphicsItem* parent)
    : QChart(parent),
      bars_(new QBarSeries),
      categories_(new QBarCategoryAxis),
      values_(new QValueAxis),
      intervals_(new Intervals(*this)) {
  setBackgroundRoundness(0);
  setMargins(QMargins(panelMargin, panelMargin, panelMargin, panelMargin));
  layout()->setContentsMargins(0, 0, 0, 0);
  bars_->setBarWidth(groupWidth);
  addSeries(bars_);
  addAxis(categories_, Qt::AlignBottom);
  addAxis(values_, Qt::AlignLeft);
  bars_->attachAxis(categories_);
  bars_->attachAxis(values_);
  categories_->setGridLineVisible(false);
  values_->setLabelFormat(QStringLiteral("%g"));
  categories_->setTruncateLabels(false);
  legend()->setAlignment(Qt::AlignTop);
  connect(this, &QChart::plotAreaChanged, this, [this] { intervals_->follow(); });
  connect(bars_, &QBarSeries::hovered, this, [this](bool inside, int category, QBarSet* set) {
    const auto series = static_cast<std::size_t>(bars_->barSets().indexOf(set));
    Q_EMIT hovered(inside ? describe(series, static_cast<std::size_t>(category)) : QString());
  });
  connect(bars_, &QBarSeries::clicked, this,
          [this](int category, QBarSet*) { Q_EMIT picked(data_.categories.at(static_cast<std::size_t>(category))); });
}

BarFigure::~BarFigure() = default;

void BarFigure::setData(FigureData data) {
  data_ = std::move(data);
  makeBars();
  scaleValues();
  placeTitles();
  intervals_->follow();
}

bool BarFigure::isSmall() const {
  return size().height() < linesOfASmallFigure * QFontMetricsF(values_->labelsFont()).height();
}

/// Where there is little height, titles leave it to the bars: then what is around the figure says what it shows, and
/// the values carry their unit.
void BarFigure::placeTitles() {
  const bool small = isSmall();
  setTitle(small ? QString() : data_.title.toHtmlEscaped());
  // A title that stands beside the values must not be longer than they reach.
  const bool untitled =
      small || QFontMetricsF(values_->titleFont()).horizontalAdvance(data_.valueTitle) > valuesShare * size().height();
  values_->setTitleText(untitled ? QString() : data_.valueTitle);
  values_->setLabelFormat(QStringLiteral("%g") +
                          (untitled ? QString(data_.unit).replace('%', QLatin1String("%%")) : QString()));
  const bool anyBlank = std::any_of(data_.series.begin(), data_.series.end(), [](const FigureSeries& series) {
    return std::any_of(series.bars.begin(), series.bars.end(), [](const FigureBar& bar) { return bar.isBlank(); });
  });
  // The names below the bars speak for themselves; only the mark of a blank needs a word.
  const QString mark = QString(QChar(0xD7)) + " " + data_.blankNote;
  categories_->setTitleText(!anyBlank ? QString() : small ? mark : data_.categoryTitle + " (" + mark + ")");
}

void BarFigure::makeBars() {
  bars_->clear();
  placeLabels();
  for (const FigureSeries& series : data_.series) {
    auto* set = new QBarSet(models::modelFromFile(series.model));
    for (const FigureBar& bar : series.bars) {
      set->append(bar.value);
    }
    set->setColor(series.colour);
    set->setBorderColor(series.colour.darker(130));
    bars_->append(set);
  }
}

void BarFigure::scaleValues() {
  double highest = data_.highest.value_or(0.0);
  double lowest = 0.0;
  if (!data_.highest) {
    for (const FigureSeries& series : data_.series) {
      for (const FigureBar& bar : series.bars) {
        highest = std::max({highest, bar.value, bar.interval ? bar.interval->high : 0.0});
        lowest = std::min(lowest, bar.value);
      }
    }
  }
  values_->setTickCount(6);
  values_->setRange(lowest, highest > lowest ? highest : 1.0);
  if (!data_.highest) {
    values_->applyNiceNumbers();
  }
}

/// Labels lie where there is room for it, else they stand and leave most of the height to the bars.
void BarFigure::placeLabels() {
  QFont font = values_->labelsFont();
  if (isSmall()) {
    font.setPointSizeF(0.85 * font.pointSizeF());
  }
  categories_->setLabelsFont(font);
  const QFontMetricsF metrics(font);
  const double longest = longestLabel * metrics.averageCharWidth();
  QStringList labels = labelsOf(data_.categories, metrics, longest);
  double widest = 0.0;
  for (const QString& label : labels) {
    widest = std::max(widest, metrics.horizontalAdvance(label));
  }
  const double room = 0.85 * size().width() / static_cast<double>(std::max<qsizetype>(1, labels.size()));
  const bool lying = widest + metrics.averageCharWidth() < room;
  if (!lying) {
    labels = labelsOf(data_.categories, metrics, std::min(longest, standingShare * size().height()));
  }
  categories_->setLabelsAngle(lying ? 0 : -90);
  if (labels != categories_->categories()) {
    categories_->setCategories(labels);
  }
}

void BarFigure::resizeEvent(QGraphicsSceneResizeEvent* event) {
  QChart::resizeEvent(event);
  placeTitles();
  placeLabels();
  intervals_->follow();
}

void BarFigure::setColours(const QColor& background, const QColor& ink) {
  QColor grid = ink;
  grid.setAlphaF(0.15F);
  QColor frame = ink;
  frame.setAlphaF(0.5F);
  setBackgroundBrush(background);
  setTitleBrush(ink);
  legend()->setLabelColor(ink);
  for (QAbstractAxis* axis : {static_cast<QAbstractAxis*>(categories_), static_cast<QAbstractAxis*>(values_)}) {
    axis->setLabelsColor(ink);
    axis->setTitleBrush(ink);
    axis->setGridLineColor(grid);
    axis->setLinePenColor(frame);
  }
  QColor halo = background;
  halo.setAlphaF(0.75F);
  intervals_->setColours(ink, halo);
  intervals_->follow();
}

/// The middle of a bar on the axis of categories: groups stand at 0, 1, ... and share their width evenly.
double BarFigure::middleOf(std::size_t series, std::size_t category) const {
  const auto count = static_cast<double>(data_.series.size());
  return static_cast<double>(category) + groupWidth * ((static_cast<double>(series) + 0.5) / count - 0.5);
}

double BarFigure::capWidth() const {
  const double bar = plotArea().width() * groupWidth /
                     static_cast<double>(std::max<std::size_t>(1, data_.categories.size() * data_.series.size()));
  return std::clamp(0.25 * bar, 1.5, 5.0);
}

QLineF BarFigure::intervalLine(std::size_t series, std::size_t category) const {
  const std::optional<stats::Interval>& interval = data_.series.at(series).bars.at(category).interval;
  const double middle = middleOf(series, category);
  // mapToPosition asks for a series that can be changed, and does not change it.
  const auto at = [&](double value) { return const_cast<BarFigure*>(this)->mapToPosition({middle, value}, bars_); };
  return {at(interval ? interval->low : 0.0), at(interval ? interval->high : 0.0)};
}

QString BarFigure::describe(std::size_t series, std::size_t category) const {
  const FigureBar& bar = data_.series.at(series).bars.at(category);
  const QString head = QString::fromStdString(data_.categories.at(category)) + ", " +
                       models::modelFromFile(data_.series.at(series).model);
  if (bar.measured) {
    return head + "\n" + models::fixed(bar.value, data_.decimals) + data_.unit;
  }
  const QString counts = data_.countText.arg(models::grouped(bar.hits), models::grouped(bar.of));
  if (!bar.interval) {
    return head + "\n" + data_.blankNote;
  }
  return head + "\n" +
         tr("%1 %, 95 % interval %2 to %3 %")
             .arg(models::fixed(bar.value, 2), models::fixed(bar.interval->low, 2),
                  models::fixed(bar.interval->high, 2)) +
         "\n" + counts;
}

}  // namespace lorica::panels
