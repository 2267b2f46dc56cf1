#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "lorica/analysis/check.h"
#include "lorica/analysis/results.h"
#include "lorica/analysis/shot_paths.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/geometry/measures.h"
#include "lorica/study/study_file.h"
#include "temporary_folder.h"

namespace lorica::analysis {
namespace {

const LoadedStudy& sample() {
  static const LoadedStudy study = load(study::parseStudy(study::templateText("sample"), "sample"), "sample", {});
  return study;
}

/// The sample with other sources; what is bound is shared.
LoadedStudy shotFrom(const std::string& sources) {
  const std::string text = R"({"lorica_study": 1, "human": {"builtin": "human"}, "sources": )" + sources + "}";
  LoadedStudy study = sample();
  study.study.sources = study::parseStudy(text, "s").sources;
  study.shotLists.resize(study.study.sources.size());
  return study;
}

RunOptions quick(std::uint64_t shots = 4000) {
  RunOptions options;
  options.poses = {"rest"};
  options.shots = shots;
  options.trials = 3;
  return options;
}

const ResultRow& row(const std::vector<ResultRow>& rows, const std::string& source, const std::string& structure) {
  for (const ResultRow& here : rows) {
    if (here.source == source && here.structure == structure && here.system == "full_torso") {
      return here;
    }
  }
  throw std::out_of_range(structure);
}

TEST(Sources, OfEveryTypeRunSideBySideWithTheirBasis) {
  const LoadedStudy study = shotFrom(R"([
      {"name": "cone", "position": [0, 1, 5]},
      {"name": "window", "position": [0, 1, 5], "target_structure": "heart", "sampler": "rectangle",
       "width_m": 0.2, "height_m": 0.2},
      {"name": "beam", "type": "parallel", "azimuth_deg": 0, "elevation_deg": 0, "sequence": "sobol"},
      {"name": "grid", "type": "parallel", "azimuth_deg": 0, "elevation_deg": 0, "sequence": "grid", "cell_mm": 20},
      {"name": "ground", "type": "band", "azimuth_deg": [0, 360], "elevation_deg": [-15, 15]},
      {"name": "all", "type": "sphere"}])");
  const auto rows = summaryRows(study, run(study, quick()));
  EXPECT_EQ(row(rows, "cone", "body").measure.basis, shotline::Basis::solidAngle);
  EXPECT_GT(row(rows, "window", "heart").percentOfShots(), 10.0) << "aimed at the heart";
  const auto area = [&](const char* source) {
    const ResultRow& body = row(rows, source, "body");
    return body.measure.total * body.percentOfShots() / 100;
  };
  // Two samplers measure the same area; a man presents about half a square metre from the front.
  EXPECT_NEAR(area("beam"), area("grid"), 0.03);
  EXPECT_GT(area("beam"), 0.4);
  EXPECT_LT(area("beam"), 0.8);
  EXPECT_LT(area("all"), area("ground")) << "a standing man shows less of himself from above";
  EXPECT_FALSE(row(rows, "grid", "body").independent);
  EXPECT_TRUE(row(rows, "ground", "body").independent);
  const std::string csv = summaryCsv(rows);
  EXPECT_NE(csv.find(",trials,presented area,m2,"), std::string::npos);
  EXPECT_NE(csv.find(",wilson,solid angle,sr,"), std::string::npos);
}

TEST(Sources, OfAGridHaveTheNumberOfShotsOfTheirCells) {
  const LoadedStudy study = shotFrom(
      R"([{"name": "grid", "type": "parallel", "azimuth_deg": 0, "elevation_deg": 0, "sequence": "grid", "cell_mm": 20}])");
  const RunResult result = run(study, quick(7));
  const auto& beam = std::get<shotline::ParallelBeam>(result.sources[0].source.shape);
  EXPECT_EQ(result.sources[0].shots, beam.gridSide * beam.gridSide);
  EXPECT_LE(2 * beam.radius / static_cast<double>(beam.gridSide), 0.02);
}

TEST(Sources, AListIsReadWithTheStudyAndShotAsItStands) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  base::writeFileAtomically(folder / "shots.csv", "x,y,z,az,el\n0,1.25,5,0,0\n0,5,5,0,0\n5,1.25,0,90,0\n");
  study::Study listed = sample().study;
  listed.sources.resize(1);
  listed.sources[0] = study::Source();
  listed.sources[0].name = "listed";
  listed.sources[0].type = study::SourceType::list;
  listed.sources[0].list.path = "shots.csv";
  LoadOptions reuse;
  reuse.previous = &sample();
  const LoadedStudy study = load(listed, folder / "a.lorica.json", {}, {}, reuse);
  const auto rows = summaryRows(study, run(study, quick()));
  EXPECT_EQ(row(rows, "listed", "body").shots, 3U) << "once: they are the same in every trial";
  EXPECT_EQ(row(rows, "listed", "body").count.any, 2U);
  EXPECT_FALSE(row(rows, "listed", "body").coverageInterval().has_value()) << "nothing was drawn at random";
  EXPECT_EQ(checkFile(folder / "shots.csv", {}).front().text, "list of 3 shots");
  base::writeFileAtomically(folder / "shots.csv", "x,y,z,az,el\n0,1.25,5,0,zero\n");
  EXPECT_THROW(load(listed, folder / "a.lorica.json", {}, {}, reuse), base::InputError);
}

