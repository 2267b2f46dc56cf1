#include "table.h"

#include <QCoreApplication>

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

constexpr double pad = 1.1;      ///< left and right of a text
constexpr double rowPad = 0.75;  ///< above and below
constexpr double headLine = 4.0;
constexpr double sectionHeight = 5.6;
constexpr double asideWidth = 15.0;  ///< of a note beside its text

}  // namespace

Table::Table(Sheet& sheet, std::vector<Column> columns, std::vector<std::vector<Head>> heads)
    : sheet_(sheet), columns_(std::move(columns)), heads_(std::move(heads)) {}

void Table::setCaption(const QString& text) {
  caption_ = Text::tr("Table %1. %2").arg(sheet_.nextTable()).arg(text);
}

double Table::headHeight() const {
  return headLine * static_cast<double>(heads_.size()) + 1.5;
}

double Table::heightOf(const std::vector<Cell>& cells) const {
  double height = Sheet::lineHeight(styles::table);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Style& style = cells[c].bold ? styles::tableBold : styles::table;
    double here =
        sheet_.lines(0, 0, columns_[c].width - 2.0 * pad, cells[c].text, style, cells[c].most, Qt::AlignLeft, false);
    if (!cells[c].note.isEmpty() && !cells[c].beside) {
      here += Sheet::lineHeight(styles::note);
    }
    height = std::max(height, here);
  }
  return std::max(least_, height + 2.0 * rowPad);
}

void Table::head(bool again) {
  if (!caption_.isEmpty()) {
    const QString text = again ? Text::tr("%1 (continued)").arg(caption_) : caption_;
    sheet_.space(sheet_.lines(Sheet::left, sheet_.y(), Sheet::width, text, styles::caption, 3) + 1.2);
  }
  const double above = sheet_.y();
  sheet_.rule(Sheet::left, above, Sheet::width, ink::text, 0.35);
  double y = above + 0.7;
  for (std::size_t h = 0; h < heads_.size(); ++h) {
    double x = Sheet::left;
    std::size_t column = 0;
    for (const Head& one : heads_[h]) {
      double width = 0.0;
      const Qt::Alignment alignment = one.span > 1 ? Qt::AlignHCenter : columns_[column].alignment;
      for (int i = 0; i < one.span; ++i) {
        width += columns_[column++].width;
      }
      sheet_.line({x + pad, y, width - 2.0 * pad, headLine}, one.text, styles::head, alignment);
      if (one.span > 1 && !one.text.isEmpty()) {
        sheet_.rule(x + pad, y + headLine, width - 2.0 * pad);
      }
      x += width;
    }
    y += headLine;
  }
  y += 0.8;
  if (headDrawing_) {
    std::vector<QRectF> boxes;
    double x = Sheet::left;
    for (const Column& column : columns_) {
      boxes.emplace_back(x, y - headLine - 0.8, column.width, headLine);
      x += column.width;
    }
    headDrawing_(boxes);
  }
  sheet_.rule(Sheet::left, y, Sheet::width, ink::text, 0.2);
  sheet_.moveTo(y);
}

void Table::drawCell(const Cell& cell, const Column& column, const QRectF& box) {
  const Style& style = cell.bold ? styles::tableBold : styles::table;
  const double noteHeight = Sheet::lineHeight(styles::note);
  if (cell.beside) {
    const QRectF note(box.right() - asideWidth, box.y(), asideWidth, Sheet::lineHeight(style));
    sheet_.line({box.x(), box.y(), box.width() - asideWidth, note.height()}, cell.text, style, column.alignment);
    sheet_.line(note, cell.note, styles::note, Qt::AlignRight);
    return;
  }
  const double below = sheet_.lines(box.x(), box.y(), box.width(), cell.text, style, cell.most, column.alignment);
  sheet_.line({box.x(), box.y() + below, box.width(), noteHeight}, cell.note, styles::note, column.alignment);
}

void Table::section(const QString& text) {
  pending_ = text;
  section_ = text;
}

void Table::row(const std::vector<Cell>& cells, const std::vector<Drawing>& drawings) {
  const double height = heightOf(cells);
  const double wanted = height + (pending_.isEmpty() ? 0.0 : sectionHeight);
  if (!begun_) {
    const double caption =
        caption_.isEmpty() ? 0.0 : sheet_.lines(0, 0, Sheet::width, caption_, styles::caption, 3, {}, false) + 1.2;
    sheet_.need(caption + headHeight() + wanted + 2.0 * height);
    head(false);
    begun_ = true;
  } else if (!sheet_.fits(wanted)) {
    sheet_.rule(Sheet::left, sheet_.y(), Sheet::width, ink::text, 0.2);
    sheet_.newPage();
    head(true);
    if (pending_.isEmpty() && !section_.isEmpty()) {
      pending_ = Text::tr("%1 (continued)").arg(section_);
    }
  }
  if (!pending_.isEmpty()) {
    sheet_.fill({Sheet::left, sheet_.y() + 0.1, Sheet::width, sectionHeight - 0.2}, ink::faint);
    sheet_.line({Sheet::left + pad, sheet_.y(), Sheet::width - 2.0 * pad, sectionHeight}, pending_, styles::tableBold);
    sheet_.space(sectionHeight);
    pending_.clear();
  }
  const double y = sheet_.y();
  double x = Sheet::left;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    if (c < cells.size()) {
      const Cell& cell = cells[c];
      if (cell.fill) {
        sheet_.fill({x, y, column.width, height}, *cell.fill);
      }
      drawCell(cell, column, {x + pad, y + rowPad, column.width - 2.0 * pad, height - 2.0 * rowPad});
    }
    if (c + drawings.size() >= columns_.size()) {
      const Drawing& drawing = drawings[c + drawings.size() - columns_.size()];
      if (drawing) {
        drawing({x, y, column.width, height});
      }
    }
    x += column.width;
  }
  sheet_.moveTo(y + height);
  sheet_.rule(Sheet::left, sheet_.y(), Sheet::width, ink::rule, 0.1);
}

void Table::end() {
  if (begun_) {
    sheet_.rule(Sheet::left, sheet_.y(), Sheet::width, ink::text, 0.35);
    sheet_.space(5.0);
  }
}

}  // namespace lorica::report
