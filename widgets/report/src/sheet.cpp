#include "sheet.h"

#include <QCoreApplication>
#include <QTextLayout>

#include "lorica/base/error.h"
#include "lorica/study/provenance.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

constexpr double labelGap = 3.0;

}  // namespace

QFont Sheet::fontOf(const Style& style) {
  QFont font;
  font.setFamilies({QStringLiteral("Liberation Sans"), QStringLiteral("DejaVu Sans")});
  font.setPixelSize(qRound(unit(style.size * 25.4 / 72.0)));
  font.setBold(style.bold);
  font.setItalic(style.italic);
  font.setHintingPreference(QFont::PreferNoHinting);
  return font;
}

Sheet::Sheet(QIODevice& out, const QString& title, QString running, int pages, base::Progress progress)
    : writer_(&out), running_(std::move(running)), pages_(pages), progress_(progress) {
  // One device unit is a hundredth of a millimetre, so fonts and lines need no rounding that shows.
  writer_.setResolution(2540);
  writer_.setPageSize(QPageSize(QPageSize::A4));
  writer_.setPageMargins(QMarginsF());
  writer_.setTitle(title);
  writer_.setCreator(QStringLiteral("Lorica %1").arg(QString::fromStdString(study::version())));
  if (!painter_.begin(&writer_)) {
    throw base::Error("the PDF cannot be drawn");
  }
  painter_.setRenderHint(QPainter::LosslessImageRendering);
  pageFrame();
}

Sheet::~Sheet() {
  painter_.end();
}

void Sheet::pageFrame() {
  const double foot = bottom + 5.0;
  rule(left, foot, width);
  line({left, foot + 1.5, 0.75 * width, 4.0},
       Text::tr("Coverage of the body by armor; nothing here says what a hit does"), styles::caption);
  line({left, foot + 1.5, width, 4.0}, Text::tr("%1 of %2").arg(page_).arg(pages_), styles::caption, Qt::AlignRight);
  if (page_ > 1) {
    line({left, 12.0, 0.6 * width, 4.0}, running_, styles::caption);
    line({left + 0.6 * width, 12.0, 0.4 * width, 4.0}, chapter_, styles::caption, Qt::AlignRight);
    rule(left, 17.0, width);
  }
}

void Sheet::newPage() {
  progress_.check();
  writer_.newPage();
  ++page_;
  y_ = top;
  pageFrame();
  progress_.report(std::min(1.0, static_cast<double>(page_) / std::max(1, pages_)));
}

void Sheet::need(double height) {
  // What never fits begins at the top of a page all the same.
  if (!fits(height) && y_ > top) {
    newPage();
  }
}

void Sheet::chapter(const QString& text) {
  ++chapters_;
  chapter_ = text;
  newPage();
  const QString numbered = QStringLiteral("%1  %2").arg(chapters_).arg(text);
  contents_.push_back({numbered, page_});
  line({left, y_, width, 8.0}, numbered, styles::chapter);
  y_ += 11.0;
}

void Sheet::section(const QString& text, double with) {
  need(8.0 + with);
  if (y_ > top) {
    y_ += 3.0;
  }
  y_ += lines(left, y_, width, text, styles::section, 2) + 1.5;
}

QStringList Sheet::broken(const QString& text, const Style& style, double boxWidth) const {
  QStringList all;
  for (const QString& part : text.split(u'\n')) {
    if (part.isEmpty()) {
      all.push_back({});
      continue;
    }
    QTextLayout layout(part, fontOf(style));
    QTextOption option;
    option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
    layout.setTextOption(option);
    layout.beginLayout();
    for (QTextLine next = layout.createLine(); next.isValid(); next = layout.createLine()) {
      next.setLineWidth(unit(boxWidth));
      all.push_back(part.mid(next.textStart(), next.textLength()).trimmed());
    }
    layout.endLayout();
  }
  return all;
}

