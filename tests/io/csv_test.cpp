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

}  // namespace
}  // namespace lorica::io
