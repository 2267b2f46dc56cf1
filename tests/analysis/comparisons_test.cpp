#include "lorica/analysis/comparisons.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "lorica/analysis/directions.h"
#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/table.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {
namespace {

/// The sample with everything compared.
const LoadedStudy& sample() {
  static const LoadedStudy loaded = [] {
    study::Study study = study::parseStudy(study::templateText("sample"), "sample");
    study.analyses.compare = true;
    study.analyses.convergence = true;
    return load(study, "sample", {});
  }();
  return loaded;
}

RunOptions quick() {
  RunOptions options;
  options.poses = {"toe_touch@2"};
  options.shots = 15000;
  options.trials = 4;
  return options;
}

const RunResult& result() {
  static const RunResult made = run(sample(), quick());
  return made;
}

shotline::Tally sumOf(const SourcePoseResult& here) {
  shotline::Tally sum;
  for (const shotline::Tally& trial : here.trials) {
    sum.add(trial);
  }
  return sum;
}

std::size_t linesOf(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Comparisons, DiscordantShotsMakeUpTheDifferenceOfTheCounts) {
  const SourcePoseResult& here = result().results.at(0);
  const shotline::Tally sum = sumOf(here);
  for (std::size_t o = 0; o < sample().organs.size(); ++o) {
    for (std::size_t a = 0; a < result().systems.size(); ++a) {
      for (std::size_t b = 0; b < result().systems.size(); ++b) {
        const std::size_t target = here.pairs.organTarget(o, 1);
        EXPECT_EQ(here.pairs.onlyProtected(target, a, b) + sum.organ(o, 1, b).shielded,
                  here.pairs.onlyProtected(target, b, a) + sum.organ(o, 1, a).shielded);
      }
    }
    EXPECT_EQ(here.pairs.onlyHit(o, 0, 1) + sum.organ(o, 1, 0).any,
              here.pairs.onlyHit(o, 1, 0) + sum.organ(o, 0, 0).any);
  }
}

TEST(Comparisons, AgainstTheUnarmoredBodyAreTheCoverageItself) {
  int checked = 0;
  for (const Comparison& row : comparisons(sample(), result())) {
    if (row.what != "system" || row.first != "unarmored" || !row.coverageSecond) {
      continue;
    }
    EXPECT_EQ(row.onlyFirst, 0U);
    EXPECT_EQ(row.coverageFirst, 0.0);
    EXPECT_LE(row.mcNemarP, row.mcNemarHolm);
    if (row.interval) {
      EXPECT_LE(row.interval->low, *row.difference);
      EXPECT_GE(row.interval->high, *row.difference);
    }
    EXPECT_NEAR(*row.difference, -*row.coverageSecond, 0.1) << row.structure;
    ++checked;
  }
  EXPECT_GT(checked, 10);
}

TEST(Comparisons, OfModelsAtRestFindNoDifference) {
  RunOptions options = quick();
  options.poses = {"rest"};
  const RunResult rest = run(sample(), options);
  int models = 0;
  for (const Comparison& row : comparisons(sample(), rest)) {
    if (row.what == "model") {
      EXPECT_EQ(row.onlyFirst + row.onlySecond, 0U) << row.structure;
      EXPECT_EQ(row.mcNemarP, 1.0);
      EXPECT_FALSE(row.pairedP.has_value()) << "nothing varies";
      ++models;
    }
  }
  EXPECT_GT(models, 10);
  int apart = 0;
  for (const Comparison& row : comparisons(sample(), result())) {
    apart += row.what == "model" && row.mcNemarHolm < 0.01 ? 1 : 0;
  }
  EXPECT_GT(apart, 3) << "bent over, static and dynamic organs lie apart";
}

TEST(Pieces, LeftOutOneAtATimeGiveTheCoverageOfTheStudyWithoutThem) {
  const SourcePoseResult& here = result().results.at(0);
  const shotline::Tally with = sumOf(here);
  for (const std::size_t piece : {std::size_t{0}, sample().pieces.size() - 1}) {
    study::Study without = sample().study;
    std::size_t index = piece;
    std::size_t system = 0;
    while (index >= without.systems[system].pieces.size()) {
      index -= without.systems[system++].pieces.size();
    }
    without.systems[system].pieces.erase(without.systems[system].pieces.begin() + static_cast<std::ptrdiff_t>(index));
    LoadOptions reuse;
    reuse.previous = &sample();
    const LoadedStudy lighter = load(without, "sample", {}, {}, reuse);
    const RunResult made = run(lighter, quick());
    const shotline::Tally tally = sumOf(made.results.at(0));
    for (std::size_t o = 0; o < sample().organs.size(); ++o) {
      EXPECT_EQ(tally.organ(o, 1, system + 1).shielded + here.pairs.soleGuard(here.pairs.organTarget(o, 1), piece),
                with.organ(o, 1, system + 1).shielded)
          << sample().organs[o]->name;
    }
    EXPECT_EQ(tally.body(system + 1).shielded + here.pairs.soleGuard(shotline::PairTally::bodyTarget(), piece),
              with.body(system + 1).shielded);
  }
}

TEST(AnalysisTables, HaveOneFieldPerColumnAndTheRowsOfTheirStructures) {
  const std::string compared = comparisonsCsv(comparisons(sample(), result()));
  for (const std::string& text :
       {compared, piecesCsv(sample(), result()), systemsCsv(sample(), result()), convergenceCsv(sample(), result())}) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    while (std::getline(lines, line)) {
      ASSERT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
    }
    EXPECT_GT(linesOf(text), 10U);
  }
}

