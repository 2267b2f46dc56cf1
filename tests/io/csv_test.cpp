#include <gtest/gtest.h>

#include "lorica/io/export.h"

namespace lorica::io {
namespace {

std::string row(const std::vector<std::string>& fields) {
  return csvRow(fields);
}

TEST(CsvRow, QuotesOnlyWhatHoldsACommaAQuoteOrALineBreak) {
  EXPECT_EQ(row({"heart", "12", ""}), "heart,12,\n");
  EXPECT_EQ(row({"lung, left", "5 \" wide", "two\nlines"}), "\"lung, left\",\"5 \"\" wide\",\"two\nlines\"\n");
  EXPECT_EQ(row({}), "\n");
}

TEST(CsvWithColumn, EndsEveryRowButNoLineWithinAField) {
  const std::string table = row({"name", "n"}) + row({"two\nlines, \"so\"", "1"}) + row({"plain", ""});
  EXPECT_EQ(csvWithColumn(table, "partial", "yes"), "name,n,partial\n\"two\nlines, \"\"so\"\"\",1,yes\nplain,,yes\n");
}

}  // namespace
}  // namespace lorica::io
