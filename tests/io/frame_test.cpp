#include <gtest/gtest.h>

#include <fmt/format.h>

#include "glb_builder.h"
#include "import_bytes.h"

namespace lorica::test {
namespace {

using base::LengthUnit;
using base::Severity;
using geometry::Vec3d;
using io::Model;
using io::UpAxis;

/// A tetrahedron whose box has these sides.
std::string objOf(double x, double y, double z) {
  return fmt::format("v 0 0 0\nv {} 0 0\nv 0 {} 0\nv 0 0 {}\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", x, y, z);
}

Vec3d sizeOf(const Model& model) {
  Eigen::AlignedBox3f box;
  for (const geometry::Vec3f& p : model.parts[0].mesh.positions) {
    box.extend(p);
  }
  return box.sizes().cast<double>();
}

TEST(UnitsOfAFormatWithoutUnits, AreThoseInWhichTheModelIsAPerson) {
  const struct {
    double size;
    LengthUnit unit;
    double metres;
  } cases[] = {{1.75, LengthUnit::metre, 1.75},
               {0.05, LengthUnit::metre, 0.05},
               {175, LengthUnit::centimetre, 1.75},
               {30, LengthUnit::centimetre, 0.3},
               {1750, LengthUnit::millimetre, 1.75}};
  for (const auto& expected : cases) {
    const Model model = importBytes(objOf(0.3 * expected.size, expected.size, 0.2 * expected.size), "a.obj");
    EXPECT_EQ(model.units, expected.unit) << expected.size;
    EXPECT_TRUE(model.unitsGuessed);
    EXPECT_NEAR(sizeOf(model).y(), expected.metres, 1e-6);
    EXPECT_EQ(issuesAbout(model, Severity::note, "guessed from the largest extent"), 1U);
  }
}

TEST(UnitsOfAFormatWithoutUnits, GivenOnesDecide) {
  const Model model = importBytes(objOf(20, 69, 10), "a.obj", {LengthUnit::inch, {}});
  EXPECT_NEAR(sizeOf(model).y(), 69 * 0.0254, 1e-6);
  EXPECT_FALSE(model.unitsGuessed);
  EXPECT_EQ(issuesAbout(model, Severity::note, "largest extent"), 0U);
}

TEST(UpAxisOfAFormatWithoutOne, IsZForABodyThatStandsAlongZ) {
  const Model lying = importBytes(objOf(0.5, 0.3, 1.75), "a.obj");
  EXPECT_EQ(lying.up, UpAxis::z);
  EXPECT_TRUE(lying.upGuessed);
  EXPECT_LT((sizeOf(lying) - Vec3d(0.5, 1.75, 0.3)).norm(), 1e-6);
  EXPECT_EQ(importBytes(objOf(0.5, 1.75, 0.3), "a.obj").up, UpAxis::y);
  EXPECT_EQ(importBytes(objOf(0.5, 0.3, 0.6), "a.obj").up, UpAxis::y) << "not tall enough to be a body";
  EXPECT_EQ(importBytes(objOf(0.5, 0.3, 1.75), "a.obj", {{}, UpAxis::y}).up, UpAxis::y);
}

TEST(UpAxisOfAFormatWithoutOne, TurnsZIntoYAndYIntoMinusZ) {
  const Model model = importBytes(objOf(1, 2, 3), "a.obj", {LengthUnit::metre, UpAxis::z});
  EXPECT_EQ(flat(model.parts[0].mesh.positions), (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 0, -2, 0, 3, 0}));
}

TEST(UnitsOfGltf, AreMetresAndYIsUp) {
  const Model model = importBytes(tetrahedronFile().glb(), "a.glb");
  EXPECT_EQ(model.units, LengthUnit::metre);
  EXPECT_FALSE(model.unitsGuessed);
  EXPECT_FALSE(model.upGuessed);
  EXPECT_TRUE(model.issues.empty());
}

TEST(UnitsOfGltf, AbsurdSizeIsWarnedOf) {
  GlbBuilder file = tetrahedronFile();
  file.document["nodes"][0]["scale"] = {175, 175, 175};
  EXPECT_EQ(issuesAbout(importBytes(file.glb(), "a.glb"), Severity::warning, "--units"), 1U);
  const Model given = importBytes(file.glb(), "a.glb", {LengthUnit::centimetre, {}});
  EXPECT_NEAR(sizeOf(given).x(), 1.75, 1e-6);
  EXPECT_EQ(issuesAbout(given, Severity::warning, "--units"), 0U);
}

TEST(UnitsOfGltf, GivenFrameMovesSkinSkeletonAndClipsTogether) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{0, 1}, "SCALAR");
  const int path = file.accessor(std::vector<float>{0, 0, 0, 1, 2, 3}, "VEC3");
  const int turns = file.accessor(std::vector<float>{0, 0, 0, 1, 0.5F, 0.5F, 0.5F, 0.5F}, "VEC4");
  Json clip = animation(1, "translation", times, path);
  clip["samplers"].push_back({{"input", times}, {"output", turns}});
  clip["channels"].push_back({{"sampler", 1}, {"target", {{"node", 1}, {"path", "rotation"}}}});
  clip["channels"].push_back({{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}});
  file.document["animations"] = Json::array({clip});

  const auto posed = [&](const io::ImportOptions& options) {
    const Model model = importBytes(file.glb(), "a.glb", options);
    const auto pose = human::sample(model.clips.at(0), *model.skeleton, 0.7);
    const geometry::Positions& rest = model.parts[0].mesh.positions;
    std::vector<geometry::Vec3f> result(rest.size());
    human::skin(rest, *model.parts[0].weights, human::skinningDeltas(*model.skeleton, pose), result, {1});
    return result;
  };
  const auto plain = posed({});
  const auto turned = posed({LengthUnit::centimetre, UpAxis::z});
  for (std::size_t v = 0; v < plain.size(); ++v) {
    const geometry::Vec3f expected(0.01F * plain[v].x(), 0.01F * plain[v].z(), -0.01F * plain[v].y());
    EXPECT_LT((turned[v] - expected).norm(), 1e-7) << v;
  }
}

}  // namespace
}  // namespace lorica::test
