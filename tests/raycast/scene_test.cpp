#include <gtest/gtest.h>

#include "lorica/base/error.h"
#include "lorica/geometry/primitives.h"
#include "lorica/raycast/caster.h"

namespace lorica::raycast {
namespace {

TEST(Scene, RefusesPositionsThatDoNotFitTheTopology) {
  const geometry::TriangleMesh cube = geometry::box({0, 0, 0}, {1, 1, 1});
  Scene scene(SceneUse::manyRays);
  const geometry::Positions tooFew(cube.positions.begin(), cube.positions.end() - 1);
  EXPECT_THROW(scene.add(tooFew, makeTopology(cube)), base::CallerError);
}

TEST(Scene, WithoutMeshesIsHitByNothing) {
  Scene scene(SceneUse::manyRays);
  scene.build();
  Caster caster(scene);
  EXPECT_TRUE(caster.cast({geometry::Vec3f::Zero(), geometry::Vec3f::UnitX()}).empty());
}

TEST(Scene, MadeForRaysCannotBeRefitted) {
  Scene scene(SceneUse::manyRays);
  EXPECT_THROW(scene.refit(), base::CallerError);
}

TEST(MeshTopology, ListsTheTrianglesAroundEachVertex) {
  const geometry::TriangleMesh sphere = geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 2);
  const auto topology = makeTopology(sphere);
  std::size_t listed = 0;
  for (std::size_t v = 0; v < sphere.positions.size(); ++v) {
    for (std::uint32_t r = topology->ringStart[v]; r < topology->ringStart[v + 1]; ++r) {
      const geometry::Triangle& t = sphere.triangles[topology->ring[r]];
      EXPECT_TRUE(t[0] == v || t[1] == v || t[2] == v);
      ++listed;
    }
  }
  EXPECT_EQ(listed, 3 * sphere.triangles.size());
  EXPECT_FALSE(topology->hasOpenEdges);
}

}  // namespace
}  // namespace lorica::raycast
