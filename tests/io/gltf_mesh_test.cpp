#include <gtest/gtest.h>

#include <numbers>

#include "glb_builder.h"
#include "import_bytes.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"

namespace lorica::test {
namespace {

using base::Severity;
using geometry::Triangle;
using io::Model;

Model read(const GlbBuilder& file) {
  return importBytes(file.glb(), "file.glb");
}

double volume(const Model& model) {
  return geometry::signedVolume(model.parts.at(0).mesh);
}

template <class T>
Model readWithIndices() {
  GlbBuilder file;
  std::vector<T> indices;
  for (const std::uint16_t index : tetrahedronIndices()) {
    indices.push_back(static_cast<T>(index));
  }
  const int positions = file.accessor(tetrahedronCorners(), "VEC3");
  file.root({{"mesh", file.mesh({{"POSITION", positions}}, file.accessor(indices, "SCALAR"))}});
  return read(file);
}

TEST(GltfMesh, IndicesOf8And16And32BitsGiveTheSameMesh) {
  const auto expected = std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const Model& model :
       {readWithIndices<std::uint8_t>(), readWithIndices<std::uint16_t>(), readWithIndices<std::uint32_t>()}) {
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].mesh.triangles, expected);
    EXPECT_EQ(flat(model.parts[0].mesh.positions), tetrahedronCorners());
    EXPECT_TRUE(geometry::audit(model.parts[0].mesh).closed());
  }
}

TEST(GltfMesh, UnindexedCornersAreWeldedIntoAClosedMesh) {
  GlbBuilder file;
  std::vector<float> corners;
  for (const std::uint16_t index : tetrahedronIndices()) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners.push_back(tetrahedronCorners()[3 * index + k]);
    }
  }
  file.root({{"mesh", file.mesh({{"POSITION", file.accessor(corners, "VEC3")}})}});
  const Model model = read(file);
  EXPECT_EQ(model.parts[0].mesh.positions.size(), 4U);
  EXPECT_TRUE(geometry::audit(model.parts[0].mesh).closed());
  EXPECT_NEAR(volume(model), 1.0 / 6.0, 1e-12);
}

TEST(GltfMesh, StripAndFanCoverTheSquareTheirCornersSpanAndFaceOneWay) {
  for (const int mode : {5, 6}) {
    GlbBuilder file;
    const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const std::vector<float> fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    file.root({{"mesh", file.mesh({{"POSITION", file.accessor(mode == 5 ? strip : fan, "VEC3")}}, -1, mode)}});
    const Model model = read(file);
    ASSERT_EQ(model.parts[0].mesh.triangles.size(), 2U);
    EXPECT_NEAR(geometry::area(model.parts[0].mesh), 1.0, 1e-12);
    for (std::size_t t = 0; t < 2; ++t) {
      const auto& mesh = model.parts[0].mesh;
      const auto normal = (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
      EXPECT_GT(normal.z(), 0.0) << "mode " << mode << " triangle " << t;
    }
  }
}

TEST(GltfMesh, InterleavedVerticesAreReadAtTheirStride) {
  GlbBuilder file;
  std::vector<float> interleaved;
  for (std::size_t v = 0; v < 4; ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      interleaved.push_back(tetrahedronCorners()[3 * v + k]);
    }
    interleaved.insert(interleaved.end(), {9, 9, 9});  // a normal, not read
  }
  const int view = file.view(bytesOf(interleaved), 24);
  const int positions =
      file.add("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  file.root({{"mesh", file.mesh({{"POSITION", positions}}, file.accessor(tetrahedronIndices(), "SCALAR"))}});
  EXPECT_EQ(flat(read(file).parts[0].mesh.positions), tetrahedronCorners());
}

TEST(GltfMesh, AccessorOffsetIsCountedFromTheView) {
  GlbBuilder file;
  std::vector<float> numbers{7, 7, 7};
  const std::vector<float> corners = tetrahedronCorners();
  numbers.insert(numbers.end(), corners.begin(), corners.end());
  const int positions = file.add("accessors", {{"bufferView", file.view(bytesOf(numbers))},
                                               {"byteOffset", 12},
                                               {"componentType", 5126},
                                               {"count", 4},
                                               {"type", "VEC3"}});
  file.root({{"mesh", file.mesh({{"POSITION", positions}}, file.accessor(tetrahedronIndices(), "SCALAR"))}});
  EXPECT_EQ(flat(read(file).parts[0].mesh.positions), corners);
}

TEST(GltfMesh, SparseAccessorReplacesItsElementsAndStartsFromZerosWithoutAView) {
  GlbBuilder file = tetrahedronFile();
  const int indices = file.view(bytesOf(std::vector<std::uint16_t>{1, 3}));
  const int values = file.view(bytesOf(std::vector<float>{2, 0, 0, 0, 0, 3}));
  const Json sparse{{"count", 2},
                    {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                    {"values", {{"bufferView", values}}}};
  file.document["accessors"][0]["sparse"] = sparse;
  EXPECT_EQ(flat(read(file).parts[0].mesh.positions), (std::vector<float>{0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 3}));

  GlbBuilder zeros = tetrahedronFile();
  const int three = zeros.view(bytesOf(std::vector<std::uint8_t>{1, 2, 3}));
  const int corners = zeros.view(bytesOf(std::vector<float>{2, 0, 0, 0, 2, 0, 0, 0, 2}));
  zeros.document["accessors"][0].erase("bufferView");
  zeros.document["accessors"][0]["sparse"] = {{"count", 3},
                                              {"indices", {{"bufferView", three}, {"componentType", 5121}}},
                                              {"values", {{"bufferView", corners}}}};
  EXPECT_NEAR(volume(read(zeros)), 8.0 / 6.0, 1e-12);
}

TEST(GltfMesh, QuantisedPositionsAreReadWithTheirExtension) {
  GlbBuilder file;
  const std::vector<std::uint8_t> corners{0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255};
  const int positions = file.accessor(corners, "VEC3", true);
  file.root({{"mesh", file.mesh({{"POSITION", positions}}, file.accessor(tetrahedronIndices(), "SCALAR"))}});
  file.document["extensionsUsed"] = {"KHR_mesh_quantization"};
  file.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(flat(read(file).parts[0].mesh.positions), tetrahedronCorners());
}

TEST(GltfMesh, NodeTransformsMultiplyDownTheTree) {
  GlbBuilder file = tetrahedronFile();
  const double half = std::sqrt(0.5);
  file.document["nodes"][0]["translation"] = {1, 0, 0};
  file.add("nodes", {{"children", {0}}, {"scale", {2, 2, 2}}});
  file.add("nodes", {{"children", {1}}, {"rotation", {0, 0, half, half}}, {"translation", {0, 0, 5}}});
  file.document["scenes"][0]["nodes"] = {2};
  const Model model = read(file);
  // (x, y, z) + (1, 0, 0), doubled, a quarter turn about z, then 5 along z.
  const std::vector<float> expected{0, 2, 5, 0, 4, 5, -2, 2, 5, 0, 2, 7};
  const std::vector<float> found = flat(model.parts[0].mesh.positions);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-6);
  }
  EXPECT_NEAR(volume(model), 8.0 / 6.0, 1e-6);
}