void Sheet::paragraph(const QString& text, const Style& style, double spaceAfter) {
  const double height = lineHeight(style);
  const QStringList all = broken(text, style, width);
  // No single line of a paragraph at the foot of a page.
  need(std::min<double>(2.0, static_cast<double>(all.size())) * height);
  for (const QString& one : all) {
    need(height);
    line({left, y_, width, height}, one, style);
    y_ += height;
  }
  y_ += spaceAfter;
}

void Sheet::bullet(const QString& text, const Style& style) {
  constexpr double indent = 4.0;
  const double height = lineHeight(style);
  const QStringList all = broken(text, style, width - indent);
  need(static_cast<double>(all.size()) * height);
  line({left, y_, indent, height}, QStringLiteral("\u2022"), style);
  for (const QString& one : all) {
    line({left + indent, y_, width - indent, height}, one, style);
    y_ += height;
  }
  y_ += 1.2;
}

void Sheet::fact(const QString& label, const QString& text, double labelWidth, double inset) {
  const Style& style = styles::body;
  const double height = lineHeight(style);
  const QStringList all = broken(text, style, width - inset - labelWidth - labelGap);
  need(std::min(static_cast<double>(all.size()), 3.0) * height);
  line({left, y_, labelWidth, height}, label, {style.size, false, ink::muted});
  for (const QString& one : all) {
    need(height);
    line({left + labelWidth + labelGap, y_, width - inset - labelWidth - labelGap, height}, one, style);
    y_ += height;
  }
  y_ += 1.0;
}

double Sheet::textWidth(const QString& text, const Style& style) const {
  return QFontMetricsF(fontOf(style)).horizontalAdvance(text) / unit(1.0);
}

void Sheet::line(const QRectF& box, const QString& text, const Style& style, Qt::Alignment alignment) {
  if (text.isEmpty()) {
    return;
  }
  const QFont font = fontOf(style);
  const QFontMetricsF metrics(font);
  // A hair's breadth of grace: a text that was measured to fit must not be cut for rounding.
  const QString shown = metrics.elidedText(text, Qt::ElideRight, unit(box.width()) + 2.0);
  const double advance = metrics.horizontalAdvance(shown);
  double x = unit(box.x());
  if (alignment & Qt::AlignRight) {
    x = unit(box.right()) - advance;
  } else if (alignment & Qt::AlignHCenter) {
    x = unit(box.center().x()) - 0.5 * advance;
  }
  const double baseline =
      unit(box.y()) + 0.5 * (unit(box.height()) - metrics.ascent() - metrics.descent()) + metrics.ascent();
  painter_.setFont(font);
  painter_.setPen(style.colour);
  painter_.drawText(QPointF(x, baseline), shown);
}

double Sheet::lines(double x, double y, double boxWidth, const QString& text, const Style& style, int most,
                    Qt::Alignment alignment, bool draw) {
  QStringList all = broken(text, style, boxWidth);
  if (all.size() > most) {
    // The last line that is shown takes the rest, and is cut where that ends.
    const QString rest = all.mid(most - 1).join(u' ');
    all = all.mid(0, most - 1);
    all.push_back(rest);
  }
  const double height = lineHeight(style);
  for (qsizetype i = 0; draw && i < all.size(); ++i) {
    line({x, y + static_cast<double>(i) * height, boxWidth, height}, all[i], style, alignment);
  }
  return static_cast<double>(all.size()) * height;
}

void Sheet::rule(double x, double y, double length, const QColor& colour, double thickness) {
  painter_.setPen(QPen(colour, unit(thickness), Qt::SolidLine, Qt::FlatCap));
  painter_.drawLine(QPointF(unit(x), unit(y)), QPointF(unit(x + length), unit(y)));
}

void Sheet::fill(const QRectF& box, const QColor& colour) {
  painter_.fillRect(units(box), colour);
}

void Sheet::picture(const QRectF& box, const QImage& image) {
  painter_.drawImage(units(box), image);
}

}  // namespace lorica::report
