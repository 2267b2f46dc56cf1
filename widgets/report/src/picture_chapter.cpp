#include <QCoreApplication>
#include <algorithm>
#include <array>

#include "chapters.h"
#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

constexpr double rowHeight = 68.0;
constexpr double gap = 4.0;

void writeLegend(Sheet& sheet, const PictureSet& pictures) {
  sheet.section(Text::tr("Colours"), 12.0);
  constexpr int columns = 4;
  constexpr double height = 4.4;
  const double width = Sheet::width / columns;
  std::string system;
  int column = 0;
  const auto endLine = [&] {
    if (column > 0) {
      sheet.space(height);
      column = 0;
    }
  };
  sheet.need(height);
  for (const LegendEntry& entry : pictures.legend) {
    if (entry.system != system) {
      endLine();
      sheet.space(1.5);
      sheet.need(3.0 * height);
      sheet.line({Sheet::left, sheet.y(), Sheet::width, height},
                 Text::tr("Armor system %1, translucent").arg(text(entry.system)), {7.5, true, ink::muted});
      sheet.space(height);
      system = entry.system;
    }
    if (column == 0) {
      sheet.need(height);
    }
    const double x = Sheet::left + column * width;
    const QRectF swatch(x, sheet.y() + 0.7, 4.2, 2.8);
    sheet.fill(swatch, QColor(entry.colour));
    sheet.painter().setPen(QPen(ink::muted, Sheet::unit(0.12)));
    sheet.painter().drawRect(Sheet::units(swatch));
    sheet.line({x + 5.6, sheet.y(), width - 7.0, height},
               structureLabel(entry.structure, entry.structure == "body" ? "body" : "organ"), {7.8});
    if (++column == columns) {
      endLine();
    }
  }
  endLine();
}

/// Millimetres a pixel: the one scale at which every row of the set fits.
double scaleOf(const PictureSet& pictures, double height) {
  int across = 1;
  int tallest = 1;
  for (const PosePictures& pose : pictures.poses) {
    across = std::max(across, pose.front.width() + pose.side.width() + pose.back.width());
    tallest = std::max({tallest, pose.front.height(), pose.side.height(), pose.back.height()});
  }
  return std::min(height / tallest, (Sheet::width - 2.0 * gap) / across);
}

}  // namespace

void drawPoseRow(Sheet& sheet, const PictureSet& pictures, const PosePictures& pose, double height) {
  const std::array<const QImage*, 3> views{&pose.front, &pose.side, &pose.back};
  double across = 0.0;
  int tallest = 1;
  for (const QImage* view : views) {
    across += view->width();
    tallest = std::max(tallest, view->height());
  }
  const double scale = scaleOf(pictures, height);
  const double high = scale * tallest;
  double x = Sheet::left + 0.5 * (Sheet::width - 2.0 * gap - scale * across);
  for (const QImage* view : views) {
    const double width = scale * view->width();
    sheet.picture({x, sheet.y() + high - scale * view->height(), width, scale * view->height()}, *view);
    x += width + gap;
  }
  // A length to measure with.
  if (pictures.metresPerPixel > 0.0) {
    const double half = 0.5 * scale / pictures.metresPerPixel;
    const double y = sheet.y() + high - 1.0;
    sheet.rule(Sheet::right - half, y, half, ink::text, 0.3);
    sheet.line({Sheet::right - half, y - 4.0, half, 3.5}, Text::tr("0.5 m"), styles::note, Qt::AlignHCenter);
  }
  sheet.space(high + 1.0);
}

void writePictureChapter(const Report& report) {
  const PictureSet& pictures = report.pictures;
  if (pictures.poses.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  sheet.chapter(Text::tr("Poses and armor"));
  sheet.paragraph(Text::tr("Each pose from the front, from the person's left and from the back, drawn with the rays of "
                           "the analysis, in parallel view and all at one scale. The skin and the armor are shown "
                           "translucent; organs follow the model %1.")
                      .arg(modelLabel(pictures.model)));
  const std::vector<std::string>& poses = report.run.facts.poses;
  const auto left = std::count_if(poses.begin(), poses.end(), [&](const std::string& pose) {
    return std::none_of(pictures.poses.begin(), pictures.poses.end(),
                        [&](const PosePictures& shown) { return shown.pose == pose; });
  });
  if (left > 0) {
    sheet.paragraph(Text::tr("%1 more poses of the run are not drawn.").arg(left));
  }
  for (const PosePictures& pose : pictures.poses) {
    sheet.need(scaleOf(pictures, rowHeight) * pose.front.height() + 9.0);
    sheet.line({Sheet::left, sheet.y(), Sheet::width, 5.0}, Text::tr("%1, %2").arg(text(pose.pose), text(pose.system)),
               {9.0, true});
    sheet.space(6.0);
    drawPoseRow(sheet, pictures, pose, rowHeight);
    sheet.space(3.0);
  }
  writeLegend(sheet, pictures);
}

}  // namespace lorica::report