TEST(AnalysisTables, StateTheIntegersBehindEveryCoverage) {
  LoadedStudy moving = sample();
  moving.study.analyses.motion = study::MotionSettings{"toe_touch", 60, 30.0};
  RunOptions options = quick();
  options.shots = 2000;
  options.trials = 1;
  const MotionResult motion = overMotion(moving, options);
  struct Stated {
    std::string text;
    const char* coverage;
    const char* any;
    const char* guarded;
  };
  const std::string compared = comparisonsCsv(comparisons(sample(), result()));
  for (const Stated& stated :
       {Stated{compared, "coverage_first", "any_hit_first", "protected_hit_first"},
        {compared, "coverage_second", "any_hit_second", "protected_hit_second"},
        {piecesCsv(sample(), result()), "coverage", "any_hit", "protected_hit"},
        {systemsCsv(sample(), result()), "coverage", "any_hit", "protected_hit"},
        {convergenceCsv(sample(), result()), "coverage", "any_hit", "protected_hit"},
        {motionCsv(moving, motion), "coverage", "any_hit", "protected_hit"},
        {motionSummaryCsv(moving, motion), "coverage_lowest", "worst_any_hit", "worst_protected_hit"}}) {
    const base::Table table(stated.text, stated.any);
    std::size_t hit = 0;
    for (std::size_t r = 0; r < table.rows(); ++r) {
      EXPECT_GT(table.number(r, "shots"), 0.0);
      const double any = table.number(r, stated.any);
      ASSERT_EQ(table.text(r, stated.coverage).empty(), any == 0.0);
      if (any > 0.0) {
        ++hit;
        ASSERT_NEAR(table.number(r, stated.coverage), table.number(r, stated.guarded) / any, 6e-7);
      }
    }
    EXPECT_GT(hit, 0U);
  }
}

TEST(Convergence, EndsAtTheSummary) {
  const std::string text = convergenceCsv(sample(), result());
  for (const ResultRow& row : summaryRows(sample(), result())) {
    if (row.kind != "organ" || !row.coverage()) {
      continue;
    }
    const std::string last = row.source + "," + row.system + "," + row.model + "," + row.pose + "," + row.structure +
                             ",organ,4," + std::to_string(row.shots) + "," + fmt::format("{:.6f}", *row.coverage());
    EXPECT_NE(text.find(last), std::string::npos) << last;
  }
}

