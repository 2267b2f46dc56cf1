#include "lorica/base/csv_table.h"

#include <gtest/gtest.h>

#include "lorica/base/error.h"

namespace lorica::base {
namespace {

TEST(CsvTable, ReadsQuotedFieldsAndBothLineEnds) {
  const CsvTable table("name,value,note\r\na,1.5,\"one, two\"\nb,-2,\"he said \"\"no\"\"\"\n");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.text(0, "note"), "one, two");
  EXPECT_EQ(table.text(1, "note"), "he said \"no\"");
  EXPECT_EQ(table.number(0, "value"), 1.5);
  EXPECT_EQ(table.number(1, "value"), -2.0);
}

TEST(CsvTable, KeepsEmptyFieldsAndALastLineWithoutEnd) {
  const CsvTable table("a,b,c\n,,\n1,,3");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.text(0, "c"), "");
  EXPECT_EQ(table.text(1, "b"), "");
  EXPECT_EQ(table.number(1, "c"), 3.0);
}

TEST(CsvTable, NamesTheLineThatDoesNotFit) {
  try {
    const CsvTable table("a,b\n1,2\n3\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place(), "line 3");
  }
}

TEST(CsvTable, NamesTheFieldThatIsNoNumber) {
  const CsvTable table("a,b\n1,two\n");
  try {
    table.number(0, "b");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place(), "line 2, b");
  }
  EXPECT_THROW(table.text(0, "c"), CallerError);
  EXPECT_THROW(table.text(1, "a"), CallerError);
}

}  // namespace
}  // namespace lorica::base
