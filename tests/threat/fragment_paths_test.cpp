#include "lorica/threat/fragment_paths.h"

#include <gtest/gtest.h>

#include "lorica/threat/read_threat.h"

namespace lorica::threat {
namespace {

TEST(FragmentPaths, JoinThePointsOfAnIdInTheOrderOfTime) {
  const ThreatField field =
      readThreatCsv("id,t_ms,x,y,z\n9,2,3,0,0\n-4,1,0,1,0\n9,0,1,0,0\n9,1,2,0,0\n-4,3,0,2,0\n5,1,7,7,7\n", "t.csv")
          .field;
  const std::vector<FragmentPath> paths = fragmentPaths(field);
  ASSERT_EQ(paths.size(), 3U);
  EXPECT_EQ(paths[0].id, -4);
  EXPECT_EQ(paths[1].id, 5);
  EXPECT_EQ(paths[1].points.size(), 1U);
  EXPECT_EQ(paths[2].id, 9);
  EXPECT_EQ(paths[2].points, (std::vector<geometry::Vec3f>{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  EXPECT_EQ(paths[2].times, (std::vector<double>{0.0, 0.001, 0.002}));
}

TEST(FragmentPaths, WithoutTimesFollowTheFile) {
  const std::vector<FragmentPath> paths =
      fragmentPaths(readThreatCsv("x,y,z,track\n1,0,0,1\n0,0,0,2\n2,0,0,1\n", "t.csv").field);
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_EQ(paths[0].points, (std::vector<geometry::Vec3f>{{1, 0, 0}, {2, 0, 0}}));
  EXPECT_TRUE(paths[0].times.empty());
}

TEST(FragmentPaths, NeedIds) {
  EXPECT_TRUE(fragmentPaths(readThreatCsv("x,y,z\n1,0,0\n", "t.csv").field).empty());
}

}  // namespace
}  // namespace lorica::threat
