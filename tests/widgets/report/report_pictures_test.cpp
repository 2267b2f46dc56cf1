#include <gtest/gtest.h>

#include <algorithm>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/report/report.h"
#include "lorica/study/study_file.h"
#include "pdf_text.h"
#include "temporary_folder.h"

namespace lorica::report {
namespace {

namespace fs = std::filesystem;

/// A small run of the built-in human, with its report.
class RunReport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    study::Study study = study::parseStudy(study::templateText("comparison"), "comparison");
    study.organs.resize(1);
    study.models = {viscera::OrganModel::staticSkin};
    study.poses.clear();
    study.sources.resize(1);
    loaded_ = new analysis::LoadedStudy(analysis::load(std::move(study), "comparison", {}));
    analysis::RunOptions options;
    options.shots = 3000;
    options.trials = 2;
    result_ = new analysis::RunResult(analysis::run(*loaded_, options));
  }
  static void TearDownTestSuite() {
    delete loaded_;
    delete result_;
  }

  RunReport() { analysis::writeResults(*loaded_, *result_, folder_.path()); }
  fs::path pdf() const { return folder_.path() / "report.pdf"; }
  void make() const { writeRunReport(*loaded_, *result_, folder_.path(), pdf(), {}); }

  static analysis::LoadedStudy* loaded_;
  static analysis::RunResult* result_;
  test::TemporaryFolder folder_;
};

analysis::LoadedStudy* RunReport::loaded_ = nullptr;
analysis::RunResult* RunReport::result_ = nullptr;

TEST_F(RunReport, SaysTheSameAgainFromTheFolderAlone) {
  make();
  const fs::path again = folder_.path() / "again.pdf";
  writeReport(folder_.path(), again);
  EXPECT_TRUE(base::readFile(again) == base::readFile(pdf())) << "the same bytes";
  EXPECT_TRUE(test::PdfText(QByteArray::fromStdString(base::readFile(again))).text().contains("Poses and armor"));
}

TEST_F(RunReport, ShowsThePersonFromThreeSidesWithOrganAndArmorInTheirColours) {
  const PictureSet set = drawPictures(*loaded_, *result_, {});
  ASSERT_EQ(set.poses.size(), 1U);
  const PosePictures& rest = set.poses.front();
  EXPECT_EQ(rest.pose, "rest");
  EXPECT_EQ(rest.system, "full_torso");
  for (const QImage* view : {&rest.front, &rest.side, &rest.back}) {
    // 1.755 m and the margins, to a pixel and the height of collar or helmet.
    EXPECT_NEAR(view->height() * set.metresPerPixel, 1.755 + 0.04, 0.06);
    EXPECT_EQ(view->pixel(0, 0), qRgb(255, 255, 255));
  }
  EXPECT_LT(rest.side.width(), rest.front.width());
  // Front and back show the same outline, mirrored.
  const auto covered = [](const QImage& image) {
    int count = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        count += image.pixel(x, y) != qRgb(255, 255, 255) ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_NEAR(covered(rest.front) / static_cast<double>(covered(rest.back)), 1.0, 0.02);
  EXPECT_TRUE(std::any_of(set.legend.begin(), set.legend.end(), [](const LegendEntry& entry) {
    return entry.structure == "heart" && entry.colour == qRgb(0xB3, 0x20, 0x2A);
  }));
}

TEST_F(RunReport, PicturesOfAnotherStudyAreLeftOut) {
  make();
  study::RunFacts facts = analysis::readRunTables(folder_.path()).facts;
  EXPECT_EQ(readPictures(folder_.path(), facts).poses.size(), 1U);
  facts.studyHash = std::string(64, '0');
  EXPECT_TRUE(readPictures(folder_.path(), facts).poses.empty());
}

TEST_F(RunReport, DamagedPicturesAreNamedAndLeaveTheOldReport) {
  make();
  const std::string before = base::readFile(pdf());
  const auto expectTrouble = [&](const std::string& word) {
    try {
      writeReport(folder_.path(), pdf());
      ADD_FAILURE() << "took a damaged picture";
    } catch (const base::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  base::writeFileAtomically(folder_.path() / "pictures" / "pose_1_side.png", "no picture");
  expectTrouble("pose_1_side.png");
  const fs::path list = folder_.path() / "pictures" / "pictures.csv";
  std::string table = base::readFile(list);
  table.replace(table.find("pose_1_front.png"), 16, "../../secret.png");
  base::writeFileAtomically(list, table);
  expectTrouble("line 2");
  EXPECT_TRUE(base::readFile(pdf()) == before);
}

TEST_F(RunReport, WhenStoppedLeavesNothing) {
  base::Task task;
  task.cancel();
  EXPECT_THROW(writeRunReport(*loaded_, *result_, folder_.path(), pdf(), {}, base::Progress(task)), base::Cancelled);
  EXPECT_FALSE(fs::exists(pdf()));
  EXPECT_FALSE(fs::exists(folder_.path() / "pictures"));
}

}  // namespace
}  // namespace lorica::report
