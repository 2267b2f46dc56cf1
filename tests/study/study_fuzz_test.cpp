#include <gtest/gtest.h>

#include <random>

#include "full_study.h"
#include "schema_validator.h"

namespace lorica::study {
namespace {

using namespace std::string_literals;
using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t limit) {
  return static_cast<std::size_t>(random() % limit);
}

std::vector<std::string> startingTexts() {
  std::vector<std::string> texts{fullStudy};
  for (const std::string& name : templateNames()) {
    texts.push_back(templateText(name));
  }
  return texts;
}

std::string mutatedBytes(std::string text, Random& random) {
  const std::string favourites = "{}[]\",:-0e9.\\u\0\xFF\n"s;
  for (std::size_t changes = 1 + below(random, 4); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(random, text.size());
    switch (below(random, 6)) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << below(random, 8)));
        break;
      case 1:
        text[at] = favourites[below(random, favourites.size())];
        break;
      case 2:
        text.resize(at);
        break;
      case 3:
        text.insert(at, 1, favourites[below(random, favourites.size())]);
        break;
      case 4:
        text.erase(at, 1 + below(random, 20));
        break;
      default:
        text.insert(at, text.substr(below(random, text.size()), below(random, 200)));
    }
  }
  return text;
}

TEST(StudyFuzz, DamagedBytesEndInAStudyOrOneLineThatNamesTheFile) {
  Random random(20160501);
  for (const std::string& text : startingTexts()) {
    for (int round = 0; round < 3000; ++round) {
      const std::string damaged = mutatedBytes(text, random);
      try {
        const Study study = parseStudy(damaged, "s.lorica.json");
        EXPECT_EQ(parseStudy(studyText(study), "s"), study);
      } catch (const base::InputError& error) {
        EXPECT_EQ(error.file(), "s.lorica.json");
        EXPECT_FALSE(error.text().empty());
        EXPECT_EQ(std::string(error.what()).find_first_of("\n\r"), std::string::npos) << error.what();
        EXPECT_LT(std::string(error.what()).size(), 1500U);
      }
    }
  }
}

Json anyValue(Random& random) {
  static const std::vector<Json> values{nullptr,
                                        true,
                                        0,
                                        1,
                                        -1,
                                        2.5,
                                        1e300,
                                        "",
                                        "x",
                                        "walk@1",
                                        "rest",
                                        "body",
                                        "y",
                                        "uniform",
                                        "heart",
                                        "a\n",
                                        {1, 2, 3},
                                        {"a"},
                                        Json::array(),
                                        Json::object(),
                                        {{"name", "n"}},
                                        1000000,
                                        {0.5, 0.5, 0.5},
                                        {"a", "a"},
                                        "cone",
                                        "rigid"};
  return values[below(random, values.size())];
}

/// Replaces, removes or adds one value somewhere in the tree.
Json mutatedTree(Json tree, Random& random) {
  const Json flat = tree.flatten();
  std::string pointer = std::next(flat.begin(), static_cast<std::ptrdiff_t>(below(random, flat.size()))).key();
  for (std::size_t up = below(random, 3); up > 0 && pointer.rfind('/') > 0; --up) {
    pointer.resize(pointer.rfind('/'));
  }
  const Json::json_pointer place(pointer);
  Json& parent = tree.at(place.parent_pointer());
  switch (below(random, 4)) {
    case 0:
      if (parent.is_object()) {
        parent.erase(place.back());
      } else {
        parent.erase(std::stoul(place.back()));
      }
      break;
    case 1:
      if (parent.is_object()) {
        static const std::vector<std::string> keys{"name",  "file",   "builtin", "up",    "cells",  "clip",
                                                   "turns", "layout", "seconds", "class", "pieces", "nonsense"};
        parent[keys[below(random, keys.size())]] = anyValue(random);
      } else {
        parent.push_back(anyValue(random));
      }
      break;
    default:
      tree.at(place) = anyValue(random);
  }
  return tree;
}

/// Rules that a schema cannot state: names that differ, poses that exist, a name that reads as a clip at a time.
/// Angles in the wrong order, steps that do not divide: what a schema cannot see.
bool isAboutAngles(const std::string& text) {
  return text.find("degrees is empty") != std::string::npos || text.find("a full turn") != std::string::npos ||
         text.find("do not divide") != std::string::npos;
}

bool isAboutNames(const std::string& text) {
  return text.find("is taken by") != std::string::npos || text.find("CLIP@SECONDS") != std::string::npos ||
         text.find("reads as a clip") != std::string::npos;
}

TEST(StudyFuzz, ReaderAndSchemaJudgeChangedStudiesAlike) {
  Random random(20160502);
  int accepted = 0;
  for (const std::string& text : startingTexts()) {
    const Json tree = Json::parse(text);
    for (int round = 0; round < 1500; ++round) {
      const Json changed = mutatedTree(tree, random);
      const bool described = test::studySchema().accepts(changed);
      try {
        parseStudy(changed.dump(), "s");
        ++accepted;
        EXPECT_TRUE(described) << Json::diff(tree, changed).dump();
      } catch (const base::InputError& error) {
        EXPECT_TRUE(!described || isAboutNames(error.text()) || isAboutAngles(error.text()))
            << error.what() << '\n'
            << Json::diff(tree, changed).dump();
      }
    }
  }
  EXPECT_GT(accepted, 100);
}

}  // namespace
}  // namespace lorica::study
