#include "lorica/base/error.h"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace lorica::base {
namespace {

int halfOf(int even) {
  LORICA_CHECK(even % 2 == 0, "only even numbers have a half");
  return even / 2;
}

TEST(InputError, WhatIsFilePlaceAndText) {
  const InputError error("study.json", "/armor/0", "a name was expected");
  EXPECT_STREQ(error.what(), "study.json: /armor/0: a name was expected");
  EXPECT_EQ(error.file(), "study.json");
  EXPECT_EQ(error.place(), "/armor/0");
  EXPECT_EQ(error.text(), "a name was expected");
}

TEST(InputError, WhatLeavesOutMissingPieces) {
  EXPECT_STREQ(InputError("study.json", "", "is empty").what(), "study.json: is empty");
  EXPECT_STREQ(InputError("", "--threads", "a number was expected").what(), "--threads: a number was expected");
  EXPECT_STREQ(InputError("", "", "nothing was given").what(), "nothing was given");
}

TEST(Errors, OfTheCallerAreNoErrorsOfTheInput) {
  static_assert(std::is_base_of_v<Error, InputError>);
  static_assert(std::is_base_of_v<Error, Cancelled>);
  static_assert(!std::is_base_of_v<Error, CallerError>, "catching Error must not swallow defects");
  static_assert(!std::is_base_of_v<InputError, Cancelled>);
}

TEST(Check, PassesWhenTheConditionHolds) {
  EXPECT_EQ(halfOf(8), 4);
}

TEST(Check, ThrowsCallerErrorThatNamesFunctionConditionAndText) {
  try {
    halfOf(7);
    FAIL() << "no exception";
  } catch (const CallerError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("halfOf"), std::string::npos) << what;
    EXPECT_NE(what.find("even % 2 == 0"), std::string::npos) << what;
    EXPECT_NE(what.find("only even numbers have a half"), std::string::npos) << what;
  }
}

TEST(Check, EvaluatesItsConditionOnce) {
  int calls = 0;
  LORICA_CHECK(++calls > 0, "counts");
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace lorica::base
