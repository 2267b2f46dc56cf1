#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "glb_builder.h"
#include "import_bytes.h"

namespace lorica::test {
namespace {

void expectRefused(const GlbBuilder& file, const std::string& about) {
  test::expectRefused(file.glb(), "file.glb", about);
}

/// The skinned file with one thing changed.
void expectRefused(const std::string& about, const std::function<void(GlbBuilder&)>& spoil) {
  GlbBuilder file = skinnedFile();
  spoil(file);
  SCOPED_TRACE(about);
  expectRefused(file, about);
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(BadGlb, ContainerMustFitTheFile) {
  const std::string good = tetrahedronFile().glb();
  for (const std::size_t kept : {5UL, 15UL, 30UL, good.size() / 2, good.size() - 1}) {
    test::expectRefused(good.substr(0, kept), "file.glb", kept < 20 ? "cut off" : "the file is cut or damaged");
  }
  test::expectRefused(good + "more", "file.glb", "states a length");
  std::string longChunk = good;
  longChunk[12] = '\x7F';
  longChunk[14] = '\x7F';
  test::expectRefused(longChunk, "file.glb", "chunk 0");
  std::string version = good;
  version[4] = 1;
  test::expectRefused(version, "file.glb", "version 1");
  std::string type = good;
  type[16] = 'X';
  test::expectRefused(type, "file.glb", "wrong type");
}

TEST(BadGlb, JsonMustBeGltf2) {
  test::expectRefused(GlbBuilder::container("{\"asset\":{\"version\":\"2.0\"", ""), "file.glb", "cannot be read");
  test::expectRefused(GlbBuilder::container("{\"asset\":{\"version\":\"1.0\"}}", ""), "file.glb", "is glTF 1.0");
  test::expectRefused(GlbBuilder::container("{\"meshes\":[]}", ""), "file.glb", "asset");
  test::expectRefused("{\"asset\":{\"version\":\"2.0\"}}", "file.gltf", "no triangles");
  const std::string deep = "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(100000, '[') + "}";
  test::expectRefused(GlbBuilder::container(deep, ""), "file.glb", "nested too deeply");
}

TEST(BadGlb, RequiredExtensionsMustBeKnown) {
  expectRefused("KHR_draco_mesh_compression",
                [](GlbBuilder& f) { f.document["extensionsRequired"] = {"KHR_draco_mesh_compression"}; });
}

TEST(BadGlb, MissingBufferFileIsNamed) {
  test::expectRefused(tetrahedronFile().gltf("lost.bin"), "file.gltf", "lost.bin");
}

TEST(BadGlb, AccessorsAndViewsMustFit) {
  expectRefused("buffer view 0", [](GlbBuilder& f) { f.document["bufferViews"][0]["byteLength"] = 1000000; });
  expectRefused("buffer view 0", [](GlbBuilder& f) { f.document["bufferViews"][0]["byteOffset"] = 1000000; });
  expectRefused("refers to buffer 7", [](GlbBuilder& f) { f.document["bufferViews"][0]["buffer"] = 7; });
  expectRefused("accessor 0: 5 elements", [](GlbBuilder& f) { f.document["accessors"][0]["count"] = 5; });
  expectRefused("accessor 0", [](GlbBuilder& f) { f.document["accessors"][0]["count"] = 4000000000000000000U; });
  expectRefused("accessor 0: is empty", [](GlbBuilder& f) { f.document["accessors"][0]["count"] = 0; });
  expectRefused("accessor 0", [](GlbBuilder& f) { f.document["accessors"][0]["byteOffset"] = 4; });
  expectRefused("buffer view 99", [](GlbBuilder& f) { f.document["accessors"][0]["bufferView"] = 99; });
  expectRefused("stride of 4", [](GlbBuilder& f) { f.document["bufferViews"][0]["byteStride"] = 4; });
  expectRefused("refers to accessor 99",
                [](GlbBuilder& f) { f.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99; });
  expectRefused("no buffer view", [](GlbBuilder& f) { f.document["accessors"][0].erase("bufferView"); });
}

TEST(BadGlb, TypesMustFitTheirUse) {
  expectRefused("VEC3 was expected", [](GlbBuilder& f) { f.document["accessors"][0]["type"] = "VEC4"; });
  expectRefused("component type 5123", [](GlbBuilder& f) { f.document["accessors"][0]["componentType"] = 5123; });
  expectRefused("component type 5122", [](GlbBuilder& f) { f.document["accessors"][1]["componentType"] = 5122; });
  expectRefused("file.glb", [](GlbBuilder& f) { f.document["accessors"][0]["componentType"] = 1; });
  expectRefused("component type 5126", [](GlbBuilder& f) { f.document["accessors"][2]["componentType"] = 5126; });
  expectRefused("unknown mode 9", [](GlbBuilder& f) { f.document["meshes"][0]["primitives"][0]["mode"] = 9; });
}

TEST(BadGlb, SparsePartsMustFit) {
  const auto spoil = [](const char* about, const std::function<void(Json&)>& change) {
    expectRefused(about, [&](GlbBuilder& f) {
      const int indices = f.view(bytesOf(std::vector<std::uint16_t>{1}));
      Json sparse{{"count", 1},
                  {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                  {"values", {{"bufferView", f.view(bytesOf(std::vector<float>{2, 0, 0}))}}}};
      change(sparse);
      f.document["accessors"][0]["sparse"] = sparse;
    });
  };
  spoil("replaces 9 of 4", [](Json& s) { s["count"] = 9; });
  spoil("replaces -1 of 4", [](Json& s) { s["count"] = -1; });
  spoil("negative offset", [](Json& s) { s["values"]["byteOffset"] = -4; });
  spoil("do not fit", [](Json& s) { s["values"]["byteOffset"] = 4; });
  spoil("unsigned integers", [](Json& s) { s["indices"]["componentType"] = 5126; });
  spoil("buffer view 77", [](Json& s) { s["indices"]["bufferView"] = 77; });
  GlbBuilder beyond = tetrahedronFile();
  beyond.document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", beyond.view(bytesOf(std::vector<std::uint16_t>{4}))}, {"componentType", 5123}}},
      {"values", {{"bufferView", beyond.view(bytesOf(std::vector<float>{2, 0, 0}))}}}};
  expectRefused(beyond, "replaces element 4, but has 4");
}

TEST(BadGlb, IndicesMustBeVertices) {
  GlbBuilder file;
  std::vector<std::uint16_t> indices = tetrahedronIndices();
  indices[5] = 4;
  const int positions = file.accessor(tetrahedronCorners(), "VEC3");
  file.root({{"mesh", file.mesh({{"POSITION", positions}}, file.accessor(indices, "SCALAR"))}});
  expectRefused(file, "index 5 is 4, but the primitive has 4 vertices");
  expectRefused("no multiple of 3", [](GlbBuilder& f) { f.document["accessors"][1]["count"] = 11; });
}

TEST(BadGlb, PositionsMustBeFinite) {
  for (const float bad : {nan, std::numeric_limits<float>::infinity()}) {
    GlbBuilder file = tetrahedronFile();
    std::vector<float> corners = tetrahedronCorners();
    corners[7] = bad;
    file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = file.accessor(corners, "VEC3");
    expectRefused(file, "POSITION, accessor 2: element 2 is not finite");
  }
}

TEST(BadGlb, ThereMustBeTriangles) {
  expectRefused("no triangles", [](GlbBuilder& f) { f.document["meshes"][0]["primitives"] = Json::array(); });
  expectRefused("no triangles", [](GlbBuilder& f) { f.document["scenes"][0]["nodes"] = Json::array(); });
  expectRefused("no triangles with area", [](GlbBuilder& f) {
    f.document["meshes"][0]["primitives"][0]["indices"] = f.accessor(std::vector<std::uint8_t>{0, 1, 1}, "SCALAR");
  });
}

TEST(BadGlb, NodesMustBeAForest) {
  expectRefused("round in a circle", [](GlbBuilder& f) { f.document["nodes"][2]["children"] = {1}; });
  expectRefused("child of two nodes", [](GlbBuilder& f) { f.document["nodes"][0]["children"] = {2}; });
  expectRefused("node 40", [](GlbBuilder& f) { f.document["nodes"][2]["children"] = {40}; });
  expectRefused("node -1", [](GlbBuilder& f) { f.document["nodes"][2]["children"] = {-1}; });
  expectRefused("refers to node 40", [](GlbBuilder& f) { f.document["scenes"][0]["nodes"] = {40}; });
  expectRefused("file has 1 scenes", [](GlbBuilder& f) { f.document["scene"] = 3; });
  expectRefused("refers to mesh 3", [](GlbBuilder& f) { f.document["nodes"][0]["mesh"] = 3; });
  expectRefused("refers to skin 3", [](GlbBuilder& f) { f.document["nodes"][0]["skin"] = 3; });
}

TEST(BadGlb, NodeTransformsMustBeTransforms) {
  expectRefused("zero quaternion", [](GlbBuilder& f) { f.document["nodes"][1]["rotation"] = {0, 0, 0, 0}; });
  expectRefused("3 were expected", [](GlbBuilder& f) { f.document["nodes"][1]["translation"] = {0, 0}; });
  expectRefused("16 were expected", [](GlbBuilder& f) { f.document["nodes"][1]["matrix"] = {1, 0, 0, 0}; });
  expectRefused("last row", [](GlbBuilder& f) {
    f.document["nodes"][1]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  });
  expectRefused("node 1 'hip'", [](GlbBuilder& f) { f.document["nodes"][1]["scale"] = {0, 1, 1}; });
  expectRefused("beyond all measure", [](GlbBuilder& f) { f.document["nodes"][1]["scale"] = {1e300, 1, 1}; });
}

TEST(BadGlb, SkinsMustBeUsable) {
  expectRefused("skin 0: has no joints", [](GlbBuilder& f) { f.document["skins"][0]["joints"] = Json::array(); });
  expectRefused("node 9 as a joint", [](GlbBuilder& f) { f.document["skins"][0]["joints"] = {1, 9}; });
  expectRefused("1 inverse bind matrices for 2", [](GlbBuilder& f) { f.document["accessors"][4]["count"] = 1; });
  const auto withSecondBind = [](const std::vector<float>& matrix) {
    return [matrix](GlbBuilder& f) {
      std::vector<float> binds = translationMatrix(0, 0, 0);
      binds.insert(binds.end(), matrix.begin(), matrix.end());
      f.document["skins"][0]["inverseBindMatrices"] = f.accessor(binds, "MAT4");
    };
  };
  expectRefused("matrix 1: cannot be inverted", withSecondBind({1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1}));
  std::vector<float> notFinite = translationMatrix(0, 0, 0);
  notFinite[0] = nan;
  expectRefused("not finite", withSecondBind(notFinite));
  std::vector<float> projective = translationMatrix(0, 0, 0);
  projective[3] = 1;
  expectRefused("last row", withSecondBind(projective));
}

void expectWeightsRefused(const std::string& about, const std::vector<float>& weights,
                          const std::vector<std::uint8_t>& joints) {
  expectRefused(about, [&](GlbBuilder& f) {
    auto& attributes = f.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = f.accessor(weights, "VEC4");
    attributes["JOINTS_0"] = f.accessor(joints, "VEC4");
  });
}

TEST(BadGlb, WeightsMustBeUsable) {
  const std::vector<std::uint8_t> joints(16, 0);
  const std::vector<float> good{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  std::vector<float> zero = good;
  zero[8] = 0;
  expectWeightsRefused("vertex 2 has weights that sum to zero", zero, joints);
  expectWeightsRefused("vertex 0 has weights that sum to zero", std::vector<float>(16, 0.0F), joints);
  std::vector<float> negative = good;
  negative[5] = -0.5F;
  expectWeightsRefused("vertex 1 has the negative weight", negative, joints);
  std::vector<float> notFinite = good;
  notFinite[5] = nan;
  expectWeightsRefused("not finite", notFinite, joints);
  std::vector<std::uint8_t> beyond = joints;
  beyond[12] = 2;
  expectWeightsRefused("vertex 3 uses joint 2, but its skin has 2 joints", good, beyond);
  expectWeightsRefused("3 elements for 4 vertices", std::vector<float>(12, 1.0F), joints);
  expectRefused("JOINTS_0 but no WEIGHTS_0",
                [](GlbBuilder& f) { f.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0"); });
  expectRefused("no JOINTS_0 and WEIGHTS_0", [](GlbBuilder& f) {
    f.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    f.document["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
  });
}

void expectClipRefused(const std::string& about, const std::vector<float>& times, const std::vector<float>& values,
                       const std::string& path, const std::string& interpolation = "LINEAR") {
  expectRefused(about, [&](GlbBuilder& f) {
    const int input = f.accessor(times, "SCALAR");
    const int output = f.accessor(values, path == "rotation" ? "VEC4" : "VEC3");
    f.document["animations"] = Json::array({animation(2, path, input, output, interpolation)});
  });
}

TEST(BadGlb, AnimationsMustBeUsable) {
  expectClipRefused("times do not rise", {1, 1}, {0, 0, 0, 1, 1, 1}, "translation");
  expectClipRefused("times do not rise", {2, 1}, {0, 0, 0, 1, 1, 1}, "translation");
  expectClipRefused("times, accessor 5: element 1 is not finite", {0, nan}, {0, 0, 0, 1, 1, 1}, "translation");
  expectClipRefused("element 1 is not finite", {0, 1}, {0, 0, 0, nan, 1, 1}, "translation");
  expectClipRefused("2 values for 3 times", {0, 1, 2}, {0, 0, 0, 1, 1, 1}, "translation");
  expectClipRefused("2 values for 2 times; 6 were expected", {0, 1}, {0, 0, 0, 1, 1, 1}, "translation", "CUBICSPLINE");
  expectClipRefused("unknown interpolation 'WOBBLE'", {0, 1}, {0, 0, 0, 1, 1, 1}, "translation", "WOBBLE");
  expectClipRefused("value 1 is the zero quaternion", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 0}, "rotation");
  const auto spoilClip = [](const std::string& about, const std::function<void(Json&)>& change) {
    expectRefused(about, [&](GlbBuilder& f) {
      const int input = f.accessor(std::vector<float>{0}, "SCALAR");
      Json clip = animation(2, "translation", input, f.accessor(std::vector<float>{0, 0, 0}, "VEC3"));
      change(clip);
      f.document["animations"] = Json::array({clip});
    });
  };
  spoilClip("refers to sampler 4", [](Json& clip) { clip["channels"][0]["sampler"] = 4; });
  spoilClip("moves node 44", [](Json& clip) { clip["channels"][0]["target"]["node"] = 44; });
  spoilClip("refers to accessor 44", [](Json& clip) { clip["samplers"][0]["input"] = 44; });
  spoilClip("earlier channel", [](Json& clip) { clip["channels"].push_back(clip["channels"][0]); });
}

TEST(BadGlb, MessagesStayOnOneLineWhateverTheNames) {
  expectRefused("zero quaternion", [](GlbBuilder& f) {
    f.document["nodes"][1]["name"] = "two\nlines\r\tand more" + std::string(5000, 'x');
    f.document["nodes"][1]["rotation"] = {0, 0, 0, 0};
  });
}

}  // namespace
}  // namespace lorica::test
