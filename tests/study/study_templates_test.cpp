#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "full_study.h"
#include "lorica/base/files.h"
#include "schema_validator.h"

namespace lorica::study {
namespace {

TEST(Templates, AreTheFilesOfTheResourcesByteForByte) {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(LORICA_SOURCE_DIR "/resources/studies")) {
    const std::string name = entry.path().filename().string();
    files.insert(name.substr(0, name.find('.')));
    EXPECT_EQ(templateText(name.substr(0, name.find('.'))), base::readFile(entry.path())) << name;
  }
  const std::vector<std::string> names = templateNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), files);
  EXPECT_EQ(names.front(), "sample");
}

TEST(Templates, AreStudiesThatSurviveSavingWithTheirDescriptions) {
  for (const std::string& name : templateNames()) {
    const Study study = parseStudy(templateText(name), name);
    EXPECT_EQ(study.name, name);
    EXPECT_FALSE(study.description.empty()) << name;
    EXPECT_FALSE(study.sources.empty()) << name;
    EXPECT_EQ(parseStudy(studyText(study), name), study);
    EXPECT_TRUE(test::studySchema().accepts(Json::parse(templateText(name)))) << name;
  }
}

TEST(Templates, NeedNoFiles) {
  for (const std::string& name : templateNames()) {
    EXPECT_TRUE(inputFiles(parseStudy(templateText(name), name)).empty()) << name;
  }
}

TEST(Templates, SampleComparesTwoSystemsOverTheTasksOfTheThesis) {
  const Study study = parseStudy(templateText("sample"), "sample");
  EXPECT_EQ(study.organs.size(), 17U);
  EXPECT_EQ(study.systems.size(), 2U);
  std::set<std::string> clips;
  for (const Pose& pose : study.poses) {
    clips.insert(std::get<ClipPose>(pose.what).clip);
  }
  EXPECT_EQ(clips, (std::set<std::string>{"belly_twist", "lateral_twist", "toe_touch"}));
  for (const Organ& organ : study.organs) {
    // Breeze et al. 2016: heart and great vessels, liver, spleen.
    static const std::set<std::string> essentials{"heart", "liver", "spleen", "arteries", "veins"};
    const bool essential = essentials.count(organ.name) > 0;
    EXPECT_EQ(organ.injuryClass == "essential", essential) << organ.name;
  }
}

TEST(Templates, ComparisonHasAllFourModelsAndTwoSides) {
  const Study study = parseStudy(templateText("comparison"), "comparison");
  EXPECT_EQ(study.models.size(), 4U);
  EXPECT_EQ(study.sources.size(), 2U);
}

TEST(Templates, UnknownNamesAreAnsweredWithTheKnownOnes) {
  try {
    templateText("smaple");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "there is no template \"smaple\"; known are sample, comparison, "
                 "vest_against_carrier, toe_touch, twist, test_case_1, test_case_2, blast, minimal");
  }
}

}  // namespace
}  // namespace lorica::study
