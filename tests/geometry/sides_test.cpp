#include "lorica/geometry/sides.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "lorica/geometry/primitives.h"

namespace lorica::geometry {
namespace {

TEST(SidesByEdge, ListEverySideOnceAndThoseOfAnEdgeTogether) {
  const TriangleMesh mesh = ellipsoid(Vec3d::Zero(), Vec3d(1, 2, 3), 2);
  const std::vector<TriangleSide> sides = sidesByEdge(mesh.triangles);
  ASSERT_EQ(sides.size(), 3 * mesh.triangles.size());
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const TriangleSide& side = sides[i];
    EXPECT_TRUE(seen.emplace(side.triangle, side.corner).second);
    const Triangle& triangle = mesh.triangles[side.triangle];
    const auto [low, high] = std::minmax(triangle[side.corner], triangle[(side.corner + 1) % 3]);
    EXPECT_EQ(std::pair(side.low, side.high), std::pair(low, high));
    const int before = uses[{side.low, side.high}]++;
    EXPECT_EQ(before > 0, i > 0 && side.sameEdge(sides[i - 1])) << "the edge stands in one place";
  }
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 2) << "the surface is closed";
  }
}

}  // namespace
}  // namespace lorica::geometry
