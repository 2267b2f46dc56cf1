#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "lorica/analysis/comparisons.h"
#include "lorica/analysis/import_study.h"
#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "real_data.h"

// Many shots at real anatomy, upright and bent double: every crossing of every closed structure must add up, and it
// must not matter how the work is cut and spread. 200,000 shots a pose; ten million with LORICA_LONG set.

namespace lorica::analysis {
namespace {

namespace fs = std::filesystem;

std::uint64_t shotsPerPose() {
  return std::getenv("LORICA_LONG") != nullptr ? 10'000'000 : 200'000;
}

constexpr std::uint32_t trials = 5;

/// Bound once for all tests.
const LoadedStudy& visibleHuman() {
  static const LoadedStudy study = [] {
    ImportRequest request;
    const fs::path folder = test::realData() / "visible-human-male";
    request.skin = folder / "body.glb";
    for (const auto& entry : fs::directory_iterator(folder / "organs_closed")) {
      request.organs.push_back(entry.path());
    }
    std::sort(request.organs.begin(), request.organs.end());
    request.armor = {{"plates", study::Builtin{"front_plate"}}, {"plates", study::Builtin{"back_plate"}}};
    request.studyFile = fs::current_path() / "visible_human_shots.lorica.json";
    study::Study imported = importStudy(request, {}).study;
    imported.models = {viscera::OrganModel::dynamic};
    imported.analyses.compare = true;
    return load(std::move(imported), request.studyFile, {});
  }();
  return study;
}

std::vector<std::string> poses() {
  const auto clip = std::find_if(visibleHuman().clips.begin(), visibleHuman().clips.end(),
                                 [](const human::Clip& c) { return c.name == "toe_touch"; });
  return {"rest", fmt::format("toe_touch@{:g}", 0.5 * clip->duration())};
}

/// Observer that adds up every shot's crossings of every closed component by itself. Shots start outside of all.
struct Balance {
  const raycast::Scene* scene;
  std::uint64_t unbalanced = 0;
  std::uint64_t crossings = 0;
  Balance fresh() const { return {scene, 0, 0}; }
  void see(std::uint64_t /*shot*/, const raycast::Ray& /*ray*/, std::span<const raycast::Hit> hits) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sums;
    for (const raycast::Hit& hit : hits) {
      sums[{hit.mesh, hit.component}] += hit.sign();
    }
    unbalanced += std::any_of(sums.begin(), sums.end(), [&](const auto& entry) {
      const auto [mesh, component] = entry.first;
      return entry.second != 0 && scene->topology(raycast::MeshIndex{mesh}).closed[component];
    });
    crossings += hits.size();
  }
  void add(const Balance& other) {
    unbalanced += other.unbalanced;
    crossings += other.crossings;
  }
};

TEST(VisibleHumanShots, BalanceOnEveryClosedStructure) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/organs_closed");
  RunOptions options;
  options.poses = poses();
  const RunResult plan = planRun(visibleHuman(), options);
  std::vector<std::string> open;
  for (const auto& organ : visibleHuman().organs) {
    if (organ->topology->hasOpenEdges) {
      open.push_back(organ->name);
    }
  }
  EXPECT_LE(open.size(), 1U) << fmt::format("{}", fmt::join(open, ", ")) << ": all but the arteries close";
  for (const std::string& pose : options.poses) {
    const PosedScene scene(visibleHuman(), plan.models, resolvePose(visibleHuman(), pose).pose,
                           raycast::SceneUse::manyRays, {});
    Balance total{&scene.scene(), 0, 0};
    const raycast::CastCounts counts = shotline::observeShots(
        scene.scene(), shotline::ShotGenerator(plan.sources[0].source, 1, 0), {0, shotsPerPose()}, {}, {}, total);
    fmt::print("{}: {} shots, {} crossings, {} traced again, {} unresolved, {} near an open edge\n", pose, counts.rays,
               total.crossings, counts.retraced, counts.unresolved, counts.nearOpenEdge);
    EXPECT_EQ(counts.rays, shotsPerPose());
    EXPECT_EQ(counts.unresolved, 0U) << pose;
    EXPECT_EQ(total.unbalanced, 0U) << pose;
    EXPECT_GT(total.crossings, shotsPerPose() / 2) << "the shots meet the body";
  }
}

std::string tables(const RunResult& result) {
  const LoadedStudy& study = visibleHuman();
  return summaryCsv(summaryRows(study, result)) + trialsCsv(trialRows(study, result)) +
         comparisonsCsv(comparisons(study, result)) + piecesCsv(study, result) + provenanceJson(study, result);
}

TEST(VisibleHumanShots, GiveTheSameBytesHoweverTheRunIsSpreadAndCut) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/organs_closed");
  RunOptions options;
  options.poses = poses();
  options.trials = trials;
  options.shots = shotsPerPose() / trials;
  options.threads = {1};
  const std::string whole = tables(run(visibleHuman(), options));
  for (const auto& [parts, threads] : {std::pair{1U, 5}, {3U, 2}, {7U, 5}}) {
    options.threads = {threads};
    std::vector<RunResult> computed;
    for (std::uint32_t p = 0; p < parts; ++p) {
      options.part = {p, parts};
      computed.push_back(run(visibleHuman(), options));
    }
    EXPECT_EQ(tables(merge(computed)), whole) << parts << " parts at " << threads << " threads";
  }
}

}  // namespace
}  // namespace lorica::analysis
