#include "marked_slider.h"

#include <QMouseEvent>
#include <QPainter>
#include <QStyleOptionSlider>
#include <cmath>

namespace lorica::panels {

MarkedSlider::MarkedSlider(QWidget* parent) : QSlider(Qt::Horizontal, parent) {}

void MarkedSlider::setMarks(std::vector<double> marks) {
  if (marks != marks_) {
    marks_ = std::move(marks);
    update();
  }
}

QSize MarkedSlider::sizeHint() const {
  return {fontMetrics().averageCharWidth() * 24, QSlider::sizeHint().height() + markHeight()};
}

MarkedSlider::Track MarkedSlider::track() const {
  QStyleOptionSlider option;
  initStyleOption(&option);
  const QRect groove = style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderGroove, this);
  const QRect handle = style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, this);
  return {groove.left() + handle.width() / 2.0, static_cast<double>(groove.width() - handle.width())};
}

void MarkedSlider::paintEvent(QPaintEvent* event) {
  QSlider::paintEvent(event);
  if (maximum() <= minimum()) {
    return;
  }
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(palette().color(isEnabled() ? QPalette::Active : QPalette::Disabled, QPalette::Highlight));
  const Track way = track();
  const double size = markHeight();
  const double bottom = height() - 1.0;
  for (const double mark : marks_) {
    const double x = way.left + way.length * (mark - minimum()) / (maximum() - minimum());
    painter.drawPolygon(QPolygonF({{x, bottom - size}, {x + 0.6 * size, bottom}, {x - 0.6 * size, bottom}}));
  }
}

void MarkedSlider::mousePressEvent(QMouseEvent* event) {
  QStyleOptionSlider option;
  initStyleOption(&option);
  const auto hit = style()->hitTestComplexControl(QStyle::CC_Slider, &option, event->position().toPoint(), this);
  if (event->button() == Qt::LeftButton && hit != QStyle::SC_SliderHandle) {
    const Track way = track();
    setValue(QStyle::sliderValueFromPosition(minimum(), maximum(),
                                             static_cast<int>(std::lround(event->position().x() - way.left)),
                                             static_cast<int>(way.length)));
  }
  QSlider::mousePressEvent(event);
}

}  // namespace lorica::panels
