#include "legend.h"

#include <QLinearGradient>
#include <QPainter>
#include <algorithm>
#include <array>

#include "driver_colours.h"

namespace lorica::viewport {

namespace {

using document::Colouring;
using Entry = LegendText::Entry;

constexpr int margin = 10;
constexpr int barPixels = 190;
constexpr int widest = 440;
const QColor paper(255, 255, 255, 225);
const QColor frameColour(0, 0, 0, 60);
const QColor ink(40, 44, 50);
const QColor paleInk(90, 96, 104);

/// A number without idle digits.
QString plain(double value) {
  return QString::number(value, 'g', 3);
}

}  // namespace

Legend::Legend(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setObjectName(QStringLiteral("legend"));
  hide();
}

void Legend::show(LegendText text) {
  text_ = std::move(text);
  setVisible(!text_.isEmpty());
  resize(sizeHint());
  update();
}

int Legend::lineHeight() const {
  return fontMetrics().height() + 2;
}

int Legend::markWidth() const {
  return 2 * fontMetrics().height();
}

int Legend::width() const {
  int wide = text_.bar ? barPixels + fontMetrics().horizontalAdvance(QStringLiteral("-100")) : 0;
  QFont bold = font();
  bold.setBold(true);
  wide = std::max(wide, QFontMetrics(bold).horizontalAdvance(text_.title));
  for (const Entry& entry : text_.entries) {
    wide = std::max(wide, markWidth() + fontMetrics().horizontalAdvance(entry.text));
  }
  for (const QString& note : text_.notes) {
    wide = std::max(wide, fontMetrics().horizontalAdvance(note));
  }
  if (text_.bar) {
    wide = std::max(
        {wide, fontMetrics().horizontalAdvance(text_.bar->title), fontMetrics().horizontalAdvance(text_.bar->note)});
  }
  // A little more than the text, which else may be wrapped.
  return std::min(wide + 4, widest);
}

QSize Legend::sizeHint() const {
  const int wide = width();
  int high = 2 * margin + (text_.title.isEmpty() ? 0 : lineHeight());
  high += static_cast<int>(text_.entries.size()) * lineHeight();
  for (const QString& note : text_.notes) {
    high += fontMetrics().boundingRect(QRect(0, 0, wide, 10000), Qt::TextWordWrap, note).height();
  }
  if (text_.bar) {
    high += (text_.bar->note.isEmpty() ? 3 : 4) * lineHeight() - 2;
  }
  return {wide + 2 * margin, high};
}

int Legend::paintEntries(QPainter& painter, int y) const {
  for (const Entry& entry : text_.entries) {
    const QRect row(margin, y, width(), lineHeight());
    const QPointF middle(row.left() + 0.4 * markWidth(), row.center().y());
    const double reach = 0.32 * markWidth();
    painter.setPen(Qt::NoPen);
    painter.setBrush(entry.colour);
    switch (entry.mark) {
      case Entry::Mark::line:
        painter.setPen(QPen(entry.colour, 2.0));
        painter.drawLine(middle - QPointF(reach, 0), middle + QPointF(reach, 0));
        break;
      case Entry::Mark::dot:
        painter.drawEllipse(middle, 4.0, 4.0);
        break;
      case Entry::Mark::smallDot:
        painter.drawEllipse(middle, 2.2, 2.2);
        break;
      case Entry::Mark::axes: {
        const std::array<QPointF, 3> ends{QPointF(reach, 2.0), QPointF(0.0, -reach),
                                          QPointF(-0.7 * reach, 0.7 * reach)};
        for (std::size_t axis = 0; axis < ends.size(); ++axis) {
          painter.setPen(QPen(axisColours[axis], 2.0));
          painter.drawLine(middle, middle + ends[axis]);
        }
        break;
      }
    }
    painter.setPen(ink);
    painter.drawText(row.adjusted(markWidth(), 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft, entry.text);
    y += lineHeight();
  }
  return y;
}

void Legend::paintBar(QPainter& painter, int y) const {
  const LegendText::Bar& bar = *text_.bar;
  painter.setPen(ink);
  painter.drawText(QRect(margin, y, width(), lineHeight()), Qt::AlignLeft | Qt::AlignVCenter, bar.title);
  y += lineHeight();
  const int left = margin + fontMetrics().averageCharWidth();
  const QRect strip(left, y, barPixels, lineHeight() - 4);
  const double low = bar.scale.low();
  QLinearGradient colours(strip.topLeft(), strip.topRight());
  constexpr int stops = 64;
  for (int i = 0; i <= stops; ++i) {
    const double share = static_cast<double>(i) / stops;
    colours.setColorAt(share, bar.scale.at(low + (bar.scale.end - low) * share));
  }
  painter.setPen(frameColour);
  painter.setBrush(colours);
  painter.drawRect(strip);
  y += lineHeight() - 2;
  painter.setPen(ink);
  constexpr int steps = 2;
  for (int i = 0; i <= steps; ++i) {
    const double value = bar.unit * (low + (bar.scale.end - low) * i / steps);
    const QString sign = bar.scale.what == Colouring::strain && value > 0.0 ? QStringLiteral("+") : QString();
    const int middle = strip.left() + strip.width() * i / steps;
    painter.drawLine(middle, strip.bottom() + 1, middle, strip.bottom() + 3);
    painter.drawText(QRect(middle - 40, y, 80, lineHeight()), Qt::AlignHCenter | Qt::AlignVCenter, sign + plain(value));
  }
  y += lineHeight();
  painter.setPen(paleInk);
  painter.drawText(QRect(margin, y, width(), lineHeight()), Qt::AlignLeft | Qt::AlignVCenter, bar.note);
}

void Legend::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(frameColour);
  painter.setBrush(paper);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4.0, 4.0);
  int y = margin;
  if (!text_.title.isEmpty()) {
    QFont bold = font();
    bold.setBold(true);
    painter.setFont(bold);
    painter.setPen(ink);
    painter.drawText(QRect(margin, y, width(), lineHeight()), Qt::AlignLeft | Qt::AlignVCenter,
                     QFontMetrics(bold).elidedText(text_.title, Qt::ElideMiddle, width()));
    painter.setFont(font());
    y += lineHeight();
  }
  y = paintEntries(painter, y);
  painter.setPen(paleInk);
  for (const QString& note : text_.notes) {
    const QRect room(margin, y, width(), 10000);
    const int high = fontMetrics().boundingRect(QRect(0, 0, width(), 10000), Qt::TextWordWrap, note).height();
    painter.drawText(room, Qt::TextWordWrap, note);
    y += high;
  }
  if (text_.bar) {
    paintBar(painter, y);
  }
}

}  // namespace lorica::viewport
