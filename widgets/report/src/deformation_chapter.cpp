#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <functional>

#include "chapters.h"
#include "table.h"
#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

using analysis::DeformationRow;
using Rows = std::vector<const DeformationRow*>;
using Measure = std::function<std::optional<double>(const DeformationRow&)>;

/// The row in which a measure is farthest from zero; none when it is known in none.
const DeformationRow* worstOf(const Rows& rows, const Measure& measure) {
  const DeformationRow* worst = nullptr;
  for (const DeformationRow* row : rows) {
    const std::optional<double> value = measure(*row);
    if (value && (worst == nullptr || std::abs(*value) > std::abs(*measure(*worst)))) {
      worst = row;
    }
  }
  return worst;
}

/// \param neutral what an organ that nothing happened to has
Cell worstCell(const Rows& rows, const Measure& measure, int decimals, double neutral = 0.0) {
  const DeformationRow* worst = worstOf(rows, measure);
  if (worst == nullptr) {
    return {number(std::nullopt, decimals), Text::tr("not measurable")};
  }
  const QString value = number(measure(*worst), decimals);
  return {value, value == number(neutral, decimals) ? QString() : text(worst->pose)};
}

void writeWorst(const Report& report) {
  Table table(report.sheet, {{36.0, Qt::AlignLeft}, {23.0}, {23.0}, {24.0}, {23.0}, {21.0}, {24.0}},
              {{{Text::tr("Organ")},
                {Text::tr("Volume, %")},
                {Text::tr("Protrusion, mm")},
                {Text::tr("Overlap, cm\u00b3")},
                {Text::tr("Gap, mm")},
                {Text::tr("Stretch")},
                {Text::tr("Bars given way")}}});
  table.setCaption(
      Text::tr("The worst of all poses, with its pose: change of volume, deepest protrusion from the skin, "
               "overlap with other organs beyond rest, largest gap between surfaces that touch at rest, "
               "largest edge stretch, and in how many poses a bar gave way."));
  for (const std::string& model : report.run.facts.models) {
    table.section(modelLabel(model));
    for (const StructureKey& organ : report.view.organs) {
      Rows rows;
      for (const DeformationRow& row : report.run.deformation) {
        if (row.organ == organ.structure && row.model == model) {
          rows.push_back(&row);
        }
      }
      if (rows.empty()) {
        continue;
      }
      const auto gave =
          std::count_if(rows.begin(), rows.end(), [](const DeformationRow* row) { return !row->gaveWay.empty(); });
      table.row({{text(organ.structure)},
                 worstCell(
                     rows, [](const DeformationRow& row) { return row.volumeChange; }, 2),
                 worstCell(
                     rows, [](const DeformationRow& row) { return row.protrusion; }, 1),
                 worstCell(
                     rows, [](const DeformationRow& row) { return row.overlap; }, 1),
                 worstCell(
                     rows, [](const DeformationRow& row) { return row.largestGap; }, 1),
                 worstCell(
                     rows, [](const DeformationRow& row) { return row.stretch; }, 2, 1.0),
                 {Text::tr("%1 of %2").arg(gave).arg(rows.size()), {}, gave > 0}});
    }
  }
  table.end();
}

void writeBars(const Report& report) {
  Sheet& sheet = report.sheet;
  sheet.section(Text::tr("Which bars gave way"));
  std::size_t gave = 0;
  for (const DeformationRow& row : report.run.deformation) {
    gave += row.gaveWay.empty() ? 0 : 1;
  }
  sheet.paragraph(
      Text::tr("An organ should keep its lattice from turning inside out, protrude by less than 1 mm, overlap "
               "other organs beyond rest by no more than 0.5 % of its volume, and keep its volume within "
               "2 % (5 % for lungs, stomach, intestines and colon). %1 of %2 organs in a pose did not.")
          .arg(gave)
          .arg(report.run.deformation.size()));
  if (gave == 0) {
    return;
  }
  Table table(sheet, {{36.0, Qt::AlignLeft}, {138.0, Qt::AlignLeft}},
              {{{Text::tr("Organ")}, {Text::tr("What gave way, by pose")}}});
  table.setCaption(Text::tr("Organs that did not keep a bar."));
  for (const std::string& model : report.run.facts.models) {
    table.section(modelLabel(model));
    for (const StructureKey& organ : report.view.organs) {
      QStringList found;
      for (const DeformationRow& row : report.run.deformation) {
        if (row.model == model && row.organ == organ.structure && !row.gaveWay.empty()) {
          found.push_back(QStringLiteral("%1: %2").arg(text(row.pose), text(row.gaveWay)));
        }
      }
      if (!found.isEmpty()) {
        constexpr int most = 14;
        const QString all =
            found.join(QStringLiteral(" \u00b7 ")).replace(QStringLiteral("cm3"), QStringLiteral("cm\u00b3"));
        table.row({{text(organ.structure)}, {all, {}, false, {}, most}});
      }
    }
  }
  table.end();
}

void writeOverlaps(const Report& report) {
  std::vector<const analysis::ContactRow*> rows;
  constexpr double worthTelling = 0.05;
  for (const analysis::ContactRow& row : report.run.contacts) {
    if (row.model == report.view.mainModel() && row.overlap && *row.overlap >= worthTelling) {
      rows.push_back(&row);
    }
  }
  if (rows.empty()) {
    return;
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) { return *a->overlap > *b->overlap; });
  constexpr std::size_t most = 12;
  Table table(report.sheet, {{44.0, Qt::AlignLeft}, {44.0, Qt::AlignLeft}, {44.0, Qt::AlignLeft}, {42.0}},
              {{{Text::tr("Organ")},
                {Text::tr("and organ")},
                {Text::tr("Pose")},
                {Text::tr("Overlap beyond rest, cm\u00b3")}}});
  table.setCaption(
      Text::tr("The pairs of organs that overlap most, model %1.").arg(modelLabel(report.view.mainModel())));
  for (std::size_t i = 0; i < rows.size() && i < most; ++i) {
    table.row({{text(rows[i]->first)}, {text(rows[i]->second)}, {text(rows[i]->pose)}, {number(rows[i]->overlap, 2)}});
  }
  table.end();
}

void writeRooms(const Report& report) {
  Table table(report.sheet, {{58.0, Qt::AlignLeft}, {29.0}, {29.0}, {29.0}, {29.0}},
              {{{Text::tr("Pose")},
                {Text::tr("Skin, litres")},
                {Text::tr("change, %")},
                {Text::tr("Torso, litres")},
                {Text::tr("change, %")}}});
  table.setCaption(Text::tr(
      "Room inside the skin: where a pose leaves less than at rest, organs that keep their volume must give way."));
  for (const analysis::RoomRow& row : report.run.rooms) {
    table.row({{text(row.pose)},
               {number(row.skin, 1)},
               {number(row.skinChange, 1, true)},
               {number(row.torso, 1)},
               {number(row.torsoChange, 1, true)}});
  }
  table.end();
}

}  // namespace

void writeDeformation(const Report& report) {
  if (report.view.organs.empty() || report.run.deformation.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  sheet.chapter(Text::tr("What poses do to the organs"));
  sheet.paragraph(
      Text::tr("Coverage is worth as much as the places of the organs are. This audit measures every organ in "
               "every pose: a rigid organ keeps its volume but may end up outside the skin or inside another "
               "organ; a deforming one should do neither."));
  writeWorst(report);
  writeOverlaps(report);
  if (!report.run.rooms.empty()) {
    writeRooms(report);
  }
  writeBars(report);
}

}  // namespace lorica::report
