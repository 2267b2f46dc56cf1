#pragma once

/// \file
/// Organs of a run as grouped bars, one bar for each organ model, with their 95 % intervals.

#include <QImage>
#include <QWidget>

#include "lorica/document/study_document.h"

class QChartView;
class QComboBox;
class QStackedWidget;

namespace lorica::panels {

class BarFigure;
struct FigureData;

/// What the bars stand for, in percent.
enum class ChartMeasure { ofBodyHits, ofShots, coverage };

class CoverageChart : public QWidget {
  Q_OBJECT

 public:
  explicit CoverageChart(QWidget* parent = nullptr);
  ~CoverageChart() override;

  /// Null: nothing to show.
  void setRun(std::shared_ptr<const document::RunRecord> run);
  const std::shared_ptr<const document::RunRecord>& run() const { return run_; }

  void setMeasure(ChartMeasure measure);
  ChartMeasure measure() const;
  /// Each must be one of the run's; others are ignored.
  void setSource(const std::string& source);
  void setPose(const std::string& pose);
  void setSystem(const std::string& system);

  /// The figure as it is printed: dark on white, whatever the window's colours. \param size in logical pixels
  QImage toImage(const QSize& size, double pixelsPerPoint = 1.0) const;
  /// What is shown, a row for each bar.
  QByteArray csv() const;
  /// The figure on the screen.
  const BarFigure& figure() const { return *figure_; }

 Q_SIGNALS:
  /// A bar was clicked.
  void organPicked(const std::string& organ);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  QWidget* makeControls();
  QWidget* makeFigure();
  void update();
  FigureData data() const;
  void copyCsv() const;
  void copyImage() const;

  std::shared_ptr<const document::RunRecord> run_;
  QStackedWidget* pages_;
  QComboBox* measure_ = nullptr;
  QComboBox* source_ = nullptr;
  QComboBox* pose_ = nullptr;
  QComboBox* system_ = nullptr;
  QChartView* view_ = nullptr;
  BarFigure* figure_ = nullptr;
};

}  // namespace lorica::panels
