#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "chapters.h"
#include "lorica/study/reserved_names.h"
#include "table.h"
#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

using analysis::ComparisonRow;
using analysis::PieceRow;

/// Rows that stand in one table: everything but structure and pose.
using Family = std::tuple<std::string, std::string, std::string, std::string, std::string>;

Family familyOf(const ComparisonRow& row) {
  return {row.what, row.place.source, row.held, row.first, row.second};
}

/// Against the body without armor there is nothing to test: its coverage is zero.
bool tellsSomething(const ComparisonRow& row) {
  const std::string bare(study::unarmored);
  return row.first != bare && row.second != bare && row.held != bare;
}

QString labelOf(const ComparisonRow& row, const std::string& name) {
  return row.what == "model" ? modelLabel(name) : text(name);
}

bool isSignificant(const ComparisonRow& row) {
  return row.pairedHolm && *row.pairedHolm < 0.05;
}

Cell cellOf(const ComparisonRow* row) {
  if (row == nullptr) {
    return {number(std::nullopt, 1)};
  }
  const QString change = points(row->difference.value);
  const QString p = row->pairedHolm ? Text::tr("p %1").arg(probability(row->pairedHolm)) : QString();
  return {change, p, isSignificant(*row)};
}

/// One family: a row for each structure, a column for each pose.
void writeFamily(const Report& report, const std::vector<const ComparisonRow*>& rows) {
  std::vector<std::string> structures;
  std::vector<std::string> poses;
  std::map<std::pair<std::string, std::string>, const ComparisonRow*> at;
  const auto add = [](std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  };
  for (const ComparisonRow* row : rows) {
    add(structures, row->structure);
    add(poses, row->place.pose);
    at[{row->structure, row->place.pose}] = row;
  }
  const ComparisonRow& head = *rows.front();
  const QString held = head.what == "model" ? Text::tr("system %1").arg(text(head.held))
                                            : Text::tr("model %1").arg(modelLabel(head.held));
  constexpr std::size_t together = 6;
  constexpr double label = 36.0;
  for (std::size_t begin = 0; begin < poses.size(); begin += together) {
    const std::size_t end = std::min(poses.size(), begin + together);
    const double width = (Sheet::width - label) / static_cast<double>(std::max<std::size_t>(end - begin, 4));
    std::vector<Column> columns{{label, Qt::AlignLeft}};
    std::vector<Head> heads{{Text::tr("Structure")}};
    for (std::size_t p = begin; p < end; ++p) {
      columns.push_back({width});
      heads.push_back({text(poses[p])});
    }
    columns.push_back({Sheet::width - label - static_cast<double>(end - begin) * width});
    heads.emplace_back();
    Table table(report.sheet, columns, {heads});
    table.setCaption(
        Text::tr("Coverage under %1 minus that under %2, percentage points; source %3, %4. p: paired t over "
                 "the trials, Holm over the structures, none where the trials agree; bold: below 0.05.")
            .arg(labelOf(head, head.first), labelOf(head, head.second), text(head.place.source), held));
    for (const std::string& structure : structures) {
      std::vector<Cell> cells{{structureLabel(structure, structure == "body" ? "body" : "organ")}};
      for (std::size_t p = begin; p < end; ++p) {
        const auto found = at.find({structure, poses[p]});
        cells.push_back(cellOf(found == at.end() ? nullptr : found->second));
      }
      table.row(cells);
    }
    table.end();
  }
}

void writeMasses(const Report& report) {
  Sheet& sheet = report.sheet;
  std::vector<const analysis::SystemRow*> systems;
  for (const analysis::SystemRow& row : report.run.systems) {
    if (std::none_of(systems.begin(), systems.end(),
                     [&](const analysis::SystemRow* one) { return one->place.system == row.place.system; })) {
      systems.push_back(&row);
    }
  }
  if (systems.empty()) {
    return;
  }
  Table table(sheet, {{80.0, Qt::AlignLeft}, {30.0}, {30.0}, {34.0}},
              {{{Text::tr("System")}, {Text::tr("Area, m\u00b2")}, {Text::tr("Mass, kg")}, {QString()}}});
  table.setCaption(
      Text::tr("Armor systems: area of all pieces and their mass, where the study gives areal densities."));
  for (const analysis::SystemRow* row : systems) {
    table.row({{text(row->place.system)}, {number(row->area, 3)}, {number(row->mass, 2)}});
  }
  table.end();
}

/// What one piece gives: by how much coverage falls without it.
struct PieceGain {
  std::string source;
  std::string system;
  std::string piece;
  double bodySum = 0.0;
  std::size_t bodyPoses = 0;
  std::vector<const PieceRow*> organs;  ///< those it gives something
};

double gainOf(const PieceRow& row) {
  return row.coverage && row.without ? *row.coverage - *row.without : 0.0;
}

std::vector<PieceGain> gainsOf(const Report& report) {
  std::vector<PieceGain> gains;
  for (const PieceRow& row : report.run.pieces) {
    if (row.place.model != report.view.mainModel()) {
      continue;
    }
    const auto found = std::find_if(gains.begin(), gains.end(), [&](const PieceGain& one) {
      return one.source == row.place.source && one.system == row.place.system && one.piece == row.piece;
    });
    PieceGain& gain = found == gains.end()
                          ? gains.emplace_back(PieceGain{row.place.source, row.place.system, row.piece, 0.0, 0, {}})
                          : *found;
    if (row.structure == "body") {
      gain.bodySum += gainOf(row);
      ++gain.bodyPoses;
    } else if (gainOf(row) > 0.0) {
      gain.organs.push_back(&row);
    }
  }
  for (PieceGain& gain : gains) {
    std::stable_sort(gain.organs.begin(), gain.organs.end(),
                     [](const PieceRow* a, const PieceRow* b) { return gainOf(*a) > gainOf(*b); });
  }
  return gains;
}

}  // namespace

