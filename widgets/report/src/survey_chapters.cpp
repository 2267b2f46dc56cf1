#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "chapters.h"
#include "table.h"
#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

// --- over a motion ---------------------------------------------------------------------------------------------------

struct Course {
  QString label;
  QColor colour;
  Qt::PenStyle pen = Qt::SolidLine;
  std::vector<std::pair<double, analysis::Coverage>> points;  ///< seconds, coverage
};

const std::array<QColor, 4> courseColours{QColor(0x1d, 0x4e, 0x6f), QColor(0xc8, 0x6a, 0x1e), QColor(0x2e, 0x8b, 0x62),
                                          QColor(0x8a, 0x4f, 0x8f)};

std::vector<Course> coursesOf(const Report& report, const std::string& source, const StructureKey& total) {
  const RunView& view = report.view;
  std::vector<Course> courses;
  for (std::size_t s = 0; s < view.armored.size(); ++s) {
    for (const std::string& model : view.shownModels) {
      Course course{Text::tr("%1, %2").arg(text(view.armored[s]), modelLabel(model)),
                    courseColours[s % courseColours.size()],
                    view.rigid == model && view.deforming ? Qt::DashLine : Qt::SolidLine,
                    {}};
      for (const analysis::MotionRow& row : report.run.motion) {
        if (row.place.source == source && row.place.system == view.armored[s] && row.place.model == model &&
            row.kind == total.kind && row.structure == total.structure) {
          course.points.emplace_back(row.seconds, row.coverage);
        }
      }
      courses.push_back(std::move(course));
    }
  }
  return courses;
}

/// Axes with a grid: share upwards, seconds to the right.
class MotionPlot {
 public:
  MotionPlot(Sheet& sheet, const QRectF& box, double seconds)
      : sheet_(sheet),
        plot_(box.x() + 9.0, box.y() + 2.0, box.width() - 12.0, box.height() - 10.0),
        seconds_(seconds) {}

  void axes() {
    for (int tick = 0; tick <= 100; tick += 25) {
      const double y = at(0.0, 0.01 * tick).y();
      sheet_.rule(plot_.x(), y, plot_.width(), tick == 0 ? ink::muted : ink::rule, tick == 0 ? 0.2 : 0.12);
      sheet_.line({plot_.x() - 9.0, y - 1.8, 8.0, 3.6}, QString::number(tick), styles::note, Qt::AlignRight);
    }
    for (int tick = 0; tick <= 4; ++tick) {
      const double time = 0.25 * tick * seconds_;
      sheet_.line({at(time, 0.0).x() - 6.0, plot_.bottom() + 0.6, 12.0, 3.6}, number(time, 2), styles::note,
                  Qt::AlignHCenter);
    }
    sheet_.line({plot_.x(), plot_.bottom() + 4.0, plot_.width(), 3.6}, Text::tr("seconds"), styles::note,
                Qt::AlignHCenter);
  }

  void draw(const Course& course) {
    QPainter& painter = sheet_.painter();
    QPolygonF line;
    QPolygonF upper;
    QPolygonF lower;
    for (const auto& [time, coverage] : course.points) {
      if (coverage.value) {
        line.push_back(units(time, *coverage.value));
        upper.push_back(units(time, coverage.high.value_or(*coverage.value)));
        lower.push_front(units(time, coverage.low.value_or(*coverage.value)));
      }
    }
    QColor band = course.colour;
    band.setAlpha(40);
    painter.setPen(Qt::NoPen);
    painter.setBrush(band);
    painter.drawPolygon(upper + lower);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(course.colour, Sheet::unit(0.45), course.pen, Qt::FlatCap, Qt::RoundJoin));
    painter.drawPolyline(line);
  }

 private:
  QPointF at(double time, double share) const {
    return {plot_.x() + (seconds_ > 0.0 ? time / seconds_ : 0.0) * plot_.width(),
            plot_.bottom() - share * plot_.height()};
  }
  QPointF units(double time, double share) const { return 100.0 * at(time, share); }

  Sheet& sheet_;
  QRectF plot_;
  double seconds_;
};

void drawCourseLegend(Sheet& sheet, const std::vector<Course>& courses) {
  double x = Sheet::left;
  for (const Course& course : courses) {
    const double width = sheet.textWidth(course.label, styles::caption) + 1.0;
    if (x + 10.0 + width > Sheet::right && x > Sheet::left) {
      x = Sheet::left;
      sheet.space(4.5);
    }
    sheet.painter().setPen(QPen(course.colour, Sheet::unit(0.5), course.pen, Qt::FlatCap));
    const double y = Sheet::unit(sheet.y() + 2.25);
    sheet.painter().drawLine(QPointF(Sheet::unit(x), y), QPointF(Sheet::unit(x + 7.0), y));
    sheet.line({x + 8.5, sheet.y(), std::min(width, Sheet::right - x - 8.5), 4.5}, course.label, styles::caption);
    x += 8.5 + width + 4.0;
  }
  sheet.space(5.5);
}

