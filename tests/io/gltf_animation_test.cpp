#include <gtest/gtest.h>

#include "glb_builder.h"
#include "import_bytes.h"

namespace lorica::test {
namespace {

using base::Severity;
using geometry::Quatd;
using geometry::Vec3d;
using io::Model;

Model read(const GlbBuilder& file) {
  return importBytes(file.glb(), "file.glb");
}

human::Trs kneeAt(const Model& model, double seconds, std::size_t clip = 0) {
  return human::sample(model.clips.at(clip), *model.skeleton, seconds).local.at(1);
}

void expectNear(const Vec3d& found, const Vec3d& expected) {
  EXPECT_LT((found - expected).norm(), 1e-6) << found.transpose() << " for " << expected.transpose();
}

TEST(GltfAnimation, LinearTranslationGoesStraightAndHoldsItsEnds) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{1, 3}, "SCALAR");
  const int values = file.accessor(std::vector<float>{0, 0.5F, 0, 2, 0.5F, 4}, "VEC3");
  file.document["animations"] = Json::array({animation(2, "translation", times, values)});
  const Model model = read(file);
  ASSERT_EQ(model.clips.size(), 1U);
  EXPECT_EQ(model.clips[0].duration(), 3.0);
  expectNear(kneeAt(model, 0).translation, {0, 0.5, 0});
  expectNear(kneeAt(model, 2.5).translation, {1.5, 0.5, 3});
  expectNear(kneeAt(model, 9).translation, {2, 0.5, 4});
}

TEST(GltfAnimation, StepHoldsTheLastKey) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{0, 1}, "SCALAR");
  const int values = file.accessor(std::vector<float>{1, 1, 1, 2, 2, 2}, "VEC3");
  file.document["animations"] = Json::array({animation(2, "scale", times, values, "STEP")});
  const Model model = read(file);
  EXPECT_EQ(kneeAt(model, 0.99).scale, Vec3d(1, 1, 1));
  EXPECT_EQ(kneeAt(model, 1.0).scale, Vec3d(2, 2, 2));
}

TEST(GltfAnimation, CubicSplineFollowsTheFormulaOfGltf) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{1, 3}, "SCALAR");
  // per key: in-tangent, value, out-tangent
  const int values = file.accessor(
      std::vector<float>{9, 9, 9, 1, 2, 3, 0.5F, -1, 2, /* second key */ -2, 1, 0.25F, 4, 0, -1, 9, 9, 9}, "VEC3");
  file.document["animations"] = Json::array({animation(2, "translation", times, values, "CUBICSPLINE")});
  const Model model = read(file);
  for (const double seconds : {1.0, 1.3, 2.0, 2.9, 3.0}) {
    const double t = (seconds - 1.0) / 2.0;
    const double t2 = t * t;
    const double t3 = t2 * t;
    const Vec3d expected = (2 * t3 - 3 * t2 + 1) * Vec3d(1, 2, 3) + 2.0 * (t3 - 2 * t2 + t) * Vec3d(0.5, -1, 2) +
                           (-2 * t3 + 3 * t2) * Vec3d(4, 0, -1) + 2.0 * (t3 - t2) * Vec3d(-2, 1, 0.25);
    expectNear(kneeAt(model, seconds).translation, expected);
  }
}

TEST(GltfAnimation, RotationsMayBeNormalisedIntegers) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{0, 1}, "SCALAR");
  const std::vector<std::int16_t> shorts{0, 0, 0, 32767, 0, 0, 23170, 23170};
  const std::vector<std::int8_t> bytes{0, 0, 0, 127, 0, 0, 90, 90};
  for (const int values : {file.accessor(shorts, "VEC4", true), file.accessor(bytes, "VEC4", true)}) {
    file.document["animations"] = Json::array({animation(2, "rotation", times, values)});
    const Model model = read(file);
    const Quatd eighth(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3d::UnitZ()));
    EXPECT_LT(kneeAt(model, 0.5).rotation.angularDistance(eighth), 1e-4);
    EXPECT_NEAR(kneeAt(model, 1.0).rotation.norm(), 1.0, 1e-12);
  }
}

TEST(GltfAnimation, JointsWithoutChannelStayAtRest) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{0}, "SCALAR");
  const int values = file.accessor(std::vector<float>{5, 5, 5}, "VEC3");
  file.document["animations"] = Json::array({animation(1, "translation", times, values)});
  const Model model = read(file);
  const human::Pose pose = human::sample(model.clips[0], *model.skeleton, 0);
  EXPECT_EQ(pose.local[0].translation, Vec3d(5, 5, 5));
  EXPECT_EQ(pose.local[1], model.skeleton->joints()[1].rest);
}

TEST(GltfAnimation, ClipsGetUniqueNamesAndUnnamedOnesTheirNumber) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{0}, "SCALAR");
  const int values = file.accessor(std::vector<float>{5, 5, 5}, "VEC3");
  Json walk = animation(1, "translation", times, values);
  const Json unnamed = walk;
  walk["name"] = "walk";
  file.document["animations"] = Json::array({unnamed, walk, walk, unnamed});
  const Model model = read(file);
  std::vector<std::string> names;
  for (const human::Clip& clip : model.clips) {
    names.push_back(clip.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"clip_0", "walk", "walk_2", "clip_3"}));
}

TEST(GltfAnimation, ChannelsThatCannotBeUsedAreNoted) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{0}, "SCALAR");
  const int values = file.accessor(std::vector<float>{5, 5, 5}, "VEC3");
  Json clip = animation(0, "translation", times, values);  // the mesh node is no joint
  clip["channels"].push_back({{"sampler", 0}, {"target", {{"node", 1}, {"path", "weights"}}}});
  clip["channels"].push_back({{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}});
  file.document["animations"] = Json::array({clip});
  const Model model = read(file);
  EXPECT_EQ(model.clips.at(0).channels.size(), 1U);
  EXPECT_EQ(issuesAbout(model, Severity::note, "2 of 3 channels"), 1U);

  GlbBuilder rigid = tetrahedronFile();
  const int at = rigid.accessor(std::vector<float>{0}, "SCALAR");
  const int to = rigid.accessor(std::vector<float>{5, 5, 5}, "VEC3");
  rigid.document["animations"] = Json::array({animation(0, "translation", at, to)});
  EXPECT_EQ(issuesAbout(read(rigid), Severity::note, "no mesh of the file has a skin"), 1U);
}

TEST(GltfAnimation, LongQuaternionsAreNormalisedWithAWarning) {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{0}, "SCALAR");
  const int values = file.accessor(std::vector<float>{0, 0, 2, 2}, "VEC4");
  file.document["animations"] = Json::array({animation(2, "rotation", times, values)});
  const Model model = read(file);
  EXPECT_NEAR(kneeAt(model, 0).rotation.z(), std::sqrt(0.5), 1e-12);
  EXPECT_EQ(issuesAbout(model, Severity::warning, "unit quaternions"), 1U);
}

}  // namespace
}  // namespace lorica::test
