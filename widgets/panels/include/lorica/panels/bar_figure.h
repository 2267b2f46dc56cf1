#pragma once

/// \file
/// Grouped bars, with intervals where they have them, as one chart that can be shown or printed.

#include <QBarCategoryAxis>
#include <QBarSeries>
#include <QChart>
#include <QPalette>
#include <QValueAxis>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lorica/stats/intervals.h"

namespace lorica::panels {

/// One bar: a share that was counted, with its interval, or a number that was measured.
struct FigureBar {
  double value = 0.0;                       ///< in the figure's unit; 0 where there is no value
  std::optional<stats::Interval> interval;  ///< likewise, of a share; none where there is no value
  std::uint64_t hits = 0;                   ///< numerator of a share
  std::uint64_t of = 0;                     ///< denominator of a share
  bool measured = false;                    ///< a number that has no interval

  bool isBlank() const { return !interval && !measured; }
};

struct FigureSeries {
  std::string model;  ///< as files name it
  QColor colour;
  std::vector<FigureBar> bars;  ///< one for each category
};

struct FigureData {
  QString title;
  QString valueTitle;  ///< with its unit
  QString categoryTitle;
  QString blankNote;  ///< what a bar without a value means
  QString countText;  ///< "%1 of %2 body hits": what the numbers of a bar count
  std::vector<std::string> categories;
  std::vector<FigureSeries> series;
  std::optional<double> highest;        ///< end of the value axis; none: what the bars need
  QString unit = QStringLiteral(" %");  ///< as it follows a number
  int decimals = 2;                     ///< of a bar's number
};

/// The colour of an organ model, told apart by the colour-blind and in grey.
QColor modelColour(const std::string& model);

class BarFigure : public QChart {
  Q_OBJECT

 public:
  explicit BarFigure(QGraphicsItem* parent = nullptr);
  ~BarFigure() override;

  void setData(FigureData data);
  const FigureData& data() const { return data_; }
  void setColours(const QColor& background, const QColor& ink);

  const QBarSeries& bars() const { return *bars_; }
  /// Where the interval of a bar is drawn now, in the chart's coordinates: a vertical line, low end first. A point on
  /// the axis where there is no interval.
  QLineF intervalLine(std::size_t series, std::size_t category) const;

 Q_SIGNALS:
  void hovered(const QString& text);
  void picked(const std::string& category);

 protected:
  void resizeEvent(QGraphicsSceneResizeEvent* event) override;

 private:
  class Intervals;

  bool isSmall() const;
  void placeTitles();
  void makeBars();
  void scaleValues();
  void placeLabels();
  double middleOf(std::size_t series, std::size_t category) const;
  double capWidth() const;
  QString describe(std::size_t series, std::size_t category) const;

  FigureData data_;
  QBarSeries* bars_;
  QBarCategoryAxis* categories_;
  QValueAxis* values_;
  Intervals* intervals_;
};

}  // namespace lorica::panels
