#include <gtest/gtest.h>

#include "glb_builder.h"
#include "import_bytes.h"
#include "lorica/geometry/measures.h"

namespace lorica::test {
namespace {

using base::Severity;
using geometry::Vec3d;
using geometry::Vec3f;
using human::JointIndex;
using io::Model;

Model read(const GlbBuilder& file) {
  return importBytes(file.glb(), "file.glb");
}

/// Where the part's vertices go when the joint turns.
std::vector<Vec3f> turned(const Model& model, const std::string& joint, const Vec3d& degrees) {
  const human::Skeleton& skeleton = *model.skeleton;
  const auto pose = human::turnedPose(skeleton, {{skeleton.find(joint).value(), degrees}}, Vec3d::Zero());
  const geometry::Positions& rest = model.parts[0].mesh.positions;
  std::vector<Vec3f> posed(rest.size());
  human::skin(rest, *model.parts[0].weights, human::skinningDeltas(skeleton, pose), posed, {1});
  return posed;
}

void expectNear(const Vec3f& found, const Vec3d& expected, double tolerance = 1e-6) {
  EXPECT_LT((found.cast<double>() - expected).norm(), tolerance)
      << found.transpose() << " for " << expected.transpose();
}

TEST(GltfSkin, SkeletonHoldsTheJointsWithTheirNamesParentsAndRest) {
  const Model model = read(skinnedFile());
  ASSERT_TRUE(model.skeleton);
  ASSERT_EQ(model.skeleton->size(), 2U);
  EXPECT_EQ(model.skeleton->joints()[0].name, "hip");
  EXPECT_EQ(model.skeleton->joints()[1].name, "knee");
  EXPECT_EQ(model.skeleton->joints()[1].parent, JointIndex{0});
  EXPECT_EQ(model.skeleton->joints()[1].rest.translation, Vec3d(0, 0.5, 0));
  EXPECT_EQ(model.parts[0].weights->vertices(), 4U);
}

TEST(GltfSkin, VerticesFollowTheirJoint) {
  // The knee at (0, 0.5, 0) turns a quarter about z: (0, 1, 0) goes to (-0.5, 0.5, 0), (0, 0, 1) to (0.5, 0.5, 1).
  const std::vector<Vec3f> posed = turned(read(skinnedFile()), "knee", {0, 0, 90});
  expectNear(posed[0], {0, 0, 0});
  expectNear(posed[1], {1, 0, 0});
  expectNear(posed[2], {-0.5, 0.5, 0});
  expectNear(posed[3], {0.5, 0.5, 1});
}

TEST(GltfSkin, TransformOfTheMeshNodeIsIgnored) {
  GlbBuilder file = skinnedFile();
  file.document["nodes"][0]["translation"] = {10, 20, 30};
  file.document["nodes"][0]["scale"] = {-3, 3, 3};
  EXPECT_EQ(flat(read(file).parts[0].mesh.positions), tetrahedronCorners());
}

TEST(GltfSkin, RestIsTheBindPoseEvenWhereTheNodesArePosed) {
  GlbBuilder file = skinnedFile();
  const double half = std::sqrt(0.5);
  file.document["nodes"][2]["rotation"] = {0, 0, half, half};  // the file shows the knee bent
  const Model model = read(file);
  EXPECT_EQ(flat(model.parts[0].mesh.positions), tetrahedronCorners());
  EXPECT_LT(model.skeleton->joints()[1].rest.rotation.angularDistance(geometry::Quatd::Identity()), 1e-6);
  expectNear(turned(model, "knee", {0, 0, 90})[2], {-0.5, 0.5, 0});
}

TEST(GltfSkin, BindPoseIsPlacedAsTheRootJointIs) {
  GlbBuilder file = skinnedFile();
  file.document["nodes"][1]["translation"] = {0, 3, 0};
  const Model model = read(file);
  expectNear(model.parts[0].mesh.positions[1], {1, 3, 0});
  EXPECT_LT((model.skeleton->restPosition(JointIndex{1}) - Vec3d(0, 3.5, 0)).norm(), 1e-9);
}

TEST(GltfSkin, ZUpDataUnderATurnedRootStandsUpright) {
  GlbBuilder file = skinnedFile();  // the skin as modelled: its up is z, corner 3 is the top
  file.document["nodes"][0]["name"] = "skin";
  const int armature = file.add(
      "nodes", {{"name", "Z_UP"}, {"children", {0, 1}}, {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}}});
  file.document["scenes"][0]["nodes"] = {armature};
  const Model model = read(file);
  ASSERT_EQ(model.skeleton->size(), 3U) << "nodes above the joints belong to the skeleton";
  EXPECT_EQ(model.skeleton->joints()[0].name, "Z_UP");
  expectNear(model.parts[0].mesh.positions[3], {0, 1, 0});
  expectNear(model.parts[0].mesh.positions[2], {0, 0, -1});
  EXPECT_LT((model.skeleton->restPosition(*model.skeleton->find("knee")) - Vec3d(0, 0, -0.5)).norm(), 1e-9);
}

TEST(GltfSkin, ScaledArmatureBringsCentimetresIntoMetres) {
  GlbBuilder file = skinnedFile();
  std::vector<float> binds = translationMatrix(0, 0, 0);
  const std::vector<float> knee = translationMatrix(0, -50, 0);
  binds.insert(binds.end(), knee.begin(), knee.end());
  std::vector<float> corners;
  for (const float c : tetrahedronCorners()) {
    corners.push_back(100 * c);
  }
  file.document["skins"][0]["inverseBindMatrices"] = file.accessor(binds, "MAT4");
  file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = file.accessor(corners, "VEC3");
  file.document["nodes"][2]["translation"] = {0, 50, 0};
  const int armature = file.add("nodes", {{"name", "armature"}, {"children", {1}}, {"scale", {0.01, 0.01, 0.01}}});
  file.document["scenes"][0]["nodes"] = {0, armature};
  const Model model = read(file);
  EXPECT_NEAR(geometry::signedVolume(model.parts[0].mesh), 1.0 / 6.0, 1e-6);
  expectNear(turned(model, "knee", {0, 0, 90})[2], {-0.5, 0.5, 0});
}

TEST(GltfSkin, InverseBindMatricesMayBeAbsent) {
  GlbBuilder file = skinnedFile();
  file.document["skins"][0].erase("inverseBindMatrices");
  const Model model = read(file);
  EXPECT_EQ(flat(model.parts[0].mesh.positions), tetrahedronCorners());
  EXPECT_LT(model.skeleton->restPosition(JointIndex{1}).norm(), 1e-9) << "bound at the origin";
  EXPECT_EQ(issuesAbout(model, Severity::warning, ""), 0U);
}

TEST(GltfSkin, WeightsMayBeBytesShortsOrFloats) {
  for (const int bits : {8, 16, 32}) {
    GlbBuilder file = skinnedFile();
    auto& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
    const std::vector<int> fifths{1, 4, 0, 0, 1, 4, 0, 0, 1, 4, 0, 0, 1, 4, 0, 0};
    if (bits == 8) {
      std::vector<std::uint8_t> weights;
      for (const int w : fifths) {
        weights.push_back(static_cast<std::uint8_t>(51 * w));
      }
      attributes["WEIGHTS_0"] = file.accessor(weights, "VEC4", true);
    } else if (bits == 16) {
      std::vector<std::uint16_t> weights;
      for (const int w : fifths) {
        weights.push_back(static_cast<std::uint16_t>(13107 * w));
      }
      attributes["WEIGHTS_0"] = file.accessor(weights, "VEC4", true);
    } else {
      std::vector<float> weights;
      for (const int w : fifths) {
        weights.push_back(0.2F * static_cast<float>(w));
      }
      attributes["WEIGHTS_0"] = file.accessor(weights, "VEC4");
    }
    attributes["JOINTS_0"] =
        file.accessor(std::vector<std::uint16_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
    const Model model = read(file);
    const human::SkinWeights& weights = *model.parts[0].weights;
    ASSERT_EQ(weights.influences, 2U);
    for (std::size_t v = 0; v < 4; ++v) {
      EXPECT_EQ(weights.joints[2 * v], 1U) << "the strongest stands first";
      EXPECT_NEAR(weights.weights[2 * v], 0.8F, 1e-6) << bits;
      EXPECT_NEAR(weights.weights[2 * v + 1], 0.2F, 1e-6) << bits;
    }
  }
}

TEST(GltfSkin, SeveralSetsAreNormalisedTogether) {
  GlbBuilder file = skinnedFile();
  auto& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
  std::vector<float> more;
  std::vector<std::uint8_t> knee;
  for (int v = 0; v < 4; ++v) {
    more.insert(more.end(), {3, 0, 0, 0});  // with the 1 of the first set: 4 in all
    knee.insert(knee.end(), {1, 0, 0, 0});
  }
  attributes["JOINTS_1"] = file.accessor(knee, "VEC4");
  attributes["WEIGHTS_1"] = file.accessor(more, "VEC4");
  const Model model = read(file);
  const human::SkinWeights& weights = *model.parts[0].weights;
  EXPECT_EQ(weights.joints[0], 1U);
  EXPECT_NEAR(weights.weights[0], 0.75F, 1e-6);
  EXPECT_NEAR(weights.weights[1], 0.25F, 1e-6);
  EXPECT_NEAR(weights.weights[2 * weights.influences], 1.0F, 1e-6) << "vertex 2 has the knee twice";
  EXPECT_EQ(issuesAbout(model, Severity::note, "2 sets of weights"), 1U);
  EXPECT_EQ(issuesAbout(model, Severity::warning, "did not sum to 1"), 1U);
}

TEST(GltfSkin, PartWithoutSkinBelowAJointFollowsItRigidly) {
  GlbBuilder file = skinnedFile();
  const int helmet = file.add("nodes", {{"mesh", 1}, {"name", "helmet"}, {"translation", {0, 1, 0}}});
  file.mesh({{"POSITION", 0}}, 1);
  file.document["nodes"][2]["children"] = {helmet};
  const Model model = read(file);
  ASSERT_EQ(model.parts.size(), 2U);
  const io::Part& part = model.parts[1];
  EXPECT_EQ(part.name, "helmet");
  expectNear(part.mesh.positions[0], {0, 1.5, 0});
  ASSERT_TRUE(part.weights);
  for (std::size_t v = 0; v < part.weights->vertices(); ++v) {
    EXPECT_EQ(part.weights->strongest(v), *model.skeleton->find("knee"));
  }
  EXPECT_EQ(issuesAbout(model, Severity::warning, "carried rigidly"), 1U);
}

TEST(GltfSkin, PartOutsideTheSkeletonHasNoWeights) {
  GlbBuilder file = skinnedFile();
  file.root({{"mesh", file.mesh({{"POSITION", 0}}, 1)}, {"name", "stone"}});
  const Model model = read(file);
  EXPECT_FALSE(model.parts[1].weights);
}

TEST(GltfSkin, SeveralSkinsShareOneSkeletonAndDisagreementIsWarnedOf) {
  GlbBuilder file = skinnedFile();
  file.add("skins", {{"joints", {2}}, {"inverseBindMatrices", file.accessor(translationMatrix(0, -0.5F, 0), "MAT4")}});
  auto second = file.document["meshes"][0];
  second["primitives"][0]["attributes"]["JOINTS_0"] = file.accessor(std::vector<std::uint8_t>(16, 0), "VEC4");
  const int mesh = file.add("meshes", second);
  file.root({{"mesh", mesh}, {"skin", 1}, {"name", "shoe"}});
  const Model model = read(file);
  EXPECT_EQ(model.skeleton->size(), 2U);
  EXPECT_EQ(model.parts[1].weights->strongest(0), *model.skeleton->find("knee"));
  EXPECT_EQ(flat(model.parts[1].mesh.positions), tetrahedronCorners());
  EXPECT_EQ(issuesAbout(model, Severity::warning, ""), 0U);

  std::vector<float> differing = translationMatrix(0, 0, 0);
  const std::vector<float> knee = translationMatrix(0, -0.7F, 0);
  differing.insert(differing.end(), knee.begin(), knee.end());
  file.document["skins"][1] = {{"joints", {1, 2}}, {"inverseBindMatrices", file.accessor(differing, "MAT4")}};
  EXPECT_EQ(issuesAbout(read(file), Severity::warning, "binds 1 joints elsewhere"), 1U);
}

TEST(GltfSkin, UnnamedAndRepeatedJointsGetNamesOfTheirOwn) {
  GlbBuilder file = skinnedFile();
  file.document["nodes"][1].erase("name");
  EXPECT_EQ(read(file).skeleton->joints()[0].name, "joint_0");
  file.document["nodes"][1]["name"] = "knee";
  EXPECT_EQ(read(file).skeleton->joints()[1].name, "knee_2");
}

TEST(GltfSkin, ShearedAndMirroredBindsAreWarnedOf) {
  GlbBuilder file = skinnedFile();
  std::vector<float> binds = translationMatrix(0, 0, 0);
  std::vector<float> sheared = translationMatrix(0, -0.5F, 0);
  sheared[4] = 0.5F;
  binds.insert(binds.end(), sheared.begin(), sheared.end());
  file.document["skins"][0]["inverseBindMatrices"] = file.accessor(binds, "MAT4");
  EXPECT_EQ(issuesAbout(read(file), Severity::warning, "shears"), 1U);
  std::vector<float> mirrored = translationMatrix(0, 0, 0);
  mirrored.insert(mirrored.end(), {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -0.5F, 0, 1});
  file.document["skins"][0]["inverseBindMatrices"] = file.accessor(mirrored, "MAT4");
  EXPECT_EQ(issuesAbout(read(file), Severity::warning, "mirrors"), 1U);
}

}  // namespace
}  // namespace lorica::test
