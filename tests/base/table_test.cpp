#include "lorica/base/table.h"

#include <gtest/gtest.h>

#include "lorica/base/error.h"

namespace lorica::base {
namespace {

TEST(Table, ReadsQuotedFieldsAndNumbers) {
  const Table table("name,mm,source\nneck,395,\"Gordon, 2014 \"\"ANSUR II\"\"\"\r\nwaist,9.37e2,\n\n", "sizes");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.text(0, "source"), "Gordon, 2014 \"ANSUR II\"");
  EXPECT_EQ(table.number(0, "mm"), 395.0);
  EXPECT_EQ(table.number(table.find("name", "waist"), "mm"), 937.0);
  EXPECT_EQ(table.text(1, "source"), "");
}

TEST(Table, KeepsLineBreaksInsideQuotes) {
  const Table table("a,b\n\"one\ntwo\",2\n3,x\n", "t");
  EXPECT_EQ(table.text(0, "a"), "one\ntwo");
  try {
    (void)table.number(1, "b");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place(), "line 4");
    EXPECT_NE(error.text().find("'x'"), std::string::npos);
  }
}

TEST(Table, NamesWhatIsWrong) {
  EXPECT_THROW(Table("a,b\n1\n", "t"), InputError);
  EXPECT_THROW(Table("a,b\n\"1,2\n", "t"), InputError);
  const Table table("a\n1\nnan\n", "t");
  EXPECT_THROW((void)table.text(0, "b"), InputError);
  EXPECT_THROW((void)table.find("a", "2"), InputError);
  EXPECT_THROW((void)table.number(1, "a"), InputError);
}

}  // namespace
}  // namespace lorica::base