TEST(Directions, TheWorstIsSureOfItselfAndNeedsASystemThatCoversAtAll) {
  const auto seen = [](std::uint64_t any, std::uint64_t guarded) {
    ResultRow row;
    row.shots = 1000;
    row.count.any = any;
    row.count.shielded = guarded;
    return row;
  };
  const std::vector<ResultRow> rows{seen(400, 400), seen(2, 0), seen(300, 30), seen(500, 300), seen(0, 0)};
  std::vector<DirectionRow> directions;
  for (const ResultRow& row : rows) {
    directions.push_back({&row, 2.0});
  }
  EXPECT_DOUBLE_EQ(directions[2].unprotectedArea(), 2.0 * 270 / 1000);
  const WorstDirections worst = worstDirections(directions);
  EXPECT_EQ(worst.lowestCoverage, 2U) << "two hits that went through are no evidence";
  EXPECT_EQ(worst.largestUnprotected, 2U);
  directions[3].area = 4.0;
  EXPECT_EQ(worstDirections(directions).largestUnprotected, 3U) << "by area, not by share";
  const std::vector<ResultRow> open{seen(400, 0), seen(3, 0)};
  const std::vector<DirectionRow> uncovered{{&open[0], 1.0}, {&open[1], 1.0}};
  EXPECT_FALSE(worstDirections(uncovered).lowestCoverage);
  EXPECT_FALSE(worstDirections(uncovered).largestUnprotected);
}

TEST(Directions, WeighedByTheirSolidAngleGiveTheAreaOfTheSphereSource) {
  LoadedStudy study = sample();
  study.study.analyses.directions = study::DirectionGrid{30.0, 2000};
  study.study.sources = study::parseStudy(R"({"lorica_study": 1, "human": {"builtin": "human"},
      "sources": [{"name": "all", "type": "sphere", "sequence": "sobol"}]})",
                                          "s")
                            .sources;
  study.shotLists.resize(1);
  RunOptions options = quick();
  options.poses = {"rest"};
  options.shots = 30000;
  const RunResult all = run(study, options);
  const auto directions = byDirection(study, all, {});
  ASSERT_EQ(directions.size(), 72U);
  double area = 0.0;
  double weights = 0.0;
  for (const DirectionResult& direction : directions) {
    const double weight = std::cos(direction.elevation * std::numbers::pi / 180);
    area += weight * direction.area * static_cast<double>(direction.tally.body(0).any) / 2000;
    weights += weight;
  }
  const shotline::Tally sum = sumOf(all.results.at(0));
  const double mean =
      all.sources[0].measure.total * static_cast<double>(sum.body(0).any) / static_cast<double>(sum.shots());
  EXPECT_NEAR(area / weights, mean, 0.03 * mean);
  const std::string csv = directionsCsv(study, all, directions);
  EXPECT_NE(csv.find("\n"), std::string::npos);
  // Each structure that is hit has one direction of lowest coverage.
  std::istringstream lines(csv);
  int marks = 0;
  for (std::string line; std::getline(lines, line);) {
    marks += line.starts_with("full_torso,dynamic,rest,heart,organ") && line[line.size() - 3] == '1' ? 1 : 0;
  }
  EXPECT_EQ(marks, 1);
}

TEST(Motion, MovedFromFrameToFrameCountsWhatScenesBuiltAnewCount) {
  LoadedStudy study = sample();
  study.study.analyses.motion = study::MotionSettings{"toe_touch", 40, 30.0};
  RunOptions options = quick();
  options.shots = 4000;
  options.trials = 2;
  const MotionResult motion = overMotion(study, options);
  ASSERT_EQ(motion.frames.size(), 4U) << "0, 1.333, 2.667 and 4 s of one source";
  EXPECT_EQ(motion.frames.back().seconds, 4.0);
  EXPECT_EQ(motion.frames.front().trials, motion.frames.back().trials) << "it begins and ends at rest";
  const FrameResult& frame = motion.frames[1];
  const PosedScene fresh(study, motion.plan.models, resolvePose(study, motion.plan.poses[1]).pose,
                         raycast::SceneUse::manyRays, {});
  const shotline::ShotGenerator shots(motion.plan.sources[0].source, motion.plan.seed, 1);
  EXPECT_EQ(shotline::trace(fresh.scene(), fresh.layout(), shots, 4000, {}).tally, frame.trials[1]);
  const std::string text = motionCsv(study, motion);
  EXPECT_NE(text.find("front,full_torso,dynamic,2,2.666667,heart,organ"), std::string::npos);
  EXPECT_NE(motionSummaryCsv(study, motion).find("front,full_torso,dynamic,heart,organ,4,"), std::string::npos);
  study.study.analyses.motion->clip = "hand_stand";
  EXPECT_THROW(overMotion(study, options), base::InputError);
}

}  // namespace
}  // namespace lorica::analysis
