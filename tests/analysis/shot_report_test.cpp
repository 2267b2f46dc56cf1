#include "lorica/analysis/shot_report.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"
#include "temporary_folder.h"

namespace lorica::analysis {
namespace {

const LoadedStudy& sample() {
  static const LoadedStudy study = load(study::parseStudy(study::templateText("sample"), "sample"), "sample", {});
  return study;
}

RunOptions quick(int threads = 0) {
  RunOptions options;
  options.poses = {"rest", "toe_touch@2"};
  options.shots = 6000;
  options.trials = 2;
  options.threads = {threads};
  return options;
}

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) {
    fields.push_back(field);
  }
  return fields;
}

class Hits : public testing::Test {
 protected:
  std::string written(const RunResult& result, HitFormat format, int threads) const {
    writeHits(sample(), result, format, folder_, {threads});
    return base::readFile(folder_ / (format == HitFormat::csv ? "hits.csv" : "hits.vtp"));
  }
  test::TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "hits";
};

TEST_F(Hits, HaveTheShotsOfTheSummaryForEveryStructure) {
  const RunResult result = run(sample(), quick());
  std::istringstream lines(written(result, HitFormat::csv, 0));
  std::string line;
  std::getline(lines, line);
  const auto columns = fieldsOf(line).size();
  std::map<std::string, std::set<std::string>> shots;  // per pose, group and structure, the trials and shots
  while (std::getline(lines, line)) {
    const auto fields = fieldsOf(line);
    ASSERT_LE(fields.size(), columns);
    shots[fields[1] + "/" + fields[7] + "/" + fields[5]].insert(fields[2] + ":" + fields[3]);
  }
  int compared = 0;
  for (const ResultRow& row : summaryRows(sample(), result)) {
    const std::string group = row.kind == "organ" ? row.model : row.kind == "armor" ? row.system : "";
    if (row.kind == "organ" || row.kind == "armor" || row.structure == "body") {
      EXPECT_EQ(shots[row.pose + "/" + group + "/" + row.structure].size(), row.count.any) << row.structure;
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST_F(Hits, AreTheSameBytesAtAnyNumberOfThreadsAndLeaveNothingWhenCancelled) {
  const RunResult result = run(sample(), quick());
  for (const HitFormat format : {HitFormat::csv, HitFormat::vtp}) {
    EXPECT_EQ(written(result, format, 1), written(result, format, 5));
  }
  std::filesystem::remove_all(folder_);
  base::Task task;
  task.cancel();
  EXPECT_THROW(writeHits(sample(), result, HitFormat::csv, folder_, {}, base::Progress(task)), base::Cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST(ShotDetails, ArePassagesThatLieInTheBodyInTheirOrder) {
  const RunResult plan = planRun(sample(), quick());
  int withOrgans = 0;
  for (std::uint64_t shot = 0; shot < 12; ++shot) {
    for (const ShotDetails& details : shotDetails(sample(), plan, {"front", 1, shot}, {})) {
      double last = 0.0;
      for (const NamedPassage& named : details.passages) {
        EXPECT_GE(named.passage.enter, last);
        EXPECT_GE(named.passage.thickness(), 0.0);
        EXPECT_LE(named.passage.normalThickness(), named.passage.thickness());
        last = named.passage.enter;
        withOrgans += named.kind == "organ" ? 1 : 0;
        EXPECT_TRUE(named.kind != "organ" || named.depth.has_value());
      }
    }
  }
  EXPECT_GT(withOrgans, 2);
}

TEST(ShotReport, NamesTheShotAndCutsItForEverySystemAndModel) {
  RunOptions options = quick();
  options.poses = {"rest"};
  const RunResult plan = planRun(sample(), options);
  const std::string report = shotReport(sample(), plan, {"front", 0, 17}, {});
  EXPECT_NE(report.find("shot front:1:17, pose rest"), std::string::npos) << report;
  EXPECT_EQ(report, shotReport(sample(), plan, {"front", 0, 17}, {1}));
}

TEST(ShotReport, TellsNamesThatAreNone) {
  for (const char* text : {"", "front", "front:1", "front:0:5", "front:1:x", ":1:2", "front:1:-2"}) {
    EXPECT_THROW(shotNamed(text), base::InputError) << text;
  }
  EXPECT_EQ(shotNamed("a:b:2:7").source, "a:b");
  EXPECT_EQ(shotNamed("a:b:2:7").trial, 1U);
  const RunResult plan = planRun(sample(), quick());
  EXPECT_THROW(shotDetails(sample(), plan, {"rear", 0, 0}, {}), base::InputError);
  EXPECT_THROW(shotDetails(sample(), plan, {"front", 2, 0}, {}), base::InputError);
  EXPECT_THROW(shotDetails(sample(), plan, {"front", 0, 6000}, {}), base::InputError);
}

TEST(StopRule, GoesOnUntilTheIntervalsAreNarrowOrTheLimitIsReached) {
  LoadedStudy study = sample();
  RunOptions options = quick();
  options.poses = {"rest"};
  study.study.trials = 2;
  study.study.stop = study::StopRule{{"stomach"}, 0.03, 60};
  const RunResult result = run(study, options);
  for (const ResultRow& row : summaryRows(study, result)) {
    if (row.structure == "stomach" && row.system != "unarmored") {
      const auto interval = row.coverageInterval();
      ASSERT_TRUE(interval.has_value());
      EXPECT_LE(interval->high - interval->low, 0.06);
    }
  }
  EXPECT_GT(result.results[0].trials.size(), 2U) << "or it had nothing to do";
  EXPECT_LT(result.results[0].trials.size(), 60U);
  study.study.stop->maxTrials = 3;
  const RunResult limited = run(study, options);
  EXPECT_EQ(limited.results[0].trials.size(), 3U);
  EXPECT_EQ(result.results[0].goalReached, true);
  EXPECT_EQ(limited.results[0].goalReached, false);
  const auto told = std::find_if(limited.issues.begin(), limited.issues.end(), [](const base::Issue& issue) {
    return issue.text.find("not met after 3 trials") != std::string::npos &&
           issue.text.find("stomach") != std::string::npos;
  });
  EXPECT_NE(told, limited.issues.end());
  study.study.stop->maxTrials = 1;
  EXPECT_THROW(run(study, options), base::InputError) << "fewer than are shot in any case";
  study.study.stop->maxTrials = 3;
  study.study.stop->structures = {"gall_bladder"};
  EXPECT_THROW(run(study, options), base::InputError);
}

TEST(StopRule, EndsWhereTheTrialsOfAGridDoNotDiffer) {
  LoadedStudy study = sample();
  RunOptions options = quick();
  options.poses = {"rest"};
  study.study.trials = 2;
  study.study.sources.resize(1);
  study.study.sources[0].type = study::SourceType::parallel;
  study.study.sources[0].sequence = study::Sequence::grid;
  study.study.sources[0].cell = 0.02;
  // From behind nothing of the spleen is open under the vest, in any trial.
  study.study.sources[0].azimuth = {180.0, 180.0};
  study.study.stop = study::StopRule{{"kidney_left"}, 0.05, 40};
  const RunResult result = run(study, options);
  EXPECT_LT(result.results[0].trials.size(), 40U);
  EXPECT_EQ(result.results[0].goalReached, true);
}

}  // namespace
}  // namespace lorica::analysis
