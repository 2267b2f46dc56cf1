#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <limits>

#include "full_study.h"
#include "lorica/base/files.h"
#include "random_study.h"
#include "schema_validator.h"
#include "temporary_folder.h"

namespace lorica::study {
namespace {

RC_GTEST_PROP(StudyText, ReadsBackAsTheSameStudy, ()) {
  const Study study = *test::anyStudy();
  const std::string text = studyText(study);
  const Study back = parseStudy(text, "random");
  RC_ASSERT(back == study);
  RC_ASSERT(studyText(back) == text);
}

RC_GTEST_PROP(StudyText, IsWhatTheSchemaDescribes, ()) {
  RC_ASSERT(test::studySchema().accepts(Json::parse(studyText(*test::anyStudy()))));
}

TEST(StudyText, OfTheFullStudyReadsBackAndKeepsItsBytes) {
  const Study study = parseStudy(fullStudy, "s");
  const std::string text = studyText(study);
  EXPECT_EQ(parseStudy(text, "s"), study);
  EXPECT_EQ(studyText(parseStudy(text, "s")), text);
}

TEST(StudyText, IsOrderedIndentedShortAndEndsWithALineBreak) {
  Study study;
  study.name = "small";
  study.human.from = Builtin{"human"};
  study.sources.resize(1);
  study.sources[0].name = "front";
  study.sources[0].position = {0.0, 1.5, 5.0};
  study.poses.resize(1);
  study.poses[0].name = "still";
  study.poses[0].what = TurnedPose{};
  study.siteSpacing = 0.035;
  EXPECT_EQ(studyText(study), R"({
  "lorica_study": 1,
  "name": "small",
  "human": {
    "builtin": "human",
    "sex": "male",
    "stature_m": 1.755,
    "mass_kg": 84.6
  },
  "poses": [
    {
      "name": "still",
      "turns": {}
    }
  ],
  "sources": [
    {
      "name": "front",
      "position": [0, 1.5, 5],
      "sampler": "cone",
      "shots": 100000
    }
  ],
  "models": [
    "static_joint",
    "dynamic"
  ],
  "trials": 5,
  "seed": 1,
  "site_spacing_mm": 35
}
)");
}

TEST(StudyText, WritesOutWhatDecidesTheNumbersAndOmitsEveryOtherDefault) {
  Study study;
  study.human.from = Builtin{"human"};
  study.organs.resize(1);
  study.organs[0].name = "heart";
  study.organs[0].mesh.from = Builtin{"human/heart"};
  const Json json = Json::parse(studyText(study));
  EXPECT_EQ(json["models"], Json({"static_joint", "dynamic"}));
  EXPECT_EQ(json["trials"], 5);
  EXPECT_EQ(json["seed"], 1);
  EXPECT_EQ(json["organs"][0]["lattice"]["cell_mm"], 40);
  EXPECT_EQ(json.size(), 6U) << "version, human, organs, models, trials, seed";
  EXPECT_EQ(json["organs"][0].size(), 3U) << "name, builtin, lattice";
}

TEST(StudyText, IsEqualForEqualStudiesWhateverTheSignOfZero) {
  Study plus;
  plus.human.from = Builtin{"human"};
  plus.sources.resize(1);
  plus.sources[0].name = "a";
  Study minus = plus;
  minus.sources[0].position = {-0.0, 0.0, -0.0};
  ASSERT_EQ(plus, minus);
  EXPECT_EQ(studyText(plus), studyText(minus));
}

TEST(StudyText, RefusesWhatAFileCannotHold) {
  Study study;
  study.human.from = Builtin{"\xFF"};
  EXPECT_THROW(studyText(study), base::InputError);
  study.human.from = Builtin{"human"};
  study.siteSpacing = std::numeric_limits<double>::infinity();
  EXPECT_THROW(studyText(study), base::CallerError);
}

TEST(StudyText, MovesASizeThatIsNoMillimetresByLessThanItsLastDigit) {
  Study study;
  study.human.from = Builtin{"human"};
  for (double metres = 0.005; metres < 0.5; metres = std::nextafter(metres * 1.01, 1.0)) {
    study.siteSpacing = metres;
    const Study back = parseStudy(studyText(study), "s");
    EXPECT_NEAR(back.siteSpacing, metres, 2.3e-16 * metres);
    EXPECT_EQ(parseStudy(studyText(back), "s"), back);
  }
}

TEST(StudyFile, SavesAndLoads) {
  const test::TemporaryFolder folder;
  const Study study = parseStudy(fullStudy, "s");
  saveStudy(study, folder.path() / "deeper" / "a.lorica.json");
  EXPECT_EQ(loadStudy(folder.path() / "deeper" / "a.lorica.json"), study);
  EXPECT_EQ(base::readFile(folder.path() / "deeper" / "a.lorica.json"), studyText(study));
}

TEST(StudyFile, NamesTheFileThatCannotBeLoaded) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "none.lorica.json";
  try {
    loadStudy(path);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.file(), path.string());
  }
}

}  // namespace
}  // namespace lorica::study
