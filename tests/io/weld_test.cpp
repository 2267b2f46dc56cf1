#include <gtest/gtest.h>

#include "glb_builder.h"
#include "import_bytes.h"
#include "lorica/geometry/mesh_audit.h"

namespace lorica::test {
namespace {

/// Two triangles that share an edge whose two vertices the file has twice; `weight` is that of joint 0 on the second
/// copies, 0.5 on everything else.
io::Model seam(float weight) {
  GlbBuilder file = skinnedFile();
  const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, /* copies */ 1, 0, 0, 0, 1, 0, 1, 1, 0};
  std::vector<float> weights;
  std::vector<std::uint8_t> joints;
  for (std::size_t v = 0; v < 6; ++v) {
    const float first = v == 3 || v == 4 ? weight : 0.5F;
    weights.insert(weights.end(), {first, 1.0F - first, 0, 0});
    joints.insert(joints.end(), {0, 1, 0, 0});
  }
  auto& primitive = file.document["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  primitive["attributes"] = {{"POSITION", file.accessor(corners, "VEC3")},
                             {"JOINTS_0", file.accessor(joints, "VEC4")},
                             {"WEIGHTS_0", file.accessor(weights, "VEC4")}};
  return importBytes(file.glb(), "file.glb");
}

TEST(WeldOfSkins, CopiesWithAgreeingWeightsBecomeOne) {
  const io::Model model = seam(0.5004F);  // the sum of differences is 0.0008
  EXPECT_EQ(model.parts[0].mesh.positions.size(), 4U);
  EXPECT_EQ(model.parts[0].weights->vertices(), 4U);
  EXPECT_EQ(geometry::audit(model.parts[0].mesh).boundaryEdges, 4U);
}

TEST(WeldOfSkins, CopiesWithOtherWeightsStayApart) {
  const io::Model model = seam(0.6F);
  EXPECT_EQ(model.parts[0].mesh.positions.size(), 6U);
  ASSERT_EQ(model.parts[0].weights->vertices(), 6U);
  EXPECT_NEAR(model.parts[0].weights->weights[3 * model.parts[0].weights->influences], 0.6F, 1e-6);
}

}  // namespace
}  // namespace lorica::test
