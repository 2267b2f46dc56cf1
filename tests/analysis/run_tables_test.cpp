#include "lorica/analysis/run_tables.h"

#include <gtest/gtest.h>

#include <fstream>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"
#include "temporary_folder.h"

namespace lorica::analysis {
namespace {

namespace fs = std::filesystem;

/// A small run of a study with two organs, kept on disk for all tests here.
class RunTablesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    study::Study study = study::parseStudy(study::templateText("comparison"), "comparison");
    study.organs.resize(2);
    study.organs.front().name = "heart, \"upper\"";
    study.models = {viscera::OrganModel::staticJoint, viscera::OrganModel::staticSkin};
    study.poses.clear();
    study.analyses.compare = true;
    study.analyses.convergence = true;
    study.sources.resize(1);
    loaded_ = new LoadedStudy(load(std::move(study), "comparison", {}));
    RunOptions options;
    options.shots = 3000;
    options.trials = 2;
    result_ = new RunResult(run(*loaded_, options));
  }
  static void TearDownTestSuite() {
    delete loaded_;
    delete result_;
  }

  RunTablesTest() { writeResults(*loaded_, *result_, folder_.path()); }

  void change(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = base::readFile(folder_.path() / name);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    base::writeFileAtomically(folder_.path() / name, text);
  }
  /// Reading fails with a sentence that has all these words.
  void expectTrouble(std::initializer_list<std::string> words) const {
    try {
      readRunTables(folder_.path());
      ADD_FAILURE() << "read a damaged folder";
    } catch (const base::InputError& error) {
      for (const std::string& word : words) {
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " in: " << error.what();
      }
    }
  }

  static LoadedStudy* loaded_;
  static RunResult* result_;
  test::TemporaryFolder folder_;
};

LoadedStudy* RunTablesTest::loaded_ = nullptr;
RunResult* RunTablesTest::result_ = nullptr;

TEST_F(RunTablesTest, GivesBackWhatWasWritten) {
  const RunTables tables = readRunTables(folder_.path());
  const std::vector<ResultRow> rows = summaryRows(*loaded_, *result_);
  ASSERT_EQ(tables.summary.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CoverageRow& read = tables.summary[i];
    EXPECT_EQ(read.place, (RowPlace{rows[i].source, rows[i].system, rows[i].model, rows[i].pose}));
    EXPECT_EQ(read.structure, rows[i].structure);
    EXPECT_EQ(read.any, rows[i].count.any);
    EXPECT_EQ(read.protectedHits, rows[i].count.shielded);
    EXPECT_EQ(read.coverage.value.has_value(), rows[i].coverage().has_value());
    if (read.coverage.value) {
      EXPECT_NEAR(*read.coverage.value, *rows[i].coverage(), 1e-6);
      EXPECT_NEAR(*read.coverage.low, rows[i].coverageInterval()->low, 1e-6);
    }
  }
  EXPECT_EQ(tables.deformation.size(), 2U * result_->poses.size() * 2U);
  EXPECT_EQ(tables.deformation.front().organ, "heart, \"upper\"");
  EXPECT_FALSE(tables.comparisons.empty());
  EXPECT_FALSE(tables.pieces.empty());
  EXPECT_FALSE(tables.convergence.empty());
  EXPECT_TRUE(tables.missing.empty());
  EXPECT_EQ(tables.facts.seed, 1U);
  EXPECT_EQ(tables.facts.study, loaded_->study.name);
  EXPECT_EQ(tables.facts.description, loaded_->study.description);
  EXPECT_EQ(tables.facts.studyHash, study::sha256(study::studyText(loaded_->study)));
  EXPECT_EQ(tables.facts.sources.front().shotsPerTrial, 3000U);
  EXPECT_EQ(tables.facts.runs.front().trials, 2U);
}

TEST_F(RunTablesTest, TablesOfAnEarlierRunInTheFolderAreLeftAlone) {
  base::writeFileAtomically(folder_.path() / "motion.csv", "left by another study\n");
  EXPECT_TRUE(readRunTables(folder_.path()).motion.empty());
}

TEST_F(RunTablesTest, AnAnalysisThatWasStoppedIsNamed) {
  fs::remove(folder_.path() / "pieces.csv");
  EXPECT_EQ(readRunTables(folder_.path()).missing, std::vector<std::string>{"pieces.csv"});
}

TEST_F(RunTablesTest, AMissingFolderOrFileIsNamed) {
  EXPECT_THROW(readRunTables(folder_.path() / "nowhere"), base::InputError);
  fs::remove(folder_.path() / "deformation.csv");
  expectTrouble({"deformation.csv"});
  fs::remove(folder_.path() / "provenance.json");
  expectTrouble({"provenance.json"});
}

TEST_F(RunTablesTest, ACutTableIsFoundOutWhereverItIsCut) {
  const std::string whole = base::readFile(folder_.path() / "summary.csv");
  for (const std::size_t length :
       {whole.size() / 2, whole.size() - 300, whole.size() - 30, std::size_t{300}, std::size_t{0}}) {
    base::writeFileAtomically(folder_.path() / "summary.csv", whole.substr(0, length));
    expectTrouble({"summary.csv", "run the study again"});
  }
}

TEST_F(RunTablesTest, ATableOfAnotherRunIsFoundOut) {
  change("summary.csv", ",rest,", ",kneeling,");
  expectTrouble({"summary.csv", "line 2", "'kneeling'", "pose", "provenance.json"});
}

TEST_F(RunTablesTest, NumbersThatCannotBeAreNamedWithTheirLine) {
  change("summary.csv", ",6000,", ",many,");
  expectTrouble({"summary.csv", "line 2", "'many'", "'shots'"});
  writeResults(*loaded_, *result_, folder_.path());
  change("deformation.csv", ",0.000000,", ",wide,");
  expectTrouble({"deformation.csv", "line 2", "'wide'"});
  writeResults(*loaded_, *result_, folder_.path());
  change("summary.csv", "coverage_lo", "something");
  expectTrouble({"summary.csv", "line 1", "coverage_lo"});
}

TEST_F(RunTablesTest, TablesOfAnalysesAreCheckedToo) {
  change("comparisons.csv", ",rest,", ",kneeling,");
  expectTrouble({"comparisons.csv", "line 2", "'kneeling'"});
  writeResults(*loaded_, *result_, folder_.path());
  const std::string pieces = base::readFile(folder_.path() / "pieces.csv");
  base::writeFileAtomically(folder_.path() / "pieces.csv", pieces.substr(0, pieces.size() - 5));
  expectTrouble({"pieces.csv", "line", "run the study again"});
  writeResults(*loaded_, *result_, folder_.path());
  change("convergence.csv", "0.000000,0.000000", "1.500000,0.000000");
  expectTrouble({"convergence.csv", "line 2", "from 0 to 1", "1.500000"});
}

TEST_F(RunTablesTest, ADamagedProvenanceIsNamedWithItsPlace) {
  change("provenance.json", "\"seed\": 1", "\"seed\": -1");
  expectTrouble({"provenance.json", "/seed"});
  writeResults(*loaded_, *result_, folder_.path());
  change("provenance.json", "\"partial\": false,", "\"partial\": false");
  expectTrouble({"provenance.json", "line 4"});  // where the comma is missed
  base::writeFileAtomically(folder_.path() / "provenance.json", "[1]");
  expectTrouble({"provenance.json", "provenance of a run"});
}

}  // namespace
}  // namespace lorica::analysis
