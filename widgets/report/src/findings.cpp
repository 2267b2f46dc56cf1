#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "chapters.h"
#include "coverage_marks.h"
#include "table.h"
#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

/// Static against deforming organs, one structure.
struct ModelDifference {
  std::string source;
  std::string system;
  std::string pose;
  StructureKey structure;
  analysis::Coverage rigid;
  analysis::Coverage deforming;
  double size() const { return std::abs(*difference(rigid, deforming)); }
};

/// Those whose intervals lie apart, the largest first; ties keep the tables' order.
std::vector<ModelDifference> modelDifferences(const RunView& view, const std::vector<StructureKey>& structures) {
  std::vector<ModelDifference> all;
  for (const std::string& source : view.sources) {
    for (const std::string& system : view.armored) {
      for (const std::string& pose : view.posesOf(source)) {
        for (const StructureKey& structure : structures) {
          ModelDifference one{source,
                              system,
                              pose,
                              structure,
                              view.coverage(source, system, *view.rigid, pose, structure),
                              view.coverage(source, system, *view.deforming, pose, structure)};
          if (apart(one.rigid, one.deforming)) {
            all.push_back(std::move(one));
          }
        }
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const ModelDifference& a, const ModelDifference& b) { return a.size() > b.size(); });
  return all;
}

QString fromSource(const RunView& view, const std::string& source) {
  return view.sources.size() > 1 ? Text::tr(" from %1").arg(text(source)) : QString();
}

QString sentence(const RunView& view, const ModelDifference& one) {
  const double change = 100.0 * *difference(one.rigid, one.deforming);
  return Text::tr("%1 in %2 under %3%4: %5 with %6 organs against %7 with %8 ones, %9 percentage points.")
      .arg(structureLabel(one.structure.structure, one.structure.kind), text(one.pose), text(one.system),
           fromSource(view, one.source), percentWithRange(one.deforming), Text::tr("deforming"),
           percentWithRange(one.rigid), Text::tr("rigid"), number(change, 1, true));
}

void writeModelDifferences(const Report& report) {
  Sheet& sheet = report.sheet;
  const RunView& view = report.view;
  if (!view.rigid || !view.deforming || view.organs.empty()) {
    return;
  }
  sheet.section(Text::tr("What deforming the organs changes"));
  constexpr std::size_t most = 5;
  const std::vector<ModelDifference> found = modelDifferences(view, view.organs);
  std::size_t compared = 0;
  for (const std::string& source : view.sources) {
    compared += view.posesOf(source).size() * view.armored.size() * view.organs.size();
  }
  if (found.empty()) {
    sheet.paragraph(Text::tr("In none of %1 combinations of organ, pose, system and source do the 95 % intervals of "
                             "%2 and %3 lie apart: the run shows no difference in coverage between the two models.")
                        .arg(compared)
                        .arg(modelLabel(*view.rigid), modelLabel(*view.deforming)));
    return;
  }
  sheet.paragraph(Text::tr("The 95 % intervals of %1 and %2 lie apart in %3 of %4 combinations of organ, pose, system "
                           "and source. The largest differences in coverage:")
                      .arg(modelLabel(*view.rigid), modelLabel(*view.deforming))
                      .arg(found.size())
                      .arg(compared));
  for (std::size_t i = 0; i < found.size() && i < most; ++i) {
    sheet.bullet(sentence(view, found[i]));
  }
}

/// Where the coverage of a total is lowest and highest over the poses.
void writeSpan(const Report& report, const std::string& source, const std::string& system, const StructureKey& total) {
  const RunView& view = report.view;
  const analysis::CoverageRow* lowest = nullptr;
  const analysis::CoverageRow* highest = nullptr;
  for (const std::string& pose : view.posesOf(source)) {
    const analysis::CoverageRow* row = view.row(source, system, view.mainModel(), pose, total);
    if (row == nullptr || !row->coverage.value) {
      continue;
    }
    if (lowest == nullptr || *row->coverage.value < *lowest->coverage.value) {
      lowest = row;
    }
    if (highest == nullptr || *row->coverage.value > *highest->coverage.value) {
      highest = row;
    }
  }
  if (lowest == nullptr) {
    return;
  }
  const QString name = structureLabel(total.structure, total.kind).toLower();
  const QString head = Text::tr("%1, %2%3:").arg(text(system), name, fromSource(view, source));
  const QString least = Text::tr("%1 of the shots that reach them meet armor first in %2")
                            .arg(percentWithRange(lowest->coverage), text(lowest->place.pose));
  report.sheet.bullet(lowest == highest
                          ? QStringLiteral("%1 %2.").arg(head, least)
                          : Text::tr("%1 %2, the least, and %3 in %4, the most.")
                                .arg(head, least, percentWithRange(highest->coverage), text(highest->place.pose)));
}

/// Where two systems differ least and most over the poses, in a total.
void writeSystemDifference(const Report& report, const std::string& source, const std::string& first,
                           const std::string& second, const StructureKey& total) {
  const RunView& view = report.view;
  std::vector<std::pair<double, std::string>> differences;
  for (const std::string& pose : view.posesOf(source)) {
    const auto of = [&](const std::string& system) {
      return view.coverage(source, system, view.mainModel(), pose, total);
    };
    if (const std::optional<double> change = difference(of(second), of(first))) {
      differences.emplace_back(*change, pose);
    }
  }
  if (differences.empty()) {
    return;
  }
  const auto [least, most] = std::minmax_element(differences.begin(), differences.end());
  const QString head = Text::tr("%1 against %2, %3%4:")
                           .arg(text(first), text(second), structureLabel(total.structure, total.kind).toLower(),
                                fromSource(view, source));
  report.sheet.bullet(differences.size() == 1 ? Text::tr("%1 a difference of %2 percentage points in %3.")
                                                    .arg(head, points(least->first), text(least->second))
                                              : Text::tr("%1 a difference of %2 (%3) to %4 (%5) percentage points.")
                                                    .arg(head, points(least->first), text(least->second),
                                                         points(most->first), text(most->second)));
}

void writeSystemSentences(const Report& report) {
  for (const std::string& source : report.view.sources) {
    for (const std::string& system : report.view.armored) {
      for (const StructureKey& total : report.view.totals) {
        if (total.kind != "class" || total.structure == "essential") {
          writeSpan(report, source, system, total);
        }
      }
    }
    for (std::size_t other = 1; other < report.view.armored.size(); ++other) {
      writeSystemDifference(report, source, report.view.armored.front(), report.view.armored[other],
                            report.view.totals.back());
    }
  }
}

/// One table of totals: a row for each pose and system, the shown models side by side.
void writeTotals(const Report& report, const std::string& source) {
  Sheet& sheet = report.sheet;
  const RunView& view = report.view;
  const bool both = view.shownModels.size() == 2;
  constexpr double label = 36.0;
  const double share = (Sheet::width - label) / static_cast<double>(view.totals.size());
  std::vector<Column> columns{{label, Qt::AlignLeft}};
  std::vector<Head> upper{{QString()}};
  std::vector<Head> lower{{Text::tr("Pose, system")}};
  for (const StructureKey& total : view.totals) {
    const double change = both ? 0.26 * share : 0.0;
    for (const std::string& model : view.shownModels) {
      columns.push_back({(share - change) / static_cast<double>(view.shownModels.size())});
      lower.push_back({both ? (model == *view.rigid ? Text::tr("static, %") : Text::tr("dynamic, %"))
                            : Text::tr("%1, %").arg(modelLabel(model))});
    }
    if (both) {
      columns.push_back({change});
      lower.push_back({Text::tr("diff.")});
    }
    upper.push_back(
        {structureLabel(total.structure, total.kind), static_cast<int>(view.shownModels.size()) + (both ? 1 : 0)});
  }
  // Rather on a page of its own than cut, where it fits on one.
  const double rows = 5.6 + 8.0 * static_cast<double>(view.armored.size());
  const double height = 20.0 + static_cast<double>(view.posesOf(source).size()) * rows;
  if (height < Sheet::bottom - Sheet::top) {
    sheet.need(height);
  }
  Table table(sheet, columns, {upper, lower});
  table.setCaption(
      both ? Text::tr("Coverage from source %1: share of the shots that reach the organs whose way leads "
                      "through armor first, with 95 % intervals. Static and dynamic are the models \u201c%2\u201d and "
                      "\u201c%3\u201d; difference in percentage points, bold where the intervals lie "
                      "apart.")
                 .arg(text(source), modelLabel(*view.rigid), modelLabel(*view.deforming))
           : Text::tr("Coverage from source %1: share of the shots that reach the organs whose way leads "
                      "through armor first, with 95 % intervals.")
                 .arg(text(source)));
  for (const std::string& pose : view.posesOf(source)) {
    table.section(text(pose));
    for (const std::string& system : view.armored) {
      std::vector<Cell> cells{{text(system)}};
      for (const StructureKey& total : view.totals) {
        std::vector<analysis::Coverage> shown;
        for (const std::string& model : view.shownModels) {
          shown.push_back(view.coverage(source, system, model, pose, total));
          cells.push_back({percent(shown.back().value), range(shown.back())});
        }
        if (both) {
          cells.push_back({points(difference(shown[0], shown[1])), {}, apart(shown[0], shown[1])});
        }
      }
      table.row(cells);
    }
  }
  table.end();
}

/// The same as marks on axes, every model of the run.
void writeTotalsFigure(const Report& report, const std::string& source) {
  Sheet& sheet = report.sheet;
  const RunView& view = report.view;
  const auto& modelsOfRun = report.run.facts.models;
  constexpr double label = 36.0;
  const double share = (Sheet::width - label) / static_cast<double>(view.totals.size());
  std::vector<Column> columns{{label, Qt::AlignLeft}};
  std::vector<Head> upper{{QString()}};
  for (const StructureKey& total : view.totals) {
    columns.push_back({share, Qt::AlignHCenter});
    upper.push_back({structureLabel(total.structure, total.kind)});
  }
  sheet.need(60.0);
  sheet.line(
      {Sheet::left, sheet.y(), Sheet::width, 4.5},
      Text::tr("Figure %1. Coverage from source %2, by pose and system.").arg(sheet.nextFigure()).arg(text(source)),
      styles::caption);
  sheet.space(5.0);
  drawMarkLegend(sheet, modelsOfRun);
  Table figure(sheet, columns, {upper, std::vector<Head>(columns.size())});
  figure.setLeastHeight(1.6 + 2.1 * static_cast<double>(std::max<std::size_t>(modelsOfRun.size(), 2)));
  figure.setHeadDrawing([&](const std::vector<QRectF>& boxes) {
    for (std::size_t i = 1; i < boxes.size(); ++i) {
      drawCoverageScale(sheet, boxes[i]);
    }
  });
  for (const std::string& pose : view.posesOf(source)) {
    figure.section(text(pose));
    for (const std::string& system : view.armored) {
      std::vector<Table::Drawing> drawings;
      for (const StructureKey& total : view.totals) {
        std::vector<MarkedCoverage> marks;
        marks.reserve(modelsOfRun.size());
        for (const std::string& model : modelsOfRun) {
          marks.push_back({markOf(model), view.coverage(source, system, model, pose, total)});
        }
        drawings.emplace_back([&sheet, marks](const QRectF& box) { drawCoverage(sheet, box, marks); });
      }
      figure.row({{text(system)}}, drawings);
    }
  }
  figure.end();
}

/// Numbers of every model, where there are more than stand side by side.
void writeAllModels(const Report& report, const std::string& source) {
  const RunView& view = report.view;
  const auto& models = report.run.facts.models;
  if (models.size() <= view.shownModels.size()) {
    return;
  }
  constexpr double label = 46.0;
  std::vector<Column> columns{{label, Qt::AlignLeft}};
  std::vector<Head> heads{{Text::tr("Pose, system, structure")}};
  for (const std::string& model : models) {
    columns.push_back({(Sheet::width - label) / static_cast<double>(models.size())});
    heads.push_back({Text::tr("%1, %").arg(modelLabel(model))});
  }
  Table table(report.sheet, columns, {heads});
  table.setCaption(Text::tr("Coverage from source %1 in every organ model, with 95 % intervals.").arg(text(source)));
  for (const std::string& pose : view.posesOf(source)) {
    for (const std::string& system : view.armored) {
      table.section(QStringLiteral("%1, %2").arg(text(pose), text(system)));
      for (const StructureKey& total : view.totals) {
        std::vector<Cell> cells{{structureLabel(total.structure, total.kind)}};
        for (const std::string& model : models) {
          const analysis::Coverage coverage = view.coverage(source, system, model, pose, total);
          cells.push_back({percent(coverage.value), range(coverage), false, {}, 1, true});
        }
        table.row(cells);
      }
    }
  }
  table.end();
}

}  // namespace

void writeFindings(const Report& report) {
  Sheet& sheet = report.sheet;
  const RunView& view = report.view;
  sheet.chapter(Text::tr("Key findings"));
  if (report.run.summary.empty()) {
    sheet.paragraph(
        Text::tr("No trial of any source and pose was finished, so there is nothing to say about coverage. "
                 "Run the study again and let it finish."));
    return;
  }
  if (view.armored.empty()) {
    sheet.paragraph(
        Text::tr("The study has no armor, so nothing is covered. The chapters below say how often each "
                 "organ and body region is reached."));
    return;
  }
  if (view.totals.empty()) {
    sheet.paragraph(Text::tr("The study has no organs. The chapter on body regions says how they are covered."));
    return;
  }
  writeSystemSentences(report);
  writeModelDifferences(report);
  sheet.space(2.0);
  for (const std::string& source : view.sources) {
    if (!view.posesOf(source).empty()) {
      writeTotalsFigure(report, source);
      writeTotals(report, source);
      writeAllModels(report, source);
    }
  }
}

}  // namespace lorica::report
