#include <gtest/gtest.h>

#include "lorica/base/error.h"
#include "lorica/shotline/shot_generator.h"

namespace lorica::shotline {
namespace {

using geometry::Vec3f;

/// The line an error is at, and its text.
std::string complaint(std::string_view csv) {
  try {
    readShotList(csv, "shots.csv");
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.file(), "shots.csv");
    return error.what();
  }
  return "none";
}

TEST(ShotList, ReadsDirectionsOfAnyLength) {
  const ShotList list = readShotList("x,y,z,dx,dy,dz\n1,2,3,0,0,-4\n\n -1 , 0.5,2e0,3,4,0\r\n", "shots.csv");
  ASSERT_EQ(list.rays->size(), 2U);
  EXPECT_EQ((*list.rays)[0].origin, Vec3f(1, 2, 3));
  EXPECT_EQ((*list.rays)[0].direction, Vec3f(0, 0, -1));
  EXPECT_LT(((*list.rays)[1].direction - Vec3f(0.6F, 0.8F, 0)).norm(), 1e-6F);
}

TEST(ShotList, ReadsAnglesAsWhereTheShotComesFrom) {
  const ShotList list = readShotList("\xEF\xBB\xBFx,y,z,az,el\n0,1,5,0,0\n3,1,0,90,30\n", "shots.csv");
  EXPECT_LT(((*list.rays)[0].direction - Vec3f(0, 0, -1)).norm(), 1e-6F) << "from ahead, so it goes backwards";
  EXPECT_LT(((*list.rays)[1].direction - Vec3f(-0.8660254F, -0.5F, 0)).norm(), 1e-6F);
}

TEST(ShotList, NamesTheLineOfWhatItCannotUse) {
  EXPECT_EQ(complaint("x,y,z,az,el\n0,0,0,0,0\n\n0,0,0,0,91\n"),
            "shots.csv: line 4: expected an elevation from -90 to 90 degrees, found 91");
  EXPECT_EQ(complaint("x,y,z,dx,dy,dz\n0,0,0,0,0,0\n"),
            "shots.csv: line 2: the direction dx,dy,dz has no length; say where the shot goes");
  EXPECT_NE(complaint("x,y,z,dx,dy,dz\n0,0,0,1,0\n").find("line 2: expected 6 fields, found 5"), std::string::npos);
  EXPECT_NE(complaint("x,y,z,dx,dy,dz\n0,0,0,1,nan,0\n").find("line 2: expected a number"), std::string::npos);
  EXPECT_NE(complaint("x,y,z,dx,dy,dz\n0,0,1e9,1,0,0\n").find("line 2"), std::string::npos);
  EXPECT_NE(complaint("a,b\n").find("line 1: expected the columns"), std::string::npos);
  EXPECT_NE(complaint("x,y,z,az,el\n").find("holds no shots"), std::string::npos);
  EXPECT_NE(complaint("").find("is empty"), std::string::npos);
}

TEST(ShotList, GivesItsShotsInEveryTrial) {
  const Source source{"listed", readShotList("x,y,z,az,el\n0,1,5,0,0\n3,1,0,90,30\n", "shots.csv")};
  EXPECT_EQ(ShotGenerator(source, 1, 0).shot(1).origin, ShotGenerator(source, 2, 7).shot(1).origin);
  EXPECT_EQ(measureOf(source).basis, Basis::shots);
}

}  // namespace
}  // namespace lorica::shotline
