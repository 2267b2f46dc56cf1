#include "lorica/analysis/directions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/units.h"
#include "lorica/geometry/measures.h"
#include "lorica/io/export.h"

namespace lorica::analysis {

namespace {

/// Middles of the cells of a grid of directions, degrees.
std::vector<std::array<double, 2>> directionsOf(const study::DirectionGrid& grid) {
  std::vector<std::array<double, 2>> directions;
  const auto columns = static_cast<int>(std::lround(360.0 / grid.step));
  const auto rows = static_cast<int>(std::lround(180.0 / grid.step));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      directions.push_back({column * 360.0 / columns, -90.0 + (row + 0.5) * 180.0 / rows});
    }
  }
  return directions;
}

}  // namespace

std::vector<DirectionResult> byDirection(const LoadedStudy& study, const RunResult& plan, base::Threads threads,
                                         const base::Progress& progress) {
  const study::DirectionGrid& grid = *study.study.analyses.directions;
  const auto directions = directionsOf(grid);
  std::vector<DirectionResult> results;
  const double steps = static_cast<double>(plan.poses.size() * directions.size());
  for (std::size_t p = 0; p < plan.poses.size(); ++p) {
    const PosedScene scene(study, plan.models, resolvePose(study, plan.poses[p]).pose, raycast::SceneUse::manyRays,
                           threads);
    const std::span<const geometry::Vec3f> skin(scene.body().skin);
    for (const auto& [azimuth, elevation] : directions) {
      shotline::ParallelBeam beam;
      beam.azimuth = base::radians(azimuth);
      beam.elevation = base::radians(elevation);
      beam.centre = geometry::bounds(skin).center();
      beam.radius =
          shotline::boundingRadius(beam.centre, shotline::towards(beam.azimuth, beam.elevation), std::span(&skin, 1));
      const shotline::Source source{fmt::format("direction {} {}", azimuth, elevation), beam};
      const double begin = static_cast<double>(results.size());
      DirectionResult here{p, azimuth, elevation, shotline::measureOf(source).total, {}};
      here.tally = shotline::trace(scene.scene(), scene.layout(), shotline::ShotGenerator(source, plan.seed, 0),
                                   grid.shots, threads, progress.part(begin / steps, (begin + 1.0) / steps))
                       .tally;
      results.push_back(std::move(here));
    }
  }
  return results;
}

double DirectionRow::unprotectedArea() const {
  return row->shots == 0 ? 0.0 : area * static_cast<double>(row->unprotected()) / static_cast<double>(row->shots);
}

WorstDirections worstDirections(std::span<const DirectionRow> rows) {
  WorstDirections worst;
  if (std::none_of(rows.begin(), rows.end(), [](const DirectionRow& here) { return here.row->count.shielded > 0; })) {
    return worst;
  }
  double lowest = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DirectionRow& here = rows[i];
    if (here.row->coverage()) {
      const double surely = here.row->coverageInterval()->high;
      if (!worst.lowestCoverage || surely < lowest ||
          (surely == lowest && here.unprotectedArea() > rows[*worst.lowestCoverage].unprotectedArea())) {
        worst.lowestCoverage = i;
        lowest = surely;
      }
    }
    if (here.row->unprotected() > 0 &&
        (!worst.largestUnprotected || here.unprotectedArea() > rows[*worst.largestUnprotected].unprotectedArea())) {
      worst.largestUnprotected = i;
    }
  }
  return worst;
}

std::string directionsCsv(const LoadedStudy& study, const RunResult& plan,
                          const std::vector<DirectionResult>& results) {
  struct Row {
    ResultRow row;
    const DirectionResult* direction;
  };
  // Every direction as a run of one trial, so that rows mean what they mean in the summary.
  std::map<std::array<std::string, 5>, std::vector<Row>> groups;
  std::vector<std::array<std::string, 5>> order;
  for (const DirectionResult& direction : results) {
    RunResult single;
    single.sources.resize(1);
    single.sources[0].source.shape = shotline::ParallelBeam{};
    single.poses = {plan.poses[direction.pose]};
    single.models = plan.models;
    single.systems = plan.systems;
    single.results = {{0, 0, {direction.tally}, {}, {}}};
    for (ResultRow& row : summaryRows(study, single)) {
      if (row.structure == "miss" && row.kind == "body") {
        continue;  // nothing is covered there
      }
      const std::array<std::string, 5> key{row.system, row.model, row.pose, row.kind, row.structure};
      std::vector<Row>& group = groups[key];
      if (group.empty()) {
        order.push_back(key);
      }
      group.push_back({std::move(row), &direction});
    }
  }
  std::string text =
      "system,model,pose,structure,kind,class,azimuth_deg,elevation_deg,shots,any_hit,protected_hit,coverage,coverage_"
      "lo,"
      "coverage_hi,presented_area_m2,unprotected_area_m2,lowest_coverage,largest_unprotected_area\n";
  for (const auto& key : order) {
    const std::vector<Row>& group = groups[key];
    std::vector<DirectionRow> seen;
    for (const Row& here : group) {
      seen.push_back({&here.row, here.direction->area});
    }
    const WorstDirections worst = worstDirections(seen);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const Row& here = group[i];
      const auto mark = [&](const std::optional<std::size_t>& place) { return std::string(place == i ? "1" : "0"); };
      const ResultRow& row = here.row;
      const auto interval = row.coverageInterval();
      text += io::csvRow(std::array{
          row.system, row.model, row.pose, row.structure, row.kind, row.injuryClass,
          fmt::format("{}", here.direction->azimuth), fmt::format("{}", here.direction->elevation),
          std::to_string(row.shots), std::to_string(row.count.any), std::to_string(row.count.shielded),
          io::csvNumber(row.coverage()), interval ? io::csvNumber(interval->low) : std::string(),
          interval ? io::csvNumber(interval->high) : std::string(),
          io::csvNumber(here.direction->area * row.percentOfShots() / 100.0), io::csvNumber(seen[i].unprotectedArea()),
          mark(worst.lowestCoverage), mark(worst.largestUnprotected)});
    }
  }
  return text;
}

}  // namespace lorica::analysis
