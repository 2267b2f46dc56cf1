#pragma once

/// \file
/// Tables that go over pages: their heads are repeated, rows are never cut.

#include <QString>
#include <functional>
#include <optional>
#include <vector>

#include "sheet.h"

namespace lorica::report {

struct Cell {
  QString text;
  QString note{};  ///< small, below
  bool bold = false;
  std::optional<QColor> fill{};
  int most = 2;         ///< lines of text
  bool beside = false;  ///< the note stands to the right of the text
};

struct Column {
  double width = 10.0;  ///< mm
  Qt::Alignment alignment = Qt::AlignRight;
};

/// A head over one column or several.
struct Head {
  QString text;
  int span = 1;
};

class Table {
 public:
  /// Draws into the rectangle of the last column.
  using Drawing = std::function<void(const QRectF&)>;

  /// \param heads rows of heads, each over all columns
  Table(Sheet& sheet, std::vector<Column> columns, std::vector<std::vector<Head>> heads);

  /// A numbered caption above the table.
  void setCaption(const QString& text);
  /// What stands in the last line of the head, over the last columns: axes.
  void setHeadDrawing(std::function<void(const std::vector<QRectF>&)> drawing) { headDrawing_ = std::move(drawing); }
  /// Rows are at least so high, mm.
  void setLeastHeight(double height) { least_ = height; }
  /// A row; the drawings are of the last columns.
  void row(const std::vector<Cell>& cells, const std::vector<Drawing>& drawings = {});
  /// A line over all columns that stays with the row below.
  void section(const QString& text);
  /// Rules off. To be called once, at the end.
  void end();

 private:
  void head(bool again);
  double headHeight() const;
  double heightOf(const std::vector<Cell>& cells) const;
  void drawCell(const Cell& cell, const Column& column, const QRectF& box);

  Sheet& sheet_;
  std::vector<Column> columns_;
  std::vector<std::vector<Head>> heads_;
  QString caption_;
  std::function<void(const std::vector<QRectF>&)> headDrawing_;
  QString pending_;  ///< a section that waits for its row
  QString section_;  ///< the one that rows belong to
  double least_ = 0.0;
  bool begun_ = false;
};

}  // namespace lorica::report
