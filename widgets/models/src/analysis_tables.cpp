#include "lorica/models/analysis_tables.h"

#include <QCoreApplication>
#include <QStringList>

#include "lorica/models/model_texts.h"
#include "lorica/models/numbers.h"

namespace lorica::models {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::models::AnalysisTables)
};

QString shown(const std::string& text) {
  return QString::fromStdString(text);
}

ValueCell number(double value, int decimals) {
  return {fixed(value, decimals), value};
}

ValueCell number(const std::optional<double>& value, int decimals, double times = 1.0) {
  return value ? number(times * *value, decimals) : ValueCell{QStringLiteral("-")};
}

ValueCell count(std::uint64_t value) {
  return {grouped(value), static_cast<double>(value)};
}

ValueCell range(const std::optional<double>& low, const std::optional<double>& high) {
  return low && high ? ValueCell{QStringLiteral("%1 – %2").arg(fixed(100.0 * *low, 1), fixed(100.0 * *high, 1)),
                                 100.0 * (*high - *low)}
                     : ValueCell{QStringLiteral("-")};
}

ValueCell displacementOf(const analysis::AnatomyRecord& record) {
  if (!record.jitter) {
    return {{}};
  }
  const geometry::Vec3d millimetres = 1000.0 * record.jitter->deviation();
  using Basis = analysis::OrganJitter::Basis;
  const QString parts = QStringLiteral("%1 / %2 / %3")
                            .arg(fixed(millimetres.x(), 0), fixed(millimetres.y(), 0), fixed(millimetres.z(), 0));
  switch (record.jitter->basis) {
    case Basis::none:
      return {Text::tr("stays"), 0.0, Text::tr("Nobody published how far this organ moves; it stays where it is.")};
    case Basis::unverified:
      return {parts, millimetres.norm(),
              Text::tr("Published magnitudes; nobody has looked up the source of one of them again.")};
    case Basis::verified:
      return {parts, millimetres.norm(), Text::tr("Published magnitudes, looked up in their sources.")};
    case Basis::given:
      return {parts, millimetres.norm(), Text::tr("Given by the study.")};
  }
  return {parts, millimetres.norm()};
}

}  // namespace

TableContent gapTable(const analysis::RunResult& run, std::span<const analysis::Gap> gaps) {
  TableContent table;
  table.columns = {
      {Text::tr("To protect"), Text::tr("The structure that shots reach unprotected")},
      {Text::tr("Source"), {}, false, false},
      {Text::tr("System"), {}, false, false},
      {Text::tr("Model"), {}, false, false},
      {Text::tr("Pose"), {}, false, false},
      {Text::tr("Gap"), Text::tr("The largest is 1; \"elsewhere\": all unprotected shots that enter no gap"), true},
      {Text::tr("Region"), Text::tr("Region of the body that holds most of it")},
      {Text::tr("Area cm²"), Text::tr("Open skin: of each triangle the share of its shots that is unprotected"), true},
      {Text::tr("Unprotected shots"), Text::tr("That reach the structure through the gap"), true},
      {Text::tr("Of its shots %"), Text::tr("Share of the shots through the gap that is unprotected"), true},
      {Text::tr("Of all unprotected %"), Text::tr("Share of the structure's unprotected shots that come this way"),
       true},
      {Text::tr("Azimuth °"), Text::tr("Where these shots come from: 0 ahead of the person, 90 on the left"), true},
      {Text::tr("Elevation °"), Text::tr("Where these shots come from: 90 above"), true},
      {Text::tr("Spread °"), Text::tr("How far around that direction they come from"), true},
      {Text::tr("Beside"), Text::tr("Pieces of the system within 10 cm, with their distance")}};
  for (const analysis::Gap& gap : gaps) {
    const bool placed = gap.number > 0;
    const analysis::GapBearing bearing = placed ? analysis::bearingOf(gap) : analysis::GapBearing{};
    const auto ofPatch = [placed](double value) { return placed ? number(value, 1) : ValueCell{QStringLiteral("-")}; };
    const auto share = [&](std::uint64_t of) {
      return of == 0 ? ValueCell{QStringLiteral("-")}
                     : number(100.0 * static_cast<double>(gap.patch.open) / static_cast<double>(of), 1);
    };
    QStringList beside;
    for (const analysis::Gap::Neighbour& neighbour : gap.neighbours) {
      beside.append(Text::tr("%1 (%2 mm)").arg(shown(neighbour.piece), fixed(1000.0 * neighbour.distance, 1)));
    }
    table.rows.push_back({{shown(gap.structure)},
                          {shown(run.sources[gap.source].source.name)},
                          {shown(run.systems[gap.system])},
                          {modelLabel(run.models[gap.model])},
                          {shown(run.poses[gap.pose])},
                          placed ? count(gap.number) : ValueCell{Text::tr("elsewhere"), 1e9},
                          {placed ? shown(gap.region) : QStringLiteral("-")},
                          ofPatch(1e4 * gap.patch.area),
                          count(gap.patch.open),
                          share(gap.patch.hits),
                          share(gap.openShots),
                          ofPatch(bearing.azimuth),
                          ofPatch(bearing.elevation),
                          ofPatch(bearing.spread),
                          {beside.join(QStringLiteral(", "))}});
  }
  return table;
}

TableContent anatomyTable(std::span<const analysis::AnatomyRecord> records, std::uint32_t draws) {
  TableContent table;
  table.columns = {{Text::tr("Structure")},
                   {Text::tr("Source"), {}, false, false},
                   {Text::tr("System"), {}, false, false},
                   {Text::tr("Model"), {}, false, false},
                   {Text::tr("Pose"), {}, false, false},
                   {Text::tr("Coverage %"), Text::tr("Of the run itself, organs where the study has them"), true},
                   {Text::tr("95 % interval"), Text::tr("Of the run's coverage: how sure the shots make it"), true},
                   {Text::tr("Median %"), Text::tr("Of the coverage over the draws that hit the structure"), true},
                   {Text::tr("5th – 95th percentile"),
                    Text::tr("Of the coverage over the draws: how sure the anatomy makes it"), true},
                   {Text::tr("Moved by mm"), Text::tr("Standard deviation to the left / up / forward"), true},
                   {Text::tr("Held back"), Text::tr("Draws in which the skin shortened the displacement"), true},
                   {Text::tr("Draws that hit"), Text::tr("Of %1 draws").arg(grouped(draws)), true, false}};
  for (const analysis::AnatomyRecord& record : records) {
    const analysis::ResultRow& row = record.run;
    const auto interval = row.coverageInterval();
    const auto label = modelFromFile(row.model);
    table.rows.push_back({{shown(row.structure)},
                          {shown(row.source)},
                          {shown(row.system)},
                          {label},
                          {shown(row.pose)},
                          number(row.coverage(), 1, 100.0),
                          interval ? range(interval->low, interval->high) : range(std::nullopt, std::nullopt),
                          number(record.coverage[1], 1, 100.0),
                          range(record.coverage[0], record.coverage[2]),
                          displacementOf(record),
                          record.jitter ? count(record.heldBack) : ValueCell{QStringLiteral("-")},
                          count(record.drawsHit)});
  }
  return table;
}

}  // namespace lorica::models