void writeComparisons(const Report& report) {
  std::vector<Family> order;
  std::map<Family, std::vector<const ComparisonRow*>> families;
  for (const ComparisonRow& row : report.run.comparisons) {
    if (!tellsSomething(row)) {
      continue;
    }
    auto& family = families[familyOf(row)];
    if (family.empty()) {
      order.push_back(familyOf(row));
    }
    family.push_back(&row);
  }
  if (report.run.comparisons.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  sheet.chapter(Text::tr("Comparisons on the same shots"));
  sheet.paragraph(
      Text::tr("Systems and models met the same shots, so differences are paired trial by trial. With few "
               "trials a large difference may have a large p. Exact McNemar counts of single shots stand in "
               "comparisons.csv, with the body without armor among the systems."));
  writeMasses(report);
  if (order.empty()) {
    sheet.paragraph(Text::tr("There is but one armor system and one organ model, so there is nothing to compare."));
  }
  for (const Family& family : order) {
    writeFamily(report, families[family]);
  }
}

void writePieces(const Report& report) {
  const std::vector<PieceGain> gains = gainsOf(report);
  if (gains.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  sheet.chapter(Text::tr("What each piece gives"));
  sheet.paragraph(
      Text::tr("How many percentage points of coverage would be lost if this piece alone were left out; shots "
               "that another piece meets too are not lost. Organs follow the model %1.")
          .arg(modelLabel(report.view.mainModel())));
  Table table(sheet, {{46.0, Qt::AlignLeft}, {28.0}, {100.0, Qt::AlignLeft}},
              {{{Text::tr("Piece")}, {Text::tr("Body, mean")}, {Text::tr("Organs that need it most")}}});
  table.setCaption(Text::tr("Marginal gain of the pieces, percentage points of coverage."));
  std::string last;
  for (const PieceGain& gain : gains) {
    const std::string group = gain.source + "\n" + gain.system;
    if (group != last) {
      table.section(Text::tr("%1, source %2").arg(text(gain.system), text(gain.source)));
      last = group;
    }
    QStringList organs;
    constexpr std::size_t most = 3;
    for (std::size_t i = 0; i < gain.organs.size() && i < most; ++i) {
      const PieceRow& row = *gain.organs[i];
      organs.push_back(
          QStringLiteral("%1 %2 (%3)").arg(text(row.structure), points(gainOf(row)), text(row.place.pose)));
    }
    const std::optional<double> body =
        gain.bodyPoses > 0 ? std::optional(gain.bodySum / static_cast<double>(gain.bodyPoses)) : std::nullopt;
    table.row(
        {{text(gain.piece)},
         {points(body)},
         {organs.isEmpty() ? Text::tr("none: other pieces cover all it covers") : organs.join(QStringLiteral("; "))}});
  }
  table.end();
}

void writeConvergence(const Report& report) {
  const auto& rows = report.run.convergence;
  std::vector<std::uint64_t> steps;
  for (const analysis::ConvergenceRow& row : rows) {
    if (std::find(steps.begin(), steps.end(), row.trials) == steps.end()) {
      steps.push_back(row.trials);
    }
  }
  if (steps.empty()) {
    return;
  }
  std::sort(steps.begin(), steps.end());
  constexpr std::size_t most = 8;
  std::vector<std::uint64_t> shown;
  for (std::size_t i = 0; i < std::min(most, steps.size()); ++i) {
    shown.push_back(steps[steps.size() <= most ? i : i * (steps.size() - 1) / (most - 1)]);
  }
  // The widest interval of each structure over poses and armored systems, organs in the main model.
  std::map<std::pair<std::string, std::uint64_t>, double> widest;
  std::vector<StructureKey> structures;
  for (const analysis::ConvergenceRow& row : rows) {
    const bool wanted = row.kind == "organ" || row.kind == "body" || row.kind == "class" || row.kind == "aggregate";
    if (!wanted || row.structure == "miss" || row.place.system == study::unarmored ||
        row.place.model != report.view.mainModel() || !row.coverage.low || !row.coverage.high) {
      continue;
    }
    if (std::none_of(structures.begin(), structures.end(),
                     [&](const StructureKey& one) { return one.structure == row.structure; })) {
      structures.push_back({row.kind, row.structure});
    }
    double& width = widest[{row.structure, row.trials}];
    width = std::max(width, 0.5 * (*row.coverage.high - *row.coverage.low));
  }
  if (structures.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  sheet.chapter(Text::tr("How coverage settles"));
  std::vector<Column> columns{{46.0, Qt::AlignLeft}};
  std::vector<Head> upper{{QString()}, {Text::tr("after so many trials"), static_cast<int>(shown.size())}};
  std::vector<Head> lower{{Text::tr("Structure")}};
  for (const std::uint64_t step : shown) {
    columns.push_back({(Sheet::width - 46.0) / static_cast<double>(shown.size())});
    lower.push_back({QString::number(step)});
  }
  Table table(sheet, columns, {upper, lower});
  table.setCaption(
      Text::tr("Half width of the 95 % interval of coverage, percentage points: the widest over sources, poses and "
               "armor systems."));
  for (const StructureKey& structure : structures) {
    std::vector<Cell> cells{{structureLabel(structure.structure, structure.kind)}};
    for (const std::uint64_t step : shown) {
      const auto found = widest.find({structure.structure, step});
      cells.push_back({found == widest.end() ? number(std::nullopt, 1) : number(100.0 * found->second, 2)});
    }
    table.row(cells);
  }
  table.end();
}

}  // namespace lorica::report
