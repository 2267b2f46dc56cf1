#include <QCoreApplication>
#include <algorithm>

#include "chapters.h"
#include "coverage_marks.h"
#include "lorica/models/numbers.h"
#include "table.h"
#include "words.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

std::optional<double> shareOfBody(const analysis::CoverageRow* row) {
  return row == nullptr ? std::nullopt : row->percentOfBodyHits;
}

QString classMark(const std::string& injuryClass) {
  return injuryClass == "essential" ? Text::tr("E") : injuryClass == "desirable" ? Text::tr("D") : QString();
}

/// A table of one source, pose and system: how often each organ is reached and covered, static and dynamic.
class OrganTable {
 public:
  OrganTable(const Report& report, const std::string& source, const std::string& pose, const std::string& system)
      : report_(report),
        view_(report.view),
        source_(source),
        pose_(pose),
        system_(system),
        both_(view_.shownModels.size() == 2) {}

  void write() {
    std::vector<Column> columns{{30.0, Qt::AlignLeft}, {6.0, Qt::AlignHCenter}};
    std::vector<Head> upper{{QString(), 2}};
    std::vector<Head> lower{{Text::tr("Organ")}, {QString()}};
    const auto group = [&](const QString& title, double width, double change) {
      for (const std::string& model : view_.shownModels) {
        columns.push_back({width});
        lower.push_back(
            {both_ ? (model == *view_.rigid ? Text::tr("static") : Text::tr("dynamic")) : modelLabel(model)});
      }
      if (both_ && change > 0.0) {
        columns.push_back({change});
        lower.push_back({Text::tr("diff.")});
      }
      upper.push_back({title, static_cast<int>(view_.shownModels.size()) + (both_ && change > 0.0 ? 1 : 0)});
    };
    group(Text::tr("Hit, % of body hits"), both_ ? 13.0 : 26.0, 0.0);
    group(Text::tr("Coverage, %"), both_ ? 26.0 : 52.0, 12.0);
    double used = 0.0;
    for (const Column& column : columns) {
      used += column.width;
    }
    columns.push_back({Sheet::width - used, Qt::AlignHCenter});
    upper.push_back({Text::tr("Coverage, %")});
    lower.push_back({QString()});
    Table table(report_.sheet, columns, {upper, lower});
    table.setCaption(caption());
    // Two models need no more than a line; each further one has its own mark.
    const double least = 5.1 + 1.6 * std::max(0.0, static_cast<double>(report_.run.facts.models.size()) - 2.0);
    table.setLeastHeight(least);
    // Rather on the next page than cut, where it fits on one.
    const double height = 20.0 + least * static_cast<double>(view_.organs.size() + view_.totals.size());
    if (height < Sheet::bottom - Sheet::top) {
      report_.sheet.need(height);
    }
    table.setHeadDrawing([this](const std::vector<QRectF>& boxes) { drawCoverageScale(report_.sheet, boxes.back()); });
    for (const StructureKey& organ : view_.organs) {
      row(table, organ, false);
    }
    for (const StructureKey& total : view_.totals) {
      row(table, total, true);
    }
    table.end();
  }

 private:
  QString caption() const {
    const analysis::CoverageRow* body = view_.row(source_, system_, view_.mainModel(), pose_, {"body", "body"});
    const QString base =
        body == nullptr
            ? QString()
            : Text::tr(" %1 of %2 shots hit the body.").arg(models::grouped(body->any), models::grouped(body->shots));
    return Text::tr("Source %1, pose %2, system %3.").arg(text(source_), text(pose_), text(system_)) + base;
  }

  void row(Table& table, const StructureKey& structure, bool total) {
    std::vector<Cell> cells{{structureLabel(structure.structure, structure.kind), {}, total},
                            {total ? QString() : classMark(structure.injuryClass)}};
    std::vector<analysis::Coverage> shown;
    for (const std::string& model : view_.shownModels) {
      cells.push_back({number(shareOfBody(view_.row(source_, system_, model, pose_, structure)), 2)});
    }
    for (const std::string& model : view_.shownModels) {
      shown.push_back(view_.coverage(source_, system_, model, pose_, structure));
      cells.push_back({percent(shown.back().value), range(shown.back()), total, {}, 1, true});
    }
    if (both_) {
      cells.push_back({points(difference(shown[0], shown[1])), {}, apart(shown[0], shown[1])});
    }
    cells.emplace_back();
    std::vector<MarkedCoverage> marks;
    for (const std::string& model : report_.run.facts.models) {
      marks.push_back({markOf(model), view_.coverage(source_, system_, model, pose_, structure)});
    }
    table.row(cells, {[this, marks](const QRectF& box) { drawCoverage(report_.sheet, box, marks); }});
  }