TEST(Sources, AimAtAnOrganWhereItIsShot) {
  const LoadedStudy study = shotFrom(R"([{"name": "a", "position": [0, 1, 5], "target_structure": "stomach"}])");
  ASSERT_NE(study.softBody, nullptr) << "the default deformer moves the organs together";
  RunOptions options = quick();
  options.poses = {"toe_touch@2"};
  const RunResult plan = planRun(study, options);
  const PosedScene scene(study, plan.models, resolvePose(study, "toe_touch@2").pose, raycast::SceneUse::manyRays, {});
  const auto organ = std::find_if(study.organs.begin(), study.organs.end(),
                                  [](const auto& candidate) { return candidate->name == "stomach"; });
  geometry::Box3d box;
  for (std::size_t m = 0; m < plan.models.size(); ++m) {
    box.extend(geometry::bounds(scene.organ(static_cast<std::size_t>(organ - study.organs.begin()), m)));
  }
  EXPECT_EQ(std::get<shotline::PointSource>(plan.sources.at(0).source.shape).target, box.center());
}

TEST(Sources, BoundTheBodyOverMorePosesThanAreKept) {
  const LoadedStudy study = shotFrom(R"([{"name": "a", "position": [0, 1, 5]},
      {"name": "b", "type": "parallel", "azimuth_deg": 40, "elevation_deg": 10}, {"name": "c", "type": "sphere"}])");
  RunOptions options = quick();
  options.poses.clear();
  for (int frame = 0; frame < 120; ++frame) {
    options.poses.push_back(fmt::format("toe_touch@{:.3f}", frame / 30.0));
  }
  const std::size_t bytes = 120 * study.body->body().skin.positions.size() * sizeof(geometry::Vec3f);
  ASSERT_GT(bytes, 16U << 20U) << "or all skins would be kept";
  const RunResult plan = planRun(study, options);
  std::vector<geometry::Positions> skins;
  geometry::Box3d box;
  for (const std::string& pose : options.poses) {
    skins.push_back(study.body->pose(resolvePose(study, pose).pose, {}).skin);
    box.extend(geometry::bounds(skins.back()));
  }
  const std::vector<std::span<const geometry::Vec3f>> all(skins.begin(), skins.end());
  const auto& point = std::get<shotline::PointSource>(plan.sources.at(0).source.shape);
  EXPECT_EQ(point.target, box.center());
  EXPECT_EQ(point.halfAngle, shotline::boundingHalfAngle(point.position, point.target, all));
  const auto& beam = std::get<shotline::ParallelBeam>(plan.sources.at(1).source.shape);
  EXPECT_EQ(beam.radius, shotline::boundingRadius(beam.centre, shotline::towards(beam.azimuth, beam.elevation), all));
  const auto& band = std::get<shotline::DirectionBand>(plan.sources.at(2).source.shape);
  EXPECT_EQ(band.radius, shotline::boundingRadius(band.centre, all));
}

std::string complaint(const std::string& sources) {
  try {
    run(shotFrom(sources), quick());
  } catch (const base::InputError& error) {
    return error.place() + ": " + error.text();
  }
  return "none";
}

TEST(Sources, ThatCannotBeSaySoInOneLine) {
  EXPECT_EQ(complaint(R"([{"name": "a", "position": [0, 1.25, 0]}])"),
            "/sources/0/position: the source is inside the body; move it out");
  EXPECT_EQ(complaint(R"([{"name": "a", "position": [0, 1, 5], "target_structure": "gall_bladder"}])"),
            "/sources/0/target_structure: the study has no organ or piece named \"gall_bladder\"");
  EXPECT_EQ(complaint(R"([{"name": "a", "position": [0, 1, 5], "target": [0, 1, 5]}])"),
            "/sources/0: the source stands on its target; move one of them");
}

TEST(Sources, GiveTheSameBytesAtAnyNumberOfThreads) {
  const LoadedStudy study = shotFrom(R"([{"name": "all", "type": "sphere", "sequence": "sobol"},
      {"name": "grid", "type": "parallel", "azimuth_deg": 33, "elevation_deg": 5, "sequence": "grid", "cell_mm": 20}])");
  std::string first;
  for (const int threads : {1, 2, 5}) {
    RunOptions options = quick();
    options.threads = {threads};
    const std::string csv = trialsCsv(trialRows(study, run(study, options)));
    EXPECT_TRUE(first.empty() || csv == first);
    first = csv;
  }
}

TEST(Classes, CountEachShotOnceAndAreNoLessThanAnyOfTheirOrgans) {
  const auto rows = summaryRows(sample(), run(sample(), quick(20000)));
  const ResultRow& essential = row(rows, "front", "essential");
  std::uint64_t most = 0;
  std::uint64_t sum = 0;
  for (const ResultRow& organ : rows) {
    if (organ.kind == "organ" && organ.system == "full_torso" && organ.injuryClass == "essential" &&
        organ.source == "front" && organ.model == essential.model) {
      most = std::max(most, organ.count.any);
      sum += organ.count.any;
    }
  }
  EXPECT_GE(essential.count.any, most);
  EXPECT_LT(essential.count.any, sum) << "or no shot met two of them";
  EXPECT_LE(essential.count.any, row(rows, "front", "organs").count.any);
}

}  // namespace
}  // namespace lorica::analysis
