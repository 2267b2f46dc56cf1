#include "lorica/base/readable.h"

#include <gtest/gtest.h>

namespace lorica::base {
namespace {

TEST(ReadableTime, TakesTheLargestUnitsThatSaySomething) {
  EXPECT_EQ(readableTime(0.0), "0 s");
  EXPECT_EQ(readableTime(6.2), "7 s");
  EXPECT_EQ(readableTime(60.0), "1 min 00 s");
  EXPECT_EQ(readableTime(125.0), "2 min 05 s");
  EXPECT_EQ(readableTime(3780.0), "1 h 03 min");
}

TEST(ReadableCount, GroupsThousands) {
  EXPECT_EQ(readableCount(0), "0");
  EXPECT_EQ(readableCount(999), "999");
  EXPECT_EQ(readableCount(1000), "1,000");
  EXPECT_EQ(readableCount(1234567), "1,234,567");
}

}  // namespace
}  // namespace lorica::base
