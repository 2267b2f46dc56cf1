#include "lorica/analysis/run.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <sstream>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {
namespace {

using geometry::Vec3f;

/// The embedded sample, loaded once.
const LoadedStudy& sample() {
  static const LoadedStudy study = load(study::parseStudy(study::templateText("sample"), "sample"), "sample", {});
  return study;
}

RunOptions quick(int threads = 0) {
  RunOptions options;
  options.poses = {"rest", "toe_touch@2"};
  options.shots = 30000;
  options.trials = 2;
  options.threads = {threads};
  return options;
}

TEST(PosedScene, AtRestHasTheBitsOfEveryRestVertex) {
  const PosedScene scene(sample(), {viscera::OrganModel::staticJoint, viscera::OrganModel::dynamic}, std::nullopt,
                         raycast::SceneUse::manyFrames, {});
  const auto same = [](const geometry::Positions& a, const geometry::Positions& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3f)) == 0;
  };
  EXPECT_TRUE(same(scene.body().skin, sample().body->body().skin.positions));
  for (std::size_t o = 0; o < sample().organs.size(); ++o) {
    EXPECT_TRUE(same(scene.organ(o, 0), sample().organs[o]->rig.rest.positions)) << sample().organs[o]->name;
    EXPECT_TRUE(same(scene.organ(o, 1), sample().organs[o]->rig.rest.positions)) << sample().organs[o]->name;
  }
  for (std::size_t p = 0; p < sample().pieces.size(); ++p) {
    EXPECT_TRUE(same(scene.piece(p), sample().pieces[p]->rig.rest.positions)) << sample().pieces[p]->name;
  }
}

TEST(PosedScene, ComesBackToTheRestBitsAfterOtherPoses) {
  PosedScene scene(sample(), {viscera::OrganModel::dynamic}, std::nullopt, raycast::SceneUse::manyFrames, {});
  const geometry::Positions heart = scene.organ(0, 0);
  scene.move(resolvePose(sample(), "toe_touch@2").pose, {});
  EXPECT_NE(std::memcmp(heart.data(), scene.organ(0, 0).data(), heart.size() * sizeof(Vec3f)), 0);
  scene.move(std::nullopt, {});
  EXPECT_EQ(std::memcmp(heart.data(), scene.organ(0, 0).data(), heart.size() * sizeof(Vec3f)), 0);
}

TEST(Run, GivesTheSameBytesAtOneTwoAndFiveThreads) {
  std::vector<std::string> summaries;
  for (const int threads : {1, 2, 5}) {
    const RunResult result = run(sample(), quick(threads));
    summaries.push_back(summaryCsv(summaryRows(sample(), result)) + trialsCsv(trialRows(sample(), result)) +
                        provenanceJson(sample(), result));
  }
  EXPECT_EQ(summaries[0], summaries[1]);
  EXPECT_EQ(summaries[0], summaries[2]);
}

TEST(Run, CutInPartsAndMergedGivesTheBytesOfTheWhole) {
  const auto tables = [](const RunResult& result) {
    return summaryCsv(summaryRows(sample(), result)) + trialsCsv(trialRows(sample(), result)) +
           provenanceJson(sample(), result) + deformationCsv(deformationTables(sample(), result));
  };
  RunOptions options = quick();
  options.poses = {"toe_touch@2"};
  options.shots = 10001;  // no multiple of the number of parts
  const std::string whole = tables(run(sample(), options));
  std::vector<RunResult> parts;
  for (std::uint32_t p = 0; p < 3; ++p) {
    options.part = {p, 3};
    parts.push_back(run(sample(), options));
  }
  EXPECT_EQ(tables(merge(parts)), whole);
}

TEST(Run, WithARuleForStoppingCannotBeCutInParts) {
  LoadedStudy stopping = sample();
  stopping.study.stop.emplace();
  stopping.study.stop->structures = {stopping.organs[0]->name};
  RunOptions options = quick();
  options.part = {0, 2};
  try {
    planRun(stopping, options);
    FAIL() << "a part does not see all shots";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.place(), "/stop");
  }
}

TEST(Run, PartsOfAnotherCutAreNoWhole) {
  RunResult half;
  half.part = {0, 2};
  EXPECT_THROW(merge({}), base::CallerError);
  EXPECT_THROW(merge(std::vector{half}), base::CallerError);
  EXPECT_THROW(merge(std::vector{half, half}), base::CallerError);
}

TEST(Run, LeavesNoShotUnresolved) {
  for (const SourcePoseResult& here : run(sample(), quick()).results) {
    EXPECT_EQ(here.counts.unresolved, 0U);
    EXPECT_EQ(here.counts.rays, 60000U);
  }
}

