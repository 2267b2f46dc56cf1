#include "lorica/analysis/gaps.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"
#include "temporary_folder.h"

namespace lorica::analysis {
namespace {

/// The sample, with gaps for the heart and the skin.
const LoadedStudy& sample() {
  static const LoadedStudy loaded = [] {
    study::Study study = study::parseStudy(study::templateText("sample"), "sample");
    study.analyses = {};
    study.analyses.gaps = study::GapSettings{{"heart", "body"}};
    study.models = {viscera::OrganModel::dynamic};
    return load(study, "sample", {});
  }();
  return loaded;
}

RunOptions quick() {
  RunOptions options;
  options.poses = {"toe_touch@2"};
  options.shots = 40000;
  options.trials = 2;
  return options;
}

const RunResult& result() {
  static const RunResult made = run(sample(), quick());
  return made;
}

const std::vector<Gap>& found() {
  static const std::vector<Gap> gaps = findGaps(sample(), result(), {});
  return gaps;
}

TEST(GapFinder, PatchesHoldTheUnprotectedShotsOfTheRun) {
  for (const ResultRow& row : summaryRows(sample(), result())) {
    if (row.structure != "heart" && row.structure != "body") {
      continue;
    }
    std::uint64_t open = 0;
    std::uint64_t scattered = 0;
    double area = 0.0;
    for (const Gap& gap : found()) {
      if (result().systems[gap.system] == row.system && gap.structure == row.structure) {
        EXPECT_LE(gap.openShots, row.unprotected());
        EXPECT_LE(gap.patch.area, gap.patch.extent);
        (gap.number == 0 ? scattered : open) += gap.patch.open;
        area += gap.patch.area;
      }
    }
    EXPECT_LE(row.unprotected() - open - scattered, row.unprotected() / 100) << "off the skin";
    if (row.structure == "body") {
      EXPECT_EQ(open + scattered, row.unprotected());
    }
    EXPECT_GE(static_cast<double>(open), 0.9 * static_cast<double>(row.unprotected())) << row.system << row.structure;
    EXPECT_EQ(area > 0.0, open > 0);
  }
}

TEST(GapFinder, TheBodyWithoutArmorIsOpenOverItsFrontAndItsPatchesHaveNoNeighbours) {
  for (const Gap& gap : found()) {
    EXPECT_EQ(gap.system == 0 ? gap.neighbours.size() : 0U, 0U);
    EXPECT_TRUE(gap.number == 0 || gap.towards.z() > 0.9) << "shots come from ahead";
    for (const Gap::Neighbour& neighbour : gap.neighbours) {
      EXPECT_LE(neighbour.distance, neighbourReach);
    }
  }
}

TEST(GapFinder, WritesTheSameFilesAtAnyNumberOfThreads) {
  RunOptions options = quick();
  options.shots = 10000;
  options.trials = 1;
  const RunResult once = run(sample(), options);
  std::vector<std::string> first;
  for (const int threads : {1, 2, 5}) {
    const test::TemporaryFolder folder;
    const auto names = writeGaps(sample(), once, {threads}, folder.path());
    ASSERT_EQ(names.size(), 1 + once.systems.size());
    EXPECT_EQ(names[1], "gaps.front.unarmored.dynamic.toe_touch@2.vtp");
    std::vector<std::string> bytes;
    for (const std::string& name : names) {
      bytes.push_back(base::readFile(folder.path() / name));
    }
    EXPECT_NE(bytes[1].find("Name=\"heart share\""), std::string::npos);
    EXPECT_NE(bytes[1].find("Name=\"heart patch\""), std::string::npos);
    EXPECT_TRUE(first.empty() || bytes == first);
    first = bytes;
    std::istringstream lines(bytes[0]);
    std::string line;
    std::getline(lines, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    while (std::getline(lines, line)) {
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
    }
  }
}

TEST(GapFinder, SaysInOneLineWhatItCannotWorkOn) {
  const auto complaint = [](const LoadedStudy& study) -> std::string {
    try {
      planRun(study, quick());
    } catch (const base::InputError& error) {
      return error.place() + ": " + error.text();
    }
    return "none";
  };
  LoadedStudy study = sample();
  study.study.analyses.gaps->structures = {"heart", "gall_bladder"};
  EXPECT_EQ(complaint(study),
            "/analyses/gaps/structures/1: the study has no organ named \"gall_bladder\"; name one, or \"body\" for the "
            "skin");
  study = sample();
  study.study.systems.push_back({"bare", {}});
  EXPECT_NE(complaint(study).find("the system \"bare\" has no pieces"), std::string::npos);
}

}  // namespace
}  // namespace lorica::analysis