void writeMotionTable(const Report& report, const std::string& source) {
  const RunView& view = report.view;
  Table table(report.sheet,
              {{44.0, Qt::AlignLeft}, {38.0, Qt::AlignLeft}, {38.0, Qt::AlignLeft}, {18.0}, {18.0}, {18.0}},
              {{{Text::tr("Structure")},
                {Text::tr("System")},
                {Text::tr("Model")},
                {Text::tr("Mean, %")},
                {Text::tr("Lowest, %")},
                {Text::tr("at, s")}}});
  table.setCaption(
      Text::tr("Coverage over the motion from source %1: mean over time and the worst moment.").arg(text(source)));
  for (const StructureKey& total : view.totals) {
    for (const analysis::MotionSummaryRow& row : report.run.motionSummary) {
      const bool shown =
          std::find(view.shownModels.begin(), view.shownModels.end(), row.place.model) != view.shownModels.end();
      const bool armored = std::find(view.armored.begin(), view.armored.end(), row.place.system) != view.armored.end();
      if (row.place.source == source && row.kind == total.kind && row.structure == total.structure && shown &&
          armored) {
        table.row({{structureLabel(row.structure, row.kind)},
                   {text(row.place.system)},
                   {modelLabel(row.place.model)},
                   {percent(row.mean)},
                   {percent(row.lowest)},
                   {number(row.worstSeconds, 2)}});
      }
    }
  }
  table.end();
}

// --- by direction ----------------------------------------------------------------------------------------------------

/// Light to dark with coverage, so that it reads in grey too.
QColor shadeOf(double share) {
  const QColor from(0xf4, 0xf1, 0xe8);
  const QColor to(0x16, 0x3f, 0x5c);
  const auto mix = [&](int a, int b) { return static_cast<int>(std::lround(a + share * (b - a))); };
  return {mix(from.red(), to.red()), mix(from.green(), to.green()), mix(from.blue(), to.blue())};
}

using DirectionRows = std::vector<const analysis::DirectionRow*>;

void drawMap(Sheet& sheet, const QRectF& box, const QString& title, const DirectionRows& rows) {
  std::vector<double> azimuths;
  std::vector<double> elevations;
  for (const analysis::DirectionRow* row : rows) {
    azimuths.push_back(row->azimuth);
    elevations.push_back(row->elevation);
  }
  const auto unique = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  unique(azimuths);
  unique(elevations);
  const auto placeOf = [](const std::vector<double>& values, double value) {
    return static_cast<double>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
  };
  sheet.line({box.x(), box.y(), box.width(), 4.5}, title, styles::tableBold);
  const QRectF plot(box.x() + 8.0, box.y() + 5.0, box.width() - 9.0, box.height() - 13.0);
  const double width = plot.width() / static_cast<double>(azimuths.size());
  const double height = plot.height() / static_cast<double>(elevations.size());
  const bool numbers = width > 4.5 && height > 3.0;
  for (const analysis::DirectionRow* row : rows) {
    const QRectF cell(plot.x() + placeOf(azimuths, row->azimuth) * width,
                      plot.bottom() - (placeOf(elevations, row->elevation) + 1.0) * height, width, height);
    const bool known = row->coverage.value.has_value();
    sheet.fill(cell, known ? shadeOf(*row->coverage.value) : QColor(Qt::white));
    if (numbers) {
      const QColor ink = known && *row->coverage.value > 0.5 ? QColor(Qt::white) : ink::text;
      sheet.line(cell, known ? number(100.0 * *row->coverage.value, 0) : QStringLiteral("\u2013"), {6.3, false, ink},
                 Qt::AlignHCenter);
    }
    if (row->lowest) {
      sheet.painter().setPen(QPen(ink::warning, Sheet::unit(0.5)));
      sheet.painter().drawRect(Sheet::units(cell.adjusted(0.25, 0.25, -0.25, -0.25)));
    }
  }
  sheet.painter().setPen(QPen(ink::muted, Sheet::unit(0.15)));
  sheet.painter().drawRect(Sheet::units(plot));
  // Every second label where they would touch.
  const std::size_t every = width > 5.5 ? 1 : width > 2.7 ? 3 : 6;
  for (std::size_t a = 0; a < azimuths.size(); a += every) {
    sheet.line({plot.x() + static_cast<double>(a) * width - 3.0, plot.bottom() + 0.4, width + 6.0, 3.4},
               number(azimuths[a], 0), styles::note, Qt::AlignHCenter);
  }
  const std::size_t everyRow = height > 3.2 ? 1 : 2;
  for (std::size_t e = 0; e < elevations.size(); e += everyRow) {
    sheet.line({box.x(), plot.bottom() - (static_cast<double>(e) + 0.5) * height - 1.7, 7.0, 3.4},
               number(elevations[e], 0), styles::note, Qt::AlignRight);
  }
  sheet.line({plot.x(), plot.bottom() + 3.6, plot.width(), 3.4}, Text::tr("azimuth, \u00b0 (elevation upwards)"),
             styles::note, Qt::AlignHCenter);
}

