#pragma once

/// \file
/// Pages of a report: A4, lengths in millimetres from the upper left corner, text in points. Content flows from top to
/// bottom; the running header and "n of m" come by themselves.

#include <QPainter>
#include <QPdfWriter>
#include <QString>
#include <QStringList>
#include <memory>

#include "lorica/base/progress.h"

namespace lorica::report {

namespace ink {
inline const QColor text(0x1b, 0x1f, 0x24);
inline const QColor muted(0x5a, 0x63, 0x6e);
inline const QColor rule(0xc6, 0xcc, 0xd3);
inline const QColor faint(0xee, 0xf1, 0xf4);
inline const QColor accent(0x1d, 0x4e, 0x6f);
inline const QColor warning(0x9c, 0x1c, 0x1c);
}  // namespace ink

struct Style {
  double size = 9.0;  ///< pt
  bool bold = false;
  QColor colour = ink::text;
  bool italic = false;
};

namespace styles {
inline const Style title{22.0, true, ink::accent};
inline const Style chapter{15.0, true, ink::accent};
inline const Style section{11.0, true, ink::text};
inline const Style body{9.0};
inline const Style lead{10.5};
inline const Style table{8.0};
inline const Style tableBold{8.0, true};
inline const Style head{7.5, true, ink::muted};
inline const Style note{6.8, false, ink::muted};
inline const Style caption{7.5, false, ink::muted};
}  // namespace styles

/// A chapter or section as the contents list has it.
struct ContentsLine {
  QString text;
  int page = 0;
};

class Sheet {
 public:
  static constexpr double pageWidth = 210.0;
  static constexpr double pageHeight = 297.0;
  static constexpr double left = 18.0;
  static constexpr double width = pageWidth - 2.0 * left;
  static constexpr double right = left + width;
  static constexpr double top = 24.0;
  static constexpr double bottom = 277.0;

  /// Begins the first page, which has no running header.
  /// \param running of the header; \param pages how many there will be, as a draft of the report counted them
  Sheet(QIODevice& out, const QString& title, QString running, int pages, base::Progress progress);
  ~Sheet();
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  /// \throw base::Cancelled
  void newPage();
  int page() const { return page_; }
  double y() const { return y_; }
  void moveTo(double y) { y_ = y; }
  void space(double height) { y_ += height; }
  /// Whether so much fits below.
  bool fits(double height) const { return y_ + height <= bottom; }
  /// Begins a page where it does not.
  void need(double height);

  /// Begins a page and a numbered chapter that the contents list has.
  void chapter(const QString& text);
  /// A heading; stays with `with` millimetres of what follows.
  void section(const QString& text, double with = 25.0);
  /// Text over the whole width, broken over lines and pages.
  void paragraph(const QString& text, const Style& style = styles::body, double spaceAfter = 2.0);
  /// The same with a bullet.
  void bullet(const QString& text, const Style& style = styles::body);
  /// Two columns: a label and a text beside it.
  void fact(const QString& label, const QString& text, double labelWidth = 38.0, double inset = 0.0);

  /// One line in a rectangle; what is too long is cut with an ellipsis.
  void line(const QRectF& box, const QString& text, const Style& style, Qt::Alignment alignment = Qt::AlignLeft);
  /// Lines in a box of this width, at most `most`, the last cut with an ellipsis. \return the height
  double lines(double x, double y, double width, const QString& text, const Style& style, int most,
               Qt::Alignment alignment = Qt::AlignLeft, bool draw = true);
  double textWidth(const QString& text, const Style& style) const;
  static double lineHeight(const Style& style) { return 1.28 * style.size * 25.4 / 72.0; }

  void rule(double x, double y, double length, const QColor& colour = ink::rule, double thickness = 0.2);
  void fill(const QRectF& box, const QColor& colour);
  void picture(const QRectF& box, const QImage& image);

  /// The painter, its unit a hundredth of a millimetre.
  QPainter& painter() { return painter_; }
  static double unit(double mm) { return 100.0 * mm; }
  static QRectF units(const QRectF& mm) { return {unit(mm.x()), unit(mm.y()), unit(mm.width()), unit(mm.height())}; }

  const std::vector<ContentsLine>& contents() const { return contents_; }
  /// How often a figure or table was numbered.
  int nextTable() { return ++tables_; }
  int nextFigure() { return ++figures_; }

  static QFont fontOf(const Style& style);

 private:
  void pageFrame();
  QStringList broken(const QString& text, const Style& style, double width) const;

  QPdfWriter writer_;
  QPainter painter_;
  QString running_;
  int pages_;
  base::Progress progress_;
  int page_ = 1;
  int chapters_ = 0;
  int tables_ = 0;
  int figures_ = 0;
  QString chapter_;
  double y_ = top;
  std::vector<ContentsLine> contents_;
};

}  // namespace lorica::report
