#include "lorica/document/appearance.h"

#include <gtest/gtest.h>

#include <set>

namespace lorica::document {
namespace {

study::Study studyWith(const std::vector<std::string>& organs) {
  study::Study study;
  for (const std::string& name : organs) {
    study.organs.emplace_back();
    study.organs.back().name = name;
  }
  for (const std::string system : {"first", "second"}) {
    study.systems.push_back({system, {}, {}});
    for (const std::string piece : {" front", " back", " side"}) {
      study.systems.back().pieces.emplace_back();
      study.systems.back().pieces.back().name = system + piece;
    }
  }
  return study;
}

QColor colourOf(const std::string& organ) {
  return defaultAppearance(studyWith({organ}), organ).colour;
}

TEST(Appearance, OfTheSkinIsTranslucentAndOfTheRestIsNot) {
  const study::Study study = studyWith({"heart"});
  EXPECT_EQ(defaultAppearance(study, "body").opacity, 0.25);
  EXPECT_TRUE(defaultAppearance(study, "body").visible);
  for (const std::string name : {"heart", "first front", "second back"}) {
    EXPECT_EQ(defaultAppearance(study, name).opacity, 1.0);
    EXPECT_EQ(defaultAppearance(study, name).colour.alpha(), 255);
  }
}

TEST(Appearance, ShowsThePiecesOfTheFirstSystemOnly) {
  const study::Study study = studyWith({"heart"});
  EXPECT_TRUE(defaultAppearance(study, "heart").visible);
  EXPECT_TRUE(defaultAppearance(study, "first front").visible);
  EXPECT_TRUE(defaultAppearance(study, "first side").visible);
  EXPECT_FALSE(defaultAppearance(study, "second front").visible);
}

TEST(Appearance, FollowsWhatANameSays) {
  for (const std::string name : {"heart", "Heart", "the_heart", "HeartLeft", "aorta", "Pulmonary artery"}) {
    const QColor colour = colourOf(name);
    EXPECT_GT(colour.red(), 2 * std::max(colour.green(), colour.blue())) << name;
  }
  for (const std::string name : {"vein", "vena_cava", "PulmonaryVein", "jugular veins"}) {
    const QColor colour = colourOf(name);
    EXPECT_GT(colour.blue(), colour.red()) << name;
  }
  EXPECT_EQ(colourOf("lung_left"), colourOf("RightLung"));
  EXPECT_EQ(colourOf("kidney_left"), colourOf("Kidneys"));
  EXPECT_NE(colourOf("bladder"), colourOf("gallbladder"));
  EXPECT_EQ(colourOf("gall_bladder"), colourOf("gallbladder"));
  EXPECT_NE(colourOf("small_intestine"), colourOf("large_intestine"));
  EXPECT_NE(colourOf("spinal_cord"), colourOf("spine"));
  EXPECT_EQ(colourOf("renal vein"), colourOf("vein"));
  EXPECT_NE(colourOf("ribbon"), colourOf("rib"));
}

TEST(Appearance, TellsTheOrgansOfABodyApart) {
  std::set<QRgb> colours;
  const std::vector<std::string> names{"heart",   "lung",    "liver",     "spleen", "stomach",  "kidney",
                                       "bladder", "trachea", "intestine", "brain",  "pancreas", "spinal_cord"};
  for (const std::string& name : names) {
    colours.insert(colourOf(name).rgb());
  }
  EXPECT_EQ(colours.size(), names.size());
}

TEST(Appearance, TellsUnknownOrgansApartByTheirPlace) {
  const study::Study study = studyWith({"thing", "Thing2", "x", "", "42"});
  std::set<QRgb> colours;
  for (const study::Organ& organ : study.organs) {
    colours.insert(defaultAppearance(study, organ.name).colour.rgb());
  }
  EXPECT_EQ(colours.size(), study.organs.size());
}

TEST(Appearance, TellsThePiecesOfASystemApartInDullGreens) {
  const study::Study study = studyWith({});
  std::set<QRgb> colours;
  for (const study::ArmorPiece& piece : study.systems[0].pieces) {
    const QColor colour = defaultAppearance(study, piece.name).colour;
    colours.insert(colour.rgb());
    EXPECT_GE(colour.green(), std::max(colour.red(), colour.blue()));
    EXPECT_LT(colour.hsvSaturationF(), 0.5);
  }
  EXPECT_EQ(colours.size(), 3U);
}

TEST(Appearance, IsWhatTheStudySaysWhereItSaysSomething) {
  study::Study study = studyWith({"heart"});
  study.displays = {{"heart", false, {}, 0.5}, {"second front", true, {{1, 2, 3}}, {}}};
  EXPECT_FALSE(appearanceOf(study, "heart").visible);
  EXPECT_EQ(appearanceOf(study, "heart").opacity, 0.5);
  EXPECT_EQ(appearanceOf(study, "heart").colour, defaultAppearance(study, "heart").colour);
  EXPECT_TRUE(appearanceOf(study, "second front").visible);
  EXPECT_EQ(appearanceOf(study, "second front").colour, QColor(1, 2, 3));
  EXPECT_EQ(appearanceOf(study, "second front").opacity, 1.0);
  EXPECT_FALSE(appearanceOf(study, "second back").visible);
}

TEST(DrawnStructures, AreTheBodyTheOrgansAndThePieces) {
  EXPECT_EQ(drawnStructures(studyWith({"heart", "liver"})),
            (std::vector<std::string>{"body", "heart", "liver", "first front", "first back", "first side",
                                      "second front", "second back", "second side"}));
}

}  // namespace
}  // namespace lorica::document
