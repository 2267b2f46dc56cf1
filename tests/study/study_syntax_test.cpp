#include <gtest/gtest.h>

#include "full_study.h"

namespace lorica::study {
namespace {

TEST(StudySyntax, ErrorsNameFileLineAndColumnOnOneLine) {
  const base::InputError error = errorOf("{\n  \"lorica_study\": 1,\n  \"name\": nobody\n}");
  EXPECT_EQ(error.file(), "s.lorica.json");
  EXPECT_EQ(error.place(), "line 3, column 12");
  EXPECT_EQ(std::string(error.what()).find("s.lorica.json: line 3, column 12: is not valid JSON: "), 0U)
      << error.what();
  EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
}

TEST(StudySyntax, FindsThePlaceOfEachKindOfMistake) {
  EXPECT_EQ(errorOf("").place(), "line 1, column 1");
  EXPECT_EQ(errorOf("{\"a\": 1").place(), "line 1, column 8");
  EXPECT_EQ(errorOf("{\"a\": 1\n").place(), "line 2, column 1");
  EXPECT_EQ(errorOf("{\"a\": 1,}").place(), "line 1, column 9");
  EXPECT_EQ(errorOf("{\"a\": 1} x").place(), "line 1, column 10");
  EXPECT_EQ(errorOf("{\"a\" 1}").place(), "line 1, column 6");
}

TEST(StudySyntax, CountsColumnsInCharacters) {
  EXPECT_EQ(errorOf("{\"\xC3\xA4\xE2\x82\xAC\": !}").place(), "line 1, column 8");
}

TEST(StudySyntax, SaysWhatWasExpected) {
  EXPECT_EQ(errorOf("{\"a\" 1}").text(),
            "is not valid JSON: while parsing object separator - unexpected number literal; expected ':'");
  EXPECT_EQ(errorOf("{\"a\": 1e999}").text(), "is not valid JSON: the number is too large");
}

TEST(StudySyntax, LeavesTheOffendingTextOutOfTheMessage) {
  const std::string error = errorOf("{\"" + std::string(100000, 'x') + "\n").what();
  EXPECT_LT(error.size(), 200U);
  EXPECT_EQ(error.find("xx"), std::string::npos);
}

TEST(StudySyntax, RefusesBytesThatAreNotUtf8) {
  const base::InputError error = errorOf("{\"name\": \"\xFF\"}");
  EXPECT_EQ(error.place(), "line 1, column 11");
}

TEST(StudySyntax, RefusesAKeyThatStandsTwice) {
  const base::InputError error = errorOf(R"({"lorica_study": 1, "organs": [{}, {"name": "a", "name": "b"}]})");
  EXPECT_EQ(error.place(), "/organs/1/name");
  EXPECT_EQ(error.text(), "the key \"name\" stands here twice; keep one");
}

TEST(StudySyntax, RefusesNestingThatWouldExhaustTheStack) {
  for (const char* open : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 1000000; ++i) {
      text += open;
    }
    EXPECT_EQ(errorOf(text).text(), "is nested deeper than 32 levels");
  }
}

TEST(StudySyntax, ReadsManyKeysInOneObjectWithoutSearchingThemAllEachTime) {
  std::string text = "{";
  for (int i = 0; i < 200000; ++i) {
    text += "\"k" + std::to_string(i) + "\": 0,";
  }
  EXPECT_EQ(errorOf(text + "\"lorica_study\": 1}").place(), "/k0");
}

TEST(StudySyntax, AcceptsAByteOrderMark) {
  EXPECT_NO_THROW(parseStudy("\xEF\xBB\xBF{\"lorica_study\": 1, \"human\": {\"builtin\": \"plain\"}}", "s"));
}

}  // namespace
}  // namespace lorica::study
