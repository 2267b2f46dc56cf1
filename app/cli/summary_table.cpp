#include "summary_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "lorica/base/readable.h"
#include "lorica/study/reserved_names.h"

namespace lorica::cli {

namespace {

using analysis::ResultRow;

const ResultRow* find(const std::vector<ResultRow>& rows, const ResultRow& like, const std::string& model) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ResultRow& row) {
    return row.source == like.source && row.system == like.system && row.pose == like.pose && row.model == model &&
           row.kind == like.kind && row.structure == like.structure;
  });
  return found == rows.end() ? nullptr : &*found;
}

std::string cells(const ResultRow& row) {
  const auto percent = row.percentOfBodyHits();
  const auto coverage = row.coverage();
  const auto interval = row.coverageInterval();
  const std::string hit = percent ? fmt::format("{:.2f}", *percent) : "-";
  std::string covered = "-";
  if (coverage) {
    covered = fmt::format("{:5.1f}", 100 * *coverage);
    covered += interval ? fmt::format(" ({:5.1f} to {:5.1f})", 100 * interval->low, 100 * interval->high)
                        : std::string(17, ' ');
  }
  return fmt::format("{:>8}  {:>24}", hit, covered);
}

}  // namespace

std::string summaryTable(const analysis::RunResult& result, const std::vector<ResultRow>& rows) {
  std::string text;
  const bool onlyUnarmored = result.systems.size() == 1;
  for (const ResultRow& head : rows) {
    const bool opensTable = head.structure == "body" && head.kind == "body" && head.model == rows.front().model;
    if (!opensTable || (head.system == study::unarmored && !onlyUnarmored)) {
      continue;
    }
    text += fmt::format("\nsource {}, pose {}, armor system {}\n", head.source, head.pose, head.system);
    text += fmt::format("{} shots, {} hit the body ({:.3f} %)\n", base::readableCount(head.shots),
                        base::readableCount(head.count.any), head.percentOfShots());
    std::size_t widest = 9;
    for (const ResultRow& row : rows) {
      widest = std::max(widest, row.kind == "region" ? 0 : row.structure.size());
    }
    const int width = static_cast<int>(widest);
    std::string first = fmt::format("{:<{}}", "", width);
    std::string second = fmt::format("{:<{}}", "structure", width);
    for (const viscera::OrganModel model : result.models) {
      first += fmt::format("   {:<34}", viscera::name(model));
      second += fmt::format("   {:>8}  {:>24}", "hit %", "coverage % (95 %)");
    }
    text += first.substr(0, first.find_last_not_of(' ') + 1) + "\n" + second + "\n";
    for (const ResultRow& row : rows) {
      const bool here =
          row.source == head.source && row.system == head.system && row.pose == head.pose && row.model == head.model;
      const bool shown = row.kind == "organ" ||
                         (row.kind == "aggregate" && row.structure == "organs" && row.count.any > 0) ||
                         (row.kind == "body" && row.structure == "body");
      if (!here || !shown) {
        continue;
      }
      text += fmt::format("{:<{}}", row.structure, width);
      for (const viscera::OrganModel model : result.models) {
        const ResultRow* cell = find(rows, row, viscera::name(model));
        text += "   " + (cell != nullptr ? cells(*cell) : std::string(34, ' '));
      }
      text += "\n";
    }
  }
  text +=
      "\nhit %: shots that cross the structure, of the shots that hit the body.\n"
      "coverage: of the shots that cross the structure, those that meet armor first, with its 95 % interval: Wilson's "
      "for\n"
      "independent shots; across the trials for grids and sobol, none where no two trials differ; none for a list.\n";
  return text;
}

}  // namespace lorica::cli
