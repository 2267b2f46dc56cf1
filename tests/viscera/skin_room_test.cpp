#include "lorica/viscera/skin_room.h"

#include <gtest/gtest.h>

#include "lorica/geometry/primitives.h"

namespace lorica::viscera {
namespace {

using geometry::Positions;
using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3f;

/// A square column from y = 0 to 3: legs, trunk and head of one metre each; the trunk is `pelvis` and `abdomen_front`.
parenting::Body column() {
  parenting::Body body;
  body.regions.names = {"head", "abdomen_front", "pelvis", "thigh_left"};
  TriangleMesh& skin = body.skin;
  for (int level = 0; level <= 3; ++level) {
    for (const auto& [x, z] : {std::pair{0, 0}, std::pair{0, 1}, std::pair{1, 1}, std::pair{1, 0}}) {
      skin.positions.emplace_back(static_cast<float>(x), static_cast<float>(level), static_cast<float>(z));
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint16_t region) {
    skin.triangles.push_back({a, b, c});
    skin.triangles.push_back({a, c, d});
    body.regions.ofTriangle.insert(body.regions.ofTriangle.end(), {region, region});
  };
  for (std::uint32_t level = 0; level < 3; ++level) {
    for (std::uint32_t side = 0; side < 4; ++side) {
      const std::uint32_t a = 4 * level + side;
      const std::uint32_t b = 4 * level + (side + 1) % 4;
      const auto trunk = static_cast<std::uint16_t>(side < 2 ? 1 : 2);
      quad(a, b, b + 4, a + 4, level == 0 ? std::uint16_t{3} : level == 1 ? trunk : std::uint16_t{0});
    }
  }
  quad(3, 2, 1, 0, 3);
  quad(12, 13, 14, 15, 0);
  return body;
}

TEST(SkinRoom, IsTheVolumeOfTheSkinAndOfItsTrunk) {
  const parenting::Body body = column();
  const SkinRoom room = skinRoom(body, body.skin.positions);
  EXPECT_NEAR(room.whole, 3.0, 1e-12);
  EXPECT_NEAR(room.torso, 1.0, 1e-12) << "the holes at waist and neck are closed by flat fans";
}

TEST(SkinRoom, FollowsThePose) {
  const parenting::Body body = column();
  Positions posed = body.skin.positions;
  for (std::size_t v = 8; v < posed.size(); ++v) {
    posed[v].y() += 0.5F;
  }
  EXPECT_NEAR(skinRoom(body, posed).whole, 3.5, 1e-12);
  EXPECT_NEAR(skinRoom(body, posed).torso, 1.5, 1e-12);
  for (Vec3f& p : posed) {
    p += Vec3f(10, -3, 7);
  }
  EXPECT_NEAR(skinRoom(body, posed).torso, 1.5, 1e-5) << "wherever the body stands";
}

TEST(SkinRoom, ABodyWithoutNamedRegionsHasNoTorso) {
  parenting::Body body = column();
  body.regions.names = {"unassigned"};
  body.regions.ofTriangle.assign(body.skin.triangles.size(), 0);
  EXPECT_EQ(skinRoom(body, body.skin.positions).torso, 0.0);
}

}  // namespace
}  // namespace lorica::viscera