TEST(Run, AnotherSeedGivesOtherCountsThatAgreeWithinChance) {
  RunOptions other = quick();
  other.seed = 99;
  const auto first = summaryRows(sample(), run(sample(), quick()));
  const auto second = summaryRows(sample(), run(sample(), other));
  EXPECT_NE(first[0].count.any, second[0].count.any);
  const double share = first[0].percentOfShots() / 100;
  EXPECT_NEAR(share, second[0].percentOfShots() / 100, 6 * std::sqrt(2 * share * (1 - share) / 60000));
}

TEST(Run, IsPartialWhenCancelledAndSaysSo) {
  base::Task task;
  task.cancel();
  const RunResult result = run(sample(), quick(), base::Progress(task));
  EXPECT_TRUE(result.partial);
  EXPECT_NE(provenanceJson(sample(), result).find("\"partial\": true"), std::string::npos);
}

TEST(Run, RefusesAPoseItDoesNotKnowAndATimeBeyondTheClip) {
  RunOptions options = quick();
  options.poses = {"hand_stand"};
  EXPECT_THROW(run(sample(), options), base::InputError);
  options.poses = {"toe_touch@4.5"};
  EXPECT_THROW(run(sample(), options), base::InputError);
  options.poses = {"no_clip@1"};
  EXPECT_THROW(run(sample(), options), base::InputError);
}

/// Rows keyed by everything that names them.
std::map<std::string, ResultRow> keyed(const std::vector<ResultRow>& rows) {
  std::map<std::string, ResultRow> map;
  for (const ResultRow& row : rows) {
    const std::string key = row.source + "/" + row.system + "/" + row.model + "/" + row.pose + "/" + row.kind + "/" +
                            row.structure + (row.trial ? "/" + std::to_string(*row.trial) : "");
    EXPECT_TRUE(map.emplace(key, row).second) << key << " stands twice";
  }
  return map;
}

TEST(Tables, KeepTheDefinitionsOfEveryRow) {
  const RunResult result = run(sample(), quick());
  const auto rows = keyed(summaryRows(sample(), result));
  for (const auto& [key, row] : rows) {
    EXPECT_EQ(row.unprotected() + row.count.shielded, row.count.any) << key;
    EXPECT_LE(row.count.first, row.count.any) << key;
    EXPECT_LE(row.count.withBody, row.bodyHits) << key;
    EXPECT_EQ(row.shots, 60000U) << key;
    EXPECT_EQ(row.coverage().has_value(), row.count.any > 0) << key;
    if (row.system == "unarmored") {
      EXPECT_EQ(row.count.shielded, 0U) << key;
    }
  }
  const auto& body = rows.at("front/full_torso/dynamic/rest/body/body");
  const auto& miss = rows.at("front/full_torso/dynamic/rest/body/miss");
  EXPECT_EQ(body.count.any + miss.count.any, body.shots);
}

TEST(Tables, WhatArmorCannotChangeIsTheSameUnderEverySystemAndRestUnderEveryModel) {
  const auto rows = keyed(summaryRows(sample(), run(sample(), quick())));
  for (const auto& [key, row] : rows) {
    if (row.kind == "armor" || row.structure == "armor") {
      continue;
    }
    const ResultRow& bare =
        rows.at(row.source + "/unarmored/" + row.model + "/" + row.pose + "/" + row.kind + "/" + row.structure);
    EXPECT_EQ(row.count.any, bare.count.any) << key;
    if (row.pose == "rest") {
      const ResultRow& other =
          rows.at(row.source + "/" + row.system + "/static_joint/rest/" + row.kind + "/" + row.structure);
      EXPECT_EQ(row.count, other.count) << key << ": all models are one at rest";
    }
  }
}

TEST(Tables, TrialsAddUpToTheSummary) {
  const RunResult result = run(sample(), quick());
  const auto summary = keyed(summaryRows(sample(), result));
  const auto trials = keyed(trialRows(sample(), result));
  for (const auto& [key, row] : summary) {
    EXPECT_EQ(row.count.any, trials.at(key + "/1").count.any + trials.at(key + "/2").count.any) << key;
  }
}

TEST(Tables, HaveOneFieldPerColumnInEveryLine) {
  const RunResult result = run(sample(), quick());
  for (const std::string& text : {summaryCsv(summaryRows(sample(), result)), trialsCsv(trialRows(sample(), result))}) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    std::size_t count = 0;
    while (std::getline(lines, line)) {
      ASSERT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
      ++count;
    }
    EXPECT_GT(count, 100U);
  }
}

}  // namespace
}  // namespace lorica::analysis
