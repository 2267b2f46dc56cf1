#pragma once

/// \file
/// Values over azimuth and elevation as a map: azimuth to the right with the front in the middle, elevation upwards.

#include <QImage>
#include <QWidget>
#include <optional>
#include <vector>

namespace lorica::panels {

struct MapCell {
  double azimuth = 0.0;         ///< degrees, of its middle
  double elevation = 0.0;       ///< degrees, of its middle
  std::optional<double> value;  ///< none: nothing is hit from there
  QString tip;
};

struct MapData {
  double step = 30.0;  ///< degrees, of the cells
  std::vector<MapCell> cells;
  double highest = 1.0;             ///< end of the scale, which begins at 0
  QString unit;                     ///< as it follows a number
  QString title;                    ///< of the scale
  std::optional<std::size_t> mark;  ///< the cell that is worst
  QString markText;
};

/// Colour of a share of the scale, 0 to 1: viridis, which grows evenly lighter.
QColor mapColour(double share);

class DirectionMap : public QWidget {
  Q_OBJECT

 public:
  explicit DirectionMap(QWidget* parent = nullptr);
  void setData(MapData data);
  const MapData& data() const { return data_; }
  /// Where a direction is drawn now.
  QPointF placeOf(double azimuth, double elevation) const;
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QRectF plot() const;
  QRectF cellRect(const MapCell& cell) const;
  void paintScale(QPainter& painter) const;
  void paintAxes(QPainter& painter) const;

  MapData data_;
};

}  // namespace lorica::panels
