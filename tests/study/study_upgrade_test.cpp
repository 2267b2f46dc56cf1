#include "study_upgrade.h"

#include <gtest/gtest.h>

#include <array>

#include "full_study.h"

namespace lorica::study {
namespace {

Json renameColour(Json tree) {
  tree["color"] = tree["colour"];
  tree.erase("colour");
  return tree;
}

Json doubleWeight(Json tree) {
  tree["weight"] = 2 * tree["weight"].get<int>();
  return tree;
}

constexpr std::array<UpgradeStep, 2> steps{renameColour, doubleWeight};

TEST(StudyUpgrade, TakesEveryStepFromTheVersionOfTheFileOn) {
  EXPECT_EQ(upgraded(Json::parse(R"({"lorica_study": 1, "colour": "red", "weight": 2})"), "s", steps),
            Json::parse(R"({"lorica_study": 3, "weight": 4, "color": "red"})"));
  EXPECT_EQ(upgraded(Json::parse(R"({"lorica_study": 2, "color": "red", "weight": 2})"), "s", steps),
            Json::parse(R"({"lorica_study": 3, "color": "red", "weight": 4})"));
}

TEST(StudyUpgrade, LeavesTheNewestVersionAlone) {
  const Json tree = Json::parse(R"({"lorica_study": 3, "weight": 2})");
  EXPECT_EQ(upgraded(tree, "s", steps), tree);
}

TEST(StudyUpgrade, HasAStepForEveryVersionButTheFirst) {
  EXPECT_EQ(upgradeSteps().size() + 1, static_cast<std::size_t>(studyVersion));
}

TEST(StudyUpgrade, RefusesANewerVersionAndSaysToUpdate) {
  EXPECT_STREQ(errorOf(R"({"lorica_study": 7, "unheard_of": {}})").what(),
               "s.lorica.json: /lorica_study: the study has version 7, this program reads versions up to 1; update "
               "Lorica");
}

TEST(StudyUpgrade, RefusesWhatIsNoVersion) {
  for (const char* version : {"0", "-1", "1.5", "\"1\"", "null", "true"}) {
    const base::InputError error = errorOf(std::string(R"({"lorica_study": )") + version + "}");
    EXPECT_EQ(error.place(), "/lorica_study");
    EXPECT_EQ(error.text().find("expected the version of the study format, a whole number from 1, found "), 0U)
        << error.text();
  }
}

}  // namespace
}  // namespace lorica::study
