#include "lorica/panels/direction_map.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>

#include "lorica/panels/property_form.h"

namespace lorica::panels {

namespace {

constexpr double leftmost = -180.0;  // the front, azimuth 0, is the middle

/// Azimuth between -180 and 180, so that what is in front is in the middle.
double around(double azimuth) {
  return azimuth - 360.0 * std::floor((azimuth - leftmost) / 360.0);
}

}  // namespace

QColor mapColour(double share) {
  static constexpr std::array<std::array<double, 3>, 5> stops{
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  std::array<int, 3> rgb{};
  for (std::size_t k = 0; k < rgb.size(); ++k) {
    rgb[k] = static_cast<int>(std::lround(std::lerp(stops[low][k], stops[low + 1][k], at - static_cast<double>(low))));
  }
  return {rgb[0], rgb[1], rgb[2]};
}

DirectionMap::DirectionMap(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setMinimumSize(fontMetrics().averageCharWidth() * 30, fontMetrics().height() * 8);
}

void DirectionMap::setData(MapData data) {
  data_ = std::move(data);
  update();
}

QSize DirectionMap::sizeHint() const {
  return {fontMetrics().averageCharWidth() * 80, fontMetrics().height() * 18};
}

QRectF DirectionMap::plot() const {
  const double line = fontMetrics().height();
  const double left = fontMetrics().horizontalAdvance(QStringLiteral("-90°")) + line;
  const double right = fontMetrics().horizontalAdvance(QStringLiteral("0.00000 m²")) + 2.5 * line;
  return QRectF(rect()).adjusted(left, 1.6 * line, -right, -2.6 * line);
}

QPointF DirectionMap::placeOf(double azimuth, double elevation) const {
  const QRectF area = plot();
  // As one sees the person from the front: the left hand is on the right.
  return {area.left() + (around(azimuth) - leftmost) / 360.0 * area.width(),
          area.bottom() - (elevation + 90.0) / 180.0 * area.height()};
}

QRectF DirectionMap::cellRect(const MapCell& cell) const {
  const QPointF middle = placeOf(cell.azimuth, cell.elevation);
  const QSizeF size(plot().width() * data_.step / 360.0, plot().height() * data_.step / 180.0);
  return {middle - QPointF(0.5 * size.width(), 0.5 * size.height()), size};
}

void DirectionMap::paintScale(QPainter& painter) const {
  const QRectF area = plot();
  const double line = fontMetrics().height();
  const QRectF bar(area.right() + line, area.top(), 0.8 * line, area.height());
  for (int y = 0; y < static_cast<int>(bar.height()); ++y) {
    painter.fillRect(QRectF(bar.left(), bar.bottom() - y - 1, bar.width(), 1.0), mapColour(y / bar.height()));
  }
  painter.setPen(palette().color(QPalette::Text));
  for (const double share : {0.0, 0.5, 1.0}) {
    const double y = bar.bottom() - share * bar.height();
    painter.drawText(QRectF(bar.right() + 0.3 * line, y - 0.6 * line, width(), 1.2 * line),
                     Qt::AlignLeft | Qt::AlignVCenter, readable(share * data_.highest, 4) + data_.unit);
  }
  painter.drawText(QRectF(0.0, 0.0, width() - 0.5 * line, 1.4 * line), Qt::AlignRight | Qt::AlignVCenter, data_.title);
}

void DirectionMap::paintAxes(QPainter& painter) const {
  const QRectF area = plot();
  const double line = fontMetrics().height();
  painter.setPen(palette().color(QPalette::Text));
  painter.drawRect(area);
  const struct {
    double azimuth;
    QString text;
  } names[] = {{-180.0, tr("180° back")}, {-90.0, tr("270° right")}, {0.0, tr("0° front")}, {90.0, tr("90° left")}};
  for (const auto& [azimuth, text] : names) {
    const QPointF at = placeOf(azimuth, -90.0);
    painter.drawLine(at, at + QPointF(0.0, 0.3 * line));
    painter.drawText(QRectF(at.x() - 6.0 * line, at.y() + 0.3 * line, 12.0 * line, line), Qt::AlignHCenter, text);
  }
  for (const int elevation : {-90, -45, 0, 45, 90}) {
    const QPointF at(area.left(), placeOf(0.0, elevation).y());
    painter.drawLine(at, at - QPointF(0.3 * line, 0.0));
    painter.drawText(QRectF(0.0, at.y() - 0.6 * line, at.x() - 0.5 * line, 1.2 * line),
                     Qt::AlignRight | Qt::AlignVCenter, QString::number(elevation) + u'°');
  }
  painter.drawText(QRectF(area.left(), area.bottom() + 1.3 * line, area.width(), 1.2 * line), Qt::AlignHCenter,
                   tr("Azimuth, where shots come from"));
  painter.drawText(QRectF(0.0, 0.0, width(), 1.4 * line).adjusted(0.5 * line, 0, 0, 0),
                   Qt::AlignLeft | Qt::AlignVCenter, tr("Elevation"));
}

void DirectionMap::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  painter.save();
  painter.setClipRect(plot());
  const auto paintCell = [&](const MapCell& cell, const QRectF& where) {
    if (cell.value) {
      painter.fillRect(where, mapColour(*cell.value / std::max(data_.highest, 1e-12)));
    } else {
      painter.fillRect(where, palette().color(QPalette::Base));
      painter.fillRect(where, QBrush(palette().color(QPalette::Mid), Qt::BDiagPattern));
    }
  };
  for (const MapCell& cell : data_.cells) {
    const QRectF where = cellRect(cell);
    paintCell(cell, where);
    // The cell behind the person is cut by both edges.
    if (where.left() < plot().left()) {
      paintCell(cell, where.translated(plot().width(), 0.0));
    }
  }
  painter.restore();
  if (data_.mark) {
    const QRectF where = cellRect(data_.cells[*data_.mark]).intersected(plot());
    painter.setPen(QPen(Qt::white, 4.0));
    painter.drawRect(where);
    painter.setPen(QPen(Qt::black, 1.6));
    painter.drawRect(where);
  }
  paintAxes(painter);
  paintScale(painter);
}

bool DirectionMap::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const auto found = std::find_if(data_.cells.begin(), data_.cells.end(), [&](const MapCell& cell) {
      const QRectF where = cellRect(cell);
      return where.contains(help->pos()) || where.translated(plot().width(), 0.0).contains(help->pos());
    });
    if (found != data_.cells.end() && plot().contains(help->pos())) {
      QToolTip::showText(help->globalPos(), found->tip, this);
    } else {
      QToolTip::hideText();
    }
    return true;
  }
  return QWidget::event(event);
}

}  // namespace lorica::panels