/// Azimuth and elevation in whole degrees; 359.9 reads as 0.
QString direction(const analysis::GapRow& row) {
  const auto whole = [](std::optional<double> degrees) {
    return degrees ? std::optional(std::fmod(std::round(*degrees), 360.0)) : std::nullopt;
  };
  return QStringLiteral("%1, %2").arg(number(whole(row.azimuth), 0), number(whole(row.elevation), 0));
}

}  // namespace

void writeMotion(const Report& report) {
  if (report.run.motion.empty() || report.view.armored.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  const RunView& view = report.view;
  sheet.chapter(Text::tr("Coverage over the motion"));
  double seconds = 0.0;
  for (const analysis::MotionRow& row : report.run.motion) {
    seconds = std::max(seconds, row.seconds);
  }
  const std::vector<StructureKey> totals =
      view.totals.empty() ? std::vector<StructureKey>{{"body", "body"}} : view.totals;
  constexpr double height = 50.0;
  for (const std::string& source : view.sources) {
    sheet.need(height + 20.0);
    sheet.line({Sheet::left, sheet.y(), Sheet::width, 4.5},
               Text::tr("Figure %1. Coverage over the motion from source %2, %; bands: 95 % intervals.")
                   .arg(QString::number(sheet.nextFigure()), text(source)),
               styles::caption);
    sheet.space(5.0);
    const std::vector<Course> first = coursesOf(report, source, totals.front());
    drawCourseLegend(sheet, first);
    for (const StructureKey& total : totals) {
      sheet.need(height + 5.0);
      sheet.line({Sheet::left, sheet.y(), Sheet::width, 4.5}, structureLabel(total.structure, total.kind),
                 styles::tableBold);
      MotionPlot plot(sheet, {Sheet::left, sheet.y() + 4.5, Sheet::width, height}, seconds);
      plot.axes();
      for (const Course& course : coursesOf(report, source, total)) {
        plot.draw(course);
      }
      sheet.space(height + 5.0);
    }
    writeMotionTable(report, source);
  }
}

void writeDirections(const Report& report) {
  if (report.run.directions.empty() || report.view.armored.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  const RunView& view = report.view;
  sheet.chapter(Text::tr("Coverage by direction"));
  sheet.paragraph(
      Text::tr("Each cell is a parallel beam from where it stands on the map: azimuth 0\u00b0 is ahead of the "
               "person, 90\u00b0 on its left, 180\u00b0 behind; elevation 90\u00b0 is above. Numbers are "
               "coverage in per cent, darker is more; a frame marks the direction of lowest coverage, a dash "
               "that nothing was hit. Organs follow the model %1.")
          .arg(modelLabel(view.mainModel())));
  const std::vector<StructureKey> totals =
      view.totals.empty() ? std::vector<StructureKey>{{"body", "body"}} : view.totals;
  constexpr double gutter = 6.0;
  constexpr double width = 0.5 * (Sheet::width - gutter);
  constexpr double height = 50.0;
  for (const StructureKey& total : totals) {
    sheet.section(structureLabel(total.structure, total.kind), height);
    int column = 0;
    for (const std::string& pose : report.run.facts.poses) {
      for (const std::string& system : view.armored) {
        DirectionRows rows;
        for (const analysis::DirectionRow& row : report.run.directions) {
          if (row.place.system == system && row.place.pose == pose && row.place.model == view.mainModel() &&
              row.kind == total.kind && row.structure == total.structure) {
            rows.push_back(&row);
          }
        }
        if (rows.empty()) {
          continue;
        }
        if (column == 0) {
          sheet.need(height);
        }
        drawMap(sheet, {Sheet::left + column * (width + gutter), sheet.y(), width, height},
                Text::tr("%1, %2").arg(text(pose), text(system)), rows);
        column = 1 - column;
        if (column == 0) {
          sheet.space(height + 2.0);
        }
      }
    }
    if (column == 1) {
      sheet.space(height + 2.0);
    }
  }
}

void writeGaps(const Report& report) {
  const RunView& view = report.view;
  const auto& present = report.run.present;
  if (std::find(present.begin(), present.end(), "gaps.csv") == present.end()) {
    return;
  }
  Sheet& sheet = report.sheet;
  sheet.chapter(Text::tr("Gaps in the armor"));
  sheet.paragraph(Text::tr("Patches of skin through which shots reach a structure past the armor, the largest of each "
                           "structure, pose and system; all stand in gaps.csv. Share: of the structure's unprotected "
                           "shots. Directions are where those shots come from. Organs follow the model %1.")
                      .arg(modelLabel(view.mainModel())));
  Table table(sheet,
              {{28.0, Qt::AlignLeft}, {8.0}, {30.0, Qt::AlignLeft}, {16.0}, {16.0}, {22.0}, {54.0, Qt::AlignLeft}},
              {{{Text::tr("Structure")},
                {Text::tr("No.")},
                {Text::tr("Region")},
                {Text::tr("Area, cm\u00b2")},
                {Text::tr("Share, %")},
                {Text::tr("Az., el., \u00b0")},
                {Text::tr("Pieces beside it")}}});
  table.setCaption(Text::tr("The largest gaps."));
  constexpr std::uint64_t most = 3;
  std::string last;
  std::size_t shown = 0;
  for (const analysis::GapRow& row : report.run.gaps) {
    const bool armored = std::find(view.armored.begin(), view.armored.end(), row.place.system) != view.armored.end();
    if (!armored || row.place.model != view.mainModel() || row.patch == 0 || row.patch > most) {
      continue;
    }
    const std::string group = row.place.source + "\n" + row.place.system + "\n" + row.place.pose;
    if (group != last) {
      table.section(
          Text::tr("%1, %2, source %3").arg(text(row.place.pose), text(row.place.system), text(row.place.source)));
      last = group;
    }
    table.row({{structureLabel(row.structure, row.structure == "body" ? "body" : "organ")},
               {QString::number(row.patch)},
               {text(row.region)},
               {number(row.area, 1)},
               {number(row.percentOfUnprotected, 1)},
               {direction(row)},
               {text(row.neighbours), {}, false, {}, 4}});
    ++shown;
  }
  table.end();
  if (shown == 0) {
    sheet.paragraph(Text::tr("No open patch was found under any armor system."));
  }
}

void writeAnatomy(const Report& report) {
  const RunView& view = report.view;
  if (report.run.anatomy.empty() || view.armored.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  sheet.chapter(Text::tr("Where organs really lie"));
  constexpr double worthTelling = 0.02;
  sheet.paragraph(
      Text::tr("Organs were moved at random by published displacements between postures and with the breath, "
               "%1 times, and the same shots traced again. The bands say how far coverage is open because "
               "nobody knows where in a person the organs lie. Totals, and organs whose band is wider than "
               "2 percentage points; organs follow the model %2.")
          .arg(report.run.anatomy.front().draws)
          .arg(modelLabel(view.mainModel())));
  Table table(sheet, {{50.0, Qt::AlignLeft}, {40.0}, {28.0}, {28.0}, {28.0}},
              {{{QString()}, {Text::tr("Coverage of the run, %")}, {Text::tr("Over the displacements, %"), 3}},
               {{Text::tr("Structure")},
                {QString()},
                {Text::tr("5th percentile")},
                {Text::tr("median")},
                {Text::tr("95th percentile")}}});
  table.setCaption(Text::tr("Coverage with organs moved at random."));
  std::string last;
  for (const analysis::AnatomyTableRow& row : report.run.anatomy) {
    const bool armored = std::find(view.armored.begin(), view.armored.end(), row.place.system) != view.armored.end();
    const bool wide = row.p05 && row.p95 && *row.p95 - *row.p05 > worthTelling;
    if (!armored || row.place.model != view.mainModel() || (row.kind == "organ" && !wide)) {
      continue;
    }
    const std::string group = row.place.source + "\n" + row.place.system + "\n" + row.place.pose;
    if (group != last) {
      table.section(
          Text::tr("%1, %2, source %3").arg(text(row.place.pose), text(row.place.system), text(row.place.source)));
      last = group;
    }
    table.row({{structureLabel(row.structure, row.kind)},
               {percent(row.coverage.value), range(row.coverage)},
               {percent(row.p05)},
               {percent(row.p50)},
               {percent(row.p95)}});
  }
  table.end();
}

}  // namespace lorica::report
