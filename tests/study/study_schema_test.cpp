#include <gtest/gtest.h>

#include <map>
#include <set>
#include <span>

#include "full_study.h"
#include "schema_validator.h"
#include "study_words.h"

namespace lorica::study {
namespace {

using Words = std::set<std::string>;

template <class Value, std::size_t N>
Words wordsOf(const std::array<Word<Value>, N>& table) {
  Words words;
  for (const auto& [word, value] : table) {
    words.emplace(word);
  }
  return words;
}

Words wordsAt(const std::string& pointer) {
  Words words;
  for (const Json& word : test::studySchema().schema().at(Json::json_pointer(pointer))) {
    words.insert(word.get<std::string>());
  }
  return words;
}

Words keysAt(const std::string& pointer) {
  Words keys;
  for (const auto& [key, rule] : test::studySchema().schema().at(Json::json_pointer(pointer)).items()) {
    keys.insert(key);
  }
  return keys;
}

const std::map<std::string, std::span<const std::string_view>>& readerObjects() {
  static const std::map<std::string, std::span<const std::string_view>> objects{
      {"", studyKeys},
      {"/$defs/human", humanKeys},
      {"/$defs/recorded", recordedKeys},
      {"/$defs/organ", organKeys},
      {"/$defs/lattice", latticeKeys},
      {"/$defs/system", systemKeys},
      {"/$defs/piece", pieceKeys},
      {"/$defs/pose", poseKeys},
      {"/$defs/turn", turnKeys},
      {"/$defs/source", sourceKeys},
      {"/$defs/stop", stopKeys},
      {"/$defs/overlap", overlapKeys},
      {"/$defs/analyses", analysesKeys},
      {"/$defs/directions", directionsKeys},
      {"/$defs/motion", motionKeys},
      {"/$defs/gaps", gapsKeys},
      {"/$defs/anatomy", anatomyKeys},
      {"/$defs/threat", threatKeys},
      {"/$defs/threatDisplay", threatDisplayKeys},
      {"/$defs/display", displayKeys}};
  return objects;
}

TEST(StudySchema, HasTheKeysOfTheReaderInEveryObject) {
  for (const auto& [pointer, keys] : readerObjects()) {
    EXPECT_EQ(keysAt(pointer + "/properties"), Words(keys.begin(), keys.end())) << pointer;
    EXPECT_EQ(test::studySchema().schema().at(Json::json_pointer(pointer + "/additionalProperties")), false);
  }
  for (const auto& [name, rule] : test::studySchema().schema()["$defs"].items()) {
    EXPECT_TRUE(!rule.contains("properties") || readerObjects().contains("/$defs/" + name)) << name;
  }
}

TEST(StudySchema, HasTheWordsOfTheReaderForEveryChoice) {
  EXPECT_EQ(wordsAt("/properties/models/items/enum"), wordsOf(modelWords));
  EXPECT_EQ(wordsAt("/properties/skinning/enum"), wordsOf(skinningWords));
  EXPECT_EQ(wordsAt("/properties/deformer/enum"), wordsOf(deformerWords));
  EXPECT_EQ(wordsAt("/$defs/organ/properties/class/enum"), wordsOf(classWords));
  EXPECT_EQ(wordsAt("/$defs/lattice/properties/layout/enum"), wordsOf(layoutWords));
  EXPECT_EQ(wordsAt("/$defs/piece/properties/carriage/enum"), wordsOf(carriageWords));
  EXPECT_EQ(wordsAt("/$defs/source/properties/sampler/enum"), wordsOf(samplerWords));
  EXPECT_EQ(wordsAt("/$defs/overlap/properties/policy/enum"), wordsOf(overlapWords));
  EXPECT_EQ(wordsAt("/$defs/source/properties/sequence/enum"), wordsOf(sequenceWords));
  EXPECT_EQ(wordsAt("/$defs/source/properties/type/enum"), wordsOf(sourceTypeWords));
  EXPECT_EQ(wordsAt("/$defs/structureName/not/enum"), Words(reservedStructures.begin(), reservedStructures.end()));
  EXPECT_EQ(wordsAt("/$defs/recorded/properties/up/enum"), wordsOf(upWords));
  EXPECT_EQ(wordsAt("/$defs/threat/properties/time_units/enum"), wordsOf(timeUnitWords));
  EXPECT_EQ(test::studySchema().schema()["$defs"]["threat"]["properties"]["builtin"]["const"], blastBuiltin);
  for (const char* object : {"human", "organ", "piece", "threat"}) {
    const std::string properties = std::string("/$defs/") + object + "/properties";
    EXPECT_EQ(wordsAt(properties + "/units/enum"), wordsOf(unitWords));
    EXPECT_EQ(wordsAt(properties + "/up/enum"), wordsOf(upWords));
  }
}

TEST(StudyWords, AreTheNamesTheProgramUsesElsewhere) {
  for (const auto& [word, model] : modelWords) {
    EXPECT_EQ(name(model), word);
  }
  for (const auto& [word, unit] : unitWords) {
    EXPECT_EQ(name(unit), word);
  }
}

TEST(StudySchema, HasTheVersionAndTheDefaultsOfTheProgram) {
  const Json& schema = test::studySchema().schema();
  EXPECT_EQ(schema["properties"]["lorica_study"]["const"], studyVersion);
  const Study study;
  EXPECT_EQ(schema["properties"]["trials"]["default"], study.trials);
  EXPECT_EQ(schema["properties"]["seed"]["default"], study.seed);
  EXPECT_EQ(schema["properties"]["site_spacing_mm"]["default"].get<double>() / 1000.0, study.siteSpacing);
  EXPECT_EQ(schema["properties"]["skinning"]["default"], wordFor(study.skinning, skinningWords));
  EXPECT_EQ(schema["properties"]["deformer"]["default"], wordFor(study.deformer, deformerWords));
  EXPECT_EQ(schema["properties"]["models"]["default"], Json({name(study.models.at(0)), name(study.models.at(1))}));
  EXPECT_EQ(schema["$defs"]["stop"]["properties"]["half_width"]["default"], StopRule().halfWidth);
  EXPECT_EQ(schema["$defs"]["stop"]["properties"]["max_trials"]["default"], StopRule().maxTrials);
  EXPECT_EQ(schema["$defs"]["source"]["properties"]["shots"]["default"], Source().shots);
  EXPECT_EQ(schema["$defs"]["lattice"]["properties"]["cell_mm"]["default"].get<double>() / 1000.0,
            LatticeSettings().cellMetres);
}

TEST(StudySchema, AcceptsTheStudyThatUsesEveryKey) {
  const Json tree = Json::parse(fullStudy);
  EXPECT_TRUE(test::studySchema().accepts(tree));
  EXPECT_NO_THROW(parseStudy(fullStudy, "s"));
}

}  // namespace
}  // namespace lorica::study
