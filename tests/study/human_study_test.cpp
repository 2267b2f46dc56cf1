#include "lorica/study/human_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lorica/base/error.h"
#include "lorica/manikin/armor_systems.h"
#include "lorica/manikin/organs.h"
#include "lorica/study/study_file.h"

namespace lorica::study {
namespace {

const human::Person kSmallWoman{human::Sex::female, 1.53, 51.0};
const std::vector<std::string> kEverySystem{"full_torso", "plate_carrier", "helmet", "full_torso_helmet",
                                            "plate_carrier_helmet"};

std::vector<std::string> organNamesOf(const Study& study) {
  std::vector<std::string> names;
  std::transform(study.organs.begin(), study.organs.end(), std::back_inserter(names),
                 [](const Organ& organ) { return organ.name; });
  return names;
}

const ArmorPiece& piece(const Study& study, std::size_t system, const std::string& name) {
  const auto& pieces = study.systems.at(system).pieces;
  const auto found = std::find_if(pieces.begin(), pieces.end(), [&](const auto& p) { return p.name == name; });
  EXPECT_NE(found, pieces.end()) << name;
  return found == pieces.end() ? pieces.front() : *found;
}

TEST(HumanStudy, HasThePersonOrgansAndSystemsThatWereAskedFor) {
  const Study study = humanStudy({kSmallWoman, OrganChoice::all, {"plate_carrier", "helmet"}});
  EXPECT_EQ(study.human.from, (std::variant<InputFile, Builtin>(Builtin{"human"})));
  EXPECT_EQ(study.person, kSmallWoman);
  EXPECT_EQ(study.name, "woman, 153.0 cm, 51.0 kg");
  EXPECT_EQ(organNamesOf(study), manikin::organNames());
  ASSERT_EQ(study.systems.size(), 2U);
  EXPECT_EQ(study.systems[0].name, "plate_carrier");
  ASSERT_EQ(study.systems[0].pieces.size(), 2U) << "what carries the plates does not protect";
  EXPECT_EQ(std::get<Builtin>(piece(study, 0, "plate_front").mesh.from).name, "human/plate_carrier/plate_front");
  EXPECT_EQ(std::get<Builtin>(piece(study, 1, "helmet").mesh.from).name, "human/helmet/helmet");
}

TEST(HumanStudy, StartsFromThePosesSourcesAndRunOfTheSample) {
  const Study sample = parseStudy(templateText("sample"), "sample");
  const Study study = humanStudy({});
  ASSERT_EQ(study.poses.size(), sample.poses.size());
  for (std::size_t p = 0; p < study.poses.size(); ++p) {
    EXPECT_EQ(study.poses[p].name, sample.poses[p].name);
    EXPECT_EQ(study.poses[p].what, sample.poses[p].what);
  }
  ASSERT_EQ(study.sources.size(), sample.sources.size());
  EXPECT_EQ(study.sources[0].position, sample.sources[0].position);
  EXPECT_EQ(study.sources[0].shots, sample.sources[0].shots);
  EXPECT_EQ(study.models, sample.models);
  EXPECT_EQ(study.trials, sample.trials);
  for (const Organ& organ : sample.organs) {
    const auto mine =
        std::find_if(study.organs.begin(), study.organs.end(), [&](const Organ& o) { return o.name == organ.name; });
    ASSERT_NE(mine, study.organs.end()) << organ.name;
    EXPECT_EQ(mine->injuryClass, organ.injuryClass) << organ.name;
  }
}

TEST(HumanStudy, OfTheMedianManHasThePiecesOfTheSample) {
  const Study sample = parseStudy(templateText("sample"), "sample");
  const Study study = humanStudy({});
  ASSERT_EQ(study.systems.size(), sample.systems.size());
  for (std::size_t s = 0; s < study.systems.size(); ++s) {
    ASSERT_EQ(study.systems[s].pieces.size(), sample.systems[s].pieces.size());
    for (std::size_t p = 0; p < study.systems[s].pieces.size(); ++p) {
      const ArmorPiece& mine = study.systems[s].pieces[p];
      const ArmorPiece& theirs = sample.systems[s].pieces[p];
      EXPECT_EQ(mine.mesh, theirs.mesh);
      EXPECT_EQ(mine.carriage, theirs.carriage) << mine.name;
      EXPECT_EQ(mine.material, theirs.material) << mine.name;
      EXPECT_EQ(mine.arealDensity, theirs.arealDensity) << mine.name;
    }
  }
}

TEST(HumanStudy, OfTheTorsoHasNothingOfHeadAndLimbs) {
  const std::vector<std::string> names = organNamesOf(humanStudy({kSmallWoman, OrganChoice::torso, {}}));
  for (const char* outside : {"brain", "eyes", "thyroid", "arteries", "veins"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), outside), 0) << outside;
  }
  EXPECT_EQ(names.size() + 5, manikin::organNames().size());
  EXPECT_TRUE(humanStudy({kSmallWoman, OrganChoice::none, {}}).organs.empty());
}

TEST(HumanStudy, GivesEveryStructureOfEverySystemItsOwnName) {
  const Study study = humanStudy({kSmallWoman, OrganChoice::all, kEverySystem});
  std::set<std::string> names{"body", "armor", "organs"};
  for (const std::string& organ : organNamesOf(study)) {
    EXPECT_TRUE(names.insert(organ).second) << organ;
  }
  for (const ArmorSystem& system : study.systems) {
    for (const ArmorPiece& each : system.pieces) {
      EXPECT_TRUE(names.insert(each.name).second) << each.name;
    }
  }
  EXPECT_EQ(piece(study, 0, "plate_front").name, "plate_front");
  EXPECT_EQ(piece(study, 1, "plate_carrier_plate_front").carriage, Carriage::rigid);
  EXPECT_EQ(piece(study, 3, "full_torso_helmet_vest_front").carriage, Carriage::skinned);
}

TEST(HumanStudy, SurvivesSaving) {
  for (const OrganChoice organs : {OrganChoice::all, OrganChoice::torso, OrganChoice::none}) {
    const Study study = humanStudy({kSmallWoman, organs, kEverySystem});
    EXPECT_EQ(parseStudy(studyText(study), "s"), study);
  }
}

TEST(HumanStudy, RefusesPersonsThatCannotBeMade) {
  EXPECT_THROW((void)humanStudy({{human::Sex::male, 2.5, 90.0}, OrganChoice::none, {}}), base::InputError);
  EXPECT_THROW((void)humanStudy({{}, OrganChoice::none, {"no_such_system"}}), base::CallerError);
}

}  // namespace
}  // namespace lorica::study
