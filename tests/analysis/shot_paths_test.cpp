#include "lorica/analysis/shot_paths.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/shotline/trace.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {
namespace {

using viscera::OrganModel;

const LoadedStudy& sample() {
  static const LoadedStudy study = load(study::parseStudy(study::templateText("sample"), "sample"), "sample", {});
  return study;
}

const PosedScene& scene() {
  static const PosedScene posed(sample(), {OrganModel::staticJoint, OrganModel::dynamic},
                                resolvePose(sample(), "toe_touch@2").pose, raycast::SceneUse::manyRays, {});
  return posed;
}

TEST(StructureOfMesh, GoesThroughTheLayoutInItsOrder) {
  const shotline::TargetLayout& layout = scene().layout();
  EXPECT_EQ(structureOfMesh(layout, 0), StructureRef{});
  std::uint32_t mesh = 1;
  for (std::size_t p = 0; p < layout.pieces(); ++p) {
    EXPECT_EQ(structureOfMesh(layout, mesh++), (StructureRef{StructureRef::Kind::piece, p, 0}));
  }
  for (std::size_t model = 0; model < 2; ++model) {
    for (std::size_t o = 0; o < layout.organs; ++o) {
      EXPECT_EQ(structureOfMesh(layout, mesh++), (StructureRef{StructureRef::Kind::organ, o, model}));
    }
  }
  EXPECT_EQ(mesh, layout.meshes());
}

TEST(ShotPaths, CountedOneByOneGiveTheTallyOfTheirRun) {
  constexpr std::size_t count = 5000;
  const ShotSource source = shotSourceFor(sample(), 0, scene());
  const std::vector<ShotPath> paths = shotPaths(scene(), source, 7, count);
  const shotline::ShotGenerator shots(source.source, 7, 0);
  const shotline::Tally tally = shotline::trace(scene().scene(), scene().layout(), shots, count, {}).tally;
  ASSERT_EQ(paths.size(), count);
  const auto crossing = [&](const StructureRef& wanted) {
    return static_cast<std::uint64_t>(std::count_if(paths.begin(), paths.end(), [&](const ShotPath& path) {
      return std::any_of(path.crossings.begin(), path.crossings.end(),
                         [&](const ShotCrossing& c) { return c.structure == wanted; });
    }));
  };
  EXPECT_EQ(crossing({}), tally.body(0).any);
  for (std::size_t p = 0; p < sample().pieces.size(); ++p) {
    EXPECT_EQ(crossing({StructureRef::Kind::piece, p, 0}), tally.piece(p).any);
  }
  for (std::size_t model = 0; model < 2; ++model) {
    for (std::size_t o = 0; o < sample().organs.size(); ++o) {
      EXPECT_EQ(crossing({StructureRef::Kind::organ, o, model}), tally.organ(o, model, 0).any);
    }
  }
  EXPECT_GT(tally.body(0).any, 100U) << "or nothing was tested";
}

TEST(ShotPaths, RiseInDistanceAlongAUnitDirection) {
  for (const ShotPath& path : shotPaths(scene(), shotSourceFor(sample(), 0, scene()), 7, 500)) {
    EXPECT_NEAR(path.direction.norm(), 1.0F, 1e-6F);
    EXPECT_TRUE(std::is_sorted(path.crossings.begin(), path.crossings.end(),
                               [](const ShotCrossing& a, const ShotCrossing& b) { return a.distance < b.distance; }));
  }
}

TEST(ShotSource, RefusesToStandOnItsTarget) {
  LoadedStudy study = sample();
  study.study.sources.front().target = study.study.sources.front().position;
  EXPECT_THROW(shotSourceFor(study, 0, scene()), base::InputError);
}

TEST(Load, AgainFromAnEarlierLoadingGivesWhatAFreshOneGives) {
  study::Study changed = sample().study;
  changed.organs.erase(changed.organs.begin() + 2);
  changed.organs.front().lattice.cellMetres = 0.02;
  changed.systems.erase(changed.systems.begin());
  LoadOptions options;
  options.previous = &sample();
  const LoadedStudy again = load(changed, "sample", {}, {}, options);
  const LoadedStudy fresh = load(changed, "sample", {});
  EXPECT_EQ(again.body, sample().body);
  EXPECT_EQ(again.organs[1], sample().organs[1]);
  EXPECT_NE(again.organs[0], sample().organs[0]) << "its lattice is another";
  RunOptions run;
  run.shots = 5000;
  run.trials = 1;
  run.poses = {"rest", "toe_touch@2"};
  const auto bytes = [&](const LoadedStudy& study) {
    const RunResult result = analysis::run(study, run);
    return summaryCsv(summaryRows(study, result)) + provenanceJson(study, result);
  };
  EXPECT_EQ(bytes(again), bytes(fresh));
}

TEST(Load, ForAllModelsGivesTheBytesOfALoadingForTheStudysOwn) {
  LoadOptions all;
  all.allModels = true;
  const LoadedStudy wide = load(sample().study, "sample", {}, {}, all);
  EXPECT_FALSE(wide.body->thesisSites().empty());
  RunOptions run;
  run.shots = 2000;
  run.trials = 1;
  const auto bytes = [&](const LoadedStudy& study) { return provenanceJson(study, analysis::run(study, run)); };
  EXPECT_EQ(bytes(wide), bytes(sample()));
}

TEST(Load, TakesABodyThatLacksTheThesisSitesForOneThatIsMissing) {
  LoadOptions options;
  options.allModels = true;
  options.previous = &sample();
  const LoadedStudy wide = load(sample().study, "sample", {}, {}, options);
  EXPECT_NE(wide.body, sample().body);
  options.previous = &wide;
  EXPECT_EQ(load(sample().study, "sample", {}, {}, options).body, wide.body);
}

}  // namespace
}  // namespace lorica::analysis
