#include "coverage_marks.h"

#include <QCoreApplication>

#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

constexpr double inset = 3.0;  ///< left and right of the axis
constexpr double radius = 0.85;
const QColor grey(0x9a, 0xa3, 0xad);

double placeOf(const QRectF& box, double share) {
  return box.x() + inset + share * (box.width() - 2.0 * inset);
}

void drawMark(Sheet& sheet, QPointF at, Mark mark) {
  QPainter& painter = sheet.painter();
  const QPointF centre(Sheet::unit(at.x()), Sheet::unit(at.y()));
  const double r = Sheet::unit(radius);
  const bool dark = mark == Mark::fullCircle;
  painter.setPen(QPen(dark ? ink::accent : ink::text, Sheet::unit(0.25)));
  painter.setBrush(dark ? ink::accent : mark == Mark::greyDiamond ? grey : QColor(Qt::white));
  switch (mark) {
    case Mark::hollowCircle:
    case Mark::fullCircle:
      painter.drawEllipse(centre, r, r);
      break;
    case Mark::hollowSquare:
      painter.drawRect(QRectF(centre.x() - 0.85 * r, centre.y() - 0.85 * r, 1.7 * r, 1.7 * r));
      break;
    case Mark::greyDiamond:
      painter.drawPolygon(QPolygonF({centre + QPointF(0, -1.25 * r), centre + QPointF(1.25 * r, 0),
                                     centre + QPointF(0, 1.25 * r), centre + QPointF(-1.25 * r, 0)}));
      break;
  }
  painter.setBrush(Qt::NoBrush);
}

}  // namespace

Mark markOf(const std::string& model) {
  return model == "static_joint"     ? Mark::hollowCircle
         : model == "static_skin"    ? Mark::hollowSquare
         : model == "dynamic_thesis" ? Mark::greyDiamond
                                     : Mark::fullCircle;
}

void drawCoverage(Sheet& sheet, const QRectF& box, const std::vector<MarkedCoverage>& marks) {
  QPainter& painter = sheet.painter();
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const double x = placeOf(box, 0.25 * quarter);
    painter.setPen(QPen(quarter % 4 == 0 ? ink::muted : ink::rule, Sheet::unit(quarter % 4 == 0 ? 0.18 : 0.12)));
    painter.drawLine(QPointF(Sheet::unit(x), Sheet::unit(box.top())),
                     QPointF(Sheet::unit(x), Sheet::unit(box.bottom())));
  }
  const double step = (box.height() - 0.6) / static_cast<double>(marks.size());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const auto& [mark, coverage] = marks[i];
    if (!coverage.value) {
      continue;
    }
    const double y = box.y() + 0.3 + (static_cast<double>(i) + 0.5) * step;
    if (coverage.low && coverage.high) {
      painter.setPen(QPen(mark == Mark::fullCircle ? ink::accent : ink::text, Sheet::unit(0.25)));
      const double from = Sheet::unit(placeOf(box, *coverage.low));
      const double to = Sheet::unit(placeOf(box, *coverage.high));
      const double at = Sheet::unit(y);
      const double cap = Sheet::unit(0.55);
      painter.drawLine(QPointF(from, at), QPointF(to, at));
      painter.drawLine(QPointF(from, at - cap), QPointF(from, at + cap));
      painter.drawLine(QPointF(to, at - cap), QPointF(to, at + cap));
    }
    drawMark(sheet, {placeOf(box, *coverage.value), y}, mark);
  }
}

void drawCoverageScale(Sheet& sheet, const QRectF& box) {
  for (const int tick : {0, 50, 100}) {
    const double x = placeOf(box, 0.01 * tick);
    sheet.line({x - 5.0, box.y(), 10.0, box.height()}, QString::number(tick), styles::note, Qt::AlignHCenter);
  }
}

void drawMarkLegend(Sheet& sheet, const std::vector<std::string>& models) {
  constexpr double height = 4.5;
  sheet.need(height);
  double x = Sheet::left;
  for (const std::string& model : models) {
    drawMark(sheet, {x + 1.5, sheet.y() + 0.5 * height}, markOf(model));
    const QString label = modelLabel(model);
    const double width = sheet.textWidth(label, styles::caption) + 1.0;
    sheet.line({x + 4.0, sheet.y(), width, height}, label, styles::caption);
    x += 4.0 + width + 4.0;
  }
  sheet.line({x, sheet.y(), Sheet::right - x, height}, Text::tr("Lines: 95 % intervals. Scale: coverage, %."),
             styles::caption);
  sheet.space(height + 1.0);
}

}  // namespace lorica::report