TEST(GltfMesh, MatrixNodesGiveWhatTheirTrsWouldGive) {
  GlbBuilder trs = tetrahedronFile();
  trs.document["nodes"][0]["translation"] = {1, 2, 3};
  trs.document["nodes"][0]["scale"] = {2, 3, 4};
  GlbBuilder matrix = tetrahedronFile();
  matrix.document["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1};
  EXPECT_EQ(flat(read(trs).parts[0].mesh.positions), flat(read(matrix).parts[0].mesh.positions));
}

TEST(GltfMesh, MirroringNodeKeepsTheSurfaceOutward) {
  GlbBuilder file = tetrahedronFile();
  file.document["nodes"][0]["scale"] = {-1, 1, 1};
  const Model model = read(file);
  EXPECT_NEAR(volume(model), 1.0 / 6.0, 1e-12);
  EXPECT_EQ(issuesAbout(model, Severity::note, "inside out"), 0U);
}

TEST(GltfMesh, EveryMeshNodeIsAPartAndItsPrimitivesAreMerged) {
  GlbBuilder file = tetrahedronFile();
  const int far = file.accessor(std::vector<float>{5, 0, 0, 6, 0, 0, 5, 1, 0}, "VEC3");
  file.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", far}}}});
  file.root({{"mesh", 0}, {"name", "tetrahedron"}, {"translation", {0, 0, 9}}});
  file.root({{"mesh", 0}});
  file.document["nodes"][2].erase("name");
  const Model model = read(file);
  ASSERT_EQ(model.parts.size(), 3U);
  EXPECT_EQ(model.parts[0].name, "tetrahedron");
  EXPECT_EQ(model.parts[1].name, "tetrahedron_2");
  EXPECT_EQ(model.parts[2].name, "part_2");
  for (const io::Part& part : model.parts) {
    EXPECT_EQ(part.mesh.triangles.size(), 5U);
    EXPECT_EQ(part.mesh.positions.size(), 7U);
  }
}

TEST(GltfMesh, PrimitivesOnOneVertexBufferShareItsVertices) {
  GlbBuilder file;
  const int positions = file.accessor(tetrahedronCorners(), "VEC3");
  const int lower = file.accessor(std::vector<std::uint16_t>{0, 2, 1, 0, 1, 3}, "SCALAR");
  const int upper = file.accessor(std::vector<std::uint16_t>{0, 3, 2, 1, 2, 3}, "SCALAR");
  file.mesh({{"POSITION", positions}}, lower);
  file.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", positions}}}, {"indices", upper}});
  file.root({{"mesh", 0}});
  const Model model = read(file);
  EXPECT_EQ(model.parts[0].mesh.positions.size(), 4U);
  EXPECT_TRUE(geometry::audit(model.parts[0].mesh).closed());
}

TEST(GltfMesh, OnlyTheDefaultSceneIsRead) {
  GlbBuilder file = tetrahedronFile();
  const int other = file.add("nodes", {{"mesh", 0}, {"name", "other"}});
  file.add("scenes", {{"nodes", {other}}});
  EXPECT_EQ(read(file).parts[0].name, "tetrahedron");
  file.document["scene"] = 1;
  const Model model = read(file);
  ASSERT_EQ(model.parts.size(), 1U);
  EXPECT_EQ(model.parts[0].name, "other");
  EXPECT_EQ(issuesAbout(model, Severity::note, "scene 1 of 2"), 1U);
  file.document.erase("scene");
  file.document.erase("scenes");
  EXPECT_EQ(read(file).parts.size(), 2U) << "without scenes every node is read";
}

TEST(GltfMesh, BufferIsFoundBesideTheFile) {
  const GlbBuilder file = tetrahedronFile();
  const ScratchFolder folder;
  folder.write("corners of it.bin", file.binary);
  const Model model = io::importModel(folder.write("file.gltf", file.gltf("corners%20of%20it.bin")));
  EXPECT_EQ(flat(model.parts[0].mesh.positions), tetrahedronCorners());
}

TEST(GltfMesh, MissingTexturesDoNotMatter) {
  GlbBuilder file = tetrahedronFile();
  file.document["images"] = Json::array({{{"uri", "no_such.png"}}, {{"uri", "data:image/png;base64,AAAA"}}});
  file.document["textures"] = Json::array({{{"source", 0}}});
  const Model model = read(file);
  EXPECT_EQ(model.parts.size(), 1U);
  EXPECT_EQ(issuesAbout(model, Severity::note, "textures"), 1U);
}

TEST(GltfMesh, WhatIsNotUsedIsNoted) {
  GlbBuilder file = tetrahedronFile();
  file.document["cameras"] = Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
  file.document["extensionsUsed"] = {"VENDOR_thing"};
  auto& primitives = file.document["meshes"][0]["primitives"];
  primitives[0]["targets"] = Json::array({{{"POSITION", 0}}});
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  const Model model = read(file);
  for (const char* about : {"cameras", "VENDOR_thing", "morph targets", "points or lines"}) {
    EXPECT_EQ(issuesAbout(model, Severity::note, about), 1U) << about;
  }
  EXPECT_EQ(model.parts[0].mesh.triangles.size(), 4U);
}

TEST(GltfMesh, UnusedVerticesAndTrianglesWithoutAreaGo) {
  GlbBuilder file;
  std::vector<float> corners{8, 8, 8};
  const std::vector<float> tetrahedron = tetrahedronCorners();
  corners.insert(corners.end(), tetrahedron.begin(), tetrahedron.end());
  std::vector<std::uint16_t> indices{2, 2, 3};
  for (const std::uint16_t index : tetrahedronIndices()) {
    indices.push_back(static_cast<std::uint16_t>(index + 1));
  }
  file.root({{"mesh", file.mesh({{"POSITION", file.accessor(corners, "VEC3")}}, file.accessor(indices, "SCALAR"))}});
  const Model model = read(file);
  EXPECT_EQ(flat(model.parts[0].mesh.positions), tetrahedron);
  EXPECT_EQ(issuesAbout(model, Severity::note, "1 triangles without area were dropped"), 1U);
}

TEST(GltfMesh, ClosedSurfaceInsideOutIsTurned) {
  GlbBuilder file;
  std::vector<std::uint16_t> inward = tetrahedronIndices();
  for (std::size_t i = 0; i < inward.size(); i += 3) {
    std::swap(inward[i], inward[i + 1]);
  }
  const int positions = file.accessor(tetrahedronCorners(), "VEC3");
  file.root({{"mesh", file.mesh({{"POSITION", positions}}, file.accessor(inward, "SCALAR"))}});
  const Model model = read(file);
  EXPECT_NEAR(volume(model), 1.0 / 6.0, 1e-12);
  EXPECT_EQ(issuesAbout(model, Severity::note, "1 closed surfaces were inside out"), 1U);
}

}  // namespace
}  // namespace lorica::test