  const Report& report_;
  const RunView& view_;
  const std::string& source_;
  const std::string& pose_;
  const std::string& system_;
  bool both_;
};

/// Body regions of one source: a row for each region, the poses side by side.
void writeRegions(const Report& report, const std::string& source, const std::string& system) {
  const RunView& view = report.view;
  const std::vector<std::string> poses = view.posesOf(source);
  constexpr std::size_t together = 6;
  constexpr double label = 36.0;
  for (std::size_t begin = 0; begin < poses.size(); begin += together) {
    const std::size_t end = std::min(poses.size(), begin + together);
    std::vector<Column> columns{{label, Qt::AlignLeft}};
    std::vector<Head> heads{{Text::tr("Region")}};
    for (std::size_t p = begin; p < end; ++p) {
      columns.push_back({(Sheet::width - label) / static_cast<double>(std::max<std::size_t>(end - begin, 3))});
      heads.push_back({text(poses[p])});
    }
    // A column that only fills the width.
    double used = 0.0;
    for (const Column& column : columns) {
      used += column.width;
    }
    if (used + 1.0 < Sheet::width) {
      columns.push_back({Sheet::width - used});
      heads.emplace_back();
    }
    Table table(report.sheet, columns, {heads});
    table.setCaption(Text::tr("Coverage of body regions from source %1 under %2, %, with 95 % intervals. A shot counts "
                              "for every region whose skin it crosses.")
                         .arg(text(source), text(system)));
    std::vector<StructureKey> rows = view.regions;
    rows.push_back({"body", "body"});
    for (const StructureKey& region : rows) {
      std::vector<Cell> cells{{structureLabel(region.structure, region.kind), {}, region.kind == "body"}};
      for (std::size_t p = begin; p < end; ++p) {
        const analysis::Coverage coverage = view.coverage(source, system, view.mainModel(), poses[p], region);
        cells.push_back({percent(coverage.value), range(coverage)});
      }
      table.row(cells);
    }
    table.end();
  }
}

}  // namespace

void writeOrganCoverage(const Report& report) {
  const RunView& view = report.view;
  if (view.organs.empty() || report.run.summary.empty()) {
    return;
  }
  Sheet& sheet = report.sheet;
  sheet.chapter(Text::tr("Coverage of organs"));
  QString words = Text::tr(
      "Hit: share of the shots that hit the body and cross the organ. Coverage: share of the shots that cross the "
      "organ whose way leads through armor first; a dash where no shot crosses it. E: essential, D: desirable. Small: "
      "95 % intervals.");
  if (view.shownModels.size() == 2) {
    words += Text::tr(
                 " Columns static and dynamic are the models \u201c%1\u201d and \u201c%2\u201d; differences are "
                 "dynamic minus static in percentage points, bold where the intervals lie apart.")
                 .arg(modelLabel(*view.rigid), modelLabel(*view.deforming));
  }
  sheet.paragraph(words);
  drawMarkLegend(sheet, report.run.facts.models);
  const std::vector<std::string>& systems = view.armored.empty() ? report.run.facts.systems : view.armored;
  for (const std::string& source : view.sources) {
    for (const std::string& pose : view.posesOf(source)) {
      for (const std::string& system : systems) {
        OrganTable(report, source, pose, system).write();
      }
    }
  }
}

void writeRegionCoverage(const Report& report) {
  const RunView& view = report.view;
  if (view.regions.empty() || view.armored.empty() || report.run.summary.empty()) {
    return;
  }
  report.sheet.chapter(Text::tr("Coverage of body regions"));
  for (const std::string& source : view.sources) {
    for (const std::string& system : view.armored) {
      writeRegions(report, source, system);
    }
  }
}

}  // namespace lorica::report
