#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "import_bytes.h"
#include "lorica/base/files.h"
#include "lorica/geometry/primitives.h"
#include "lorica/io/export.h"

namespace lorica::test {
namespace {

using geometry::TriangleMesh;
using io::SceneFormat;
using io::SceneMesh;

/// A skin and an organ, both welded, so that an import gives them back as they are.
struct Scene {
  TriangleMesh skin = geometry::ellipsoid({0, 0.9, 0}, {0.25, 0.85, 0.15}, 3);
  TriangleMesh heart = geometry::ellipsoid({0.05, 1.2, 0.02}, {0.05, 0.07, 0.04}, 2);
  std::vector<SceneMesh> meshes{{"skin", "body", skin.positions, skin.triangles, {0.9F, 0.7F, 0.6F, 0.5F}},
                                {"heart \"1\"\n", "organ", heart.positions, heart.triangles, {0.8F, 0.1F, 0.1F, 1.0F}}};
};

void expectSame(const TriangleMesh& found, const TriangleMesh& expected) {
  EXPECT_EQ(flat(found.positions), flat(expected.positions));
  EXPECT_EQ(found.triangles, expected.triangles);
}

TEST(SceneExport, GlbComesBackAsItWas) {
  const Scene scene;
  const io::Model model = importBytes(io::sceneBytes(scene.meshes, SceneFormat::glb), "scene.glb");
  ASSERT_EQ(model.parts.size(), 2U);
  EXPECT_EQ(model.parts[0].name, "skin");
  EXPECT_EQ(model.parts[1].name, "heart \"1\"");
  expectSame(model.parts[0].mesh, scene.skin);
  expectSame(model.parts[1].mesh, scene.heart);
  EXPECT_TRUE(model.issues.empty());
}

TEST(SceneExport, PlyComesBackAsItWas) {
  const Scene scene;
  const auto skinAlone = std::span(scene.meshes).first(1);
  const io::ImportOptions metres{base::LengthUnit::metre, io::UpAxis::y};
  expectSame(importBytes(io::sceneBytes(skinAlone, SceneFormat::ply), "skin.ply", metres).parts.at(0).mesh, scene.skin);

  const io::Model both = importBytes(io::sceneBytes(scene.meshes, SceneFormat::ply), "both.ply", metres);
  TriangleMesh expected = scene.skin;
  geometry::append(expected, scene.heart);
  expectSame(both.parts.at(0).mesh, expected);
}

TEST(SceneExport, PlyHeaderNamesTheStructures) {
  const Scene scene;
  const std::string bytes = io::sceneBytes(scene.meshes, SceneFormat::ply);
  EXPECT_NE(bytes.find("\ncomment structure 0 skin\n"), std::string::npos);
  EXPECT_NE(bytes.find("\ncomment structure 1 heart \"1\"\n"), std::string::npos);
  EXPECT_NE(bytes.find("\nproperty int structure\n"), std::string::npos);
}

TEST(SceneExport, GlbSaysWhereItsNumbersLie) {
  const Scene scene;
  const std::string bytes = io::sceneBytes(scene.meshes, SceneFormat::glb);
  std::uint32_t jsonLength = 0;
  std::memcpy(&jsonLength, bytes.data() + 12, 4);
  EXPECT_EQ(bytes.size() % 4, 0U);
  EXPECT_EQ(jsonLength % 4, 0U);
  const auto json = nlohmann::json::parse(bytes.substr(20, jsonLength));
  const auto& position = json["accessors"][json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()];
  const auto box = Eigen::AlignedBox3f(Eigen::Vector3f(-0.25F, 0.05F, -0.15F), Eigen::Vector3f(0.25F, 1.75F, 0.15F));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(position["min"][axis].get<float>(), box.min()[axis], 0.01F);
    EXPECT_NEAR(position["max"][axis].get<float>(), box.max()[axis], 0.01F);
  }
  EXPECT_EQ(json["materials"][0]["alphaMode"], "BLEND");
  EXPECT_FALSE(json["materials"][1].contains("alphaMode"));
  EXPECT_EQ(json["nodes"][1]["extras"]["kind"], "organ");
}

TEST(SceneExport, VtpHoldsTheTrianglesWithStructureColourAndNames) {
  const Scene scene;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(io::sceneBytes(scene.meshes, SceneFormat::vtp));
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  const std::size_t first = scene.skin.triangles.size();
  ASSERT_EQ(data->GetNumberOfCells(), static_cast<vtkIdType>(first + scene.heart.triangles.size()));
  ASSERT_EQ(data->GetNumberOfPoints(),
            static_cast<vtkIdType>(scene.skin.positions.size() + scene.heart.positions.size()));
  vtkDataArray* structure = data->GetCellData()->GetArray("structure");
  ASSERT_NE(structure, nullptr);
  EXPECT_EQ(structure->GetTuple1(static_cast<vtkIdType>(first) - 1), 0);
  EXPECT_EQ(structure->GetTuple1(static_cast<vtkIdType>(first)), 1);
  vtkDataArray* colour = data->GetCellData()->GetArray("colour");
  ASSERT_NE(colour, nullptr);
  EXPECT_EQ(colour->GetComponent(0, 3), 128) << "half transparent";
  EXPECT_EQ(colour->GetComponent(static_cast<vtkIdType>(first), 3), 255);
  auto* names = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("structure_names"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetValue(1), "heart \"1\"");
  double point[3];
  data->GetPoint(static_cast<vtkIdType>(scene.skin.positions.size()), point);
  EXPECT_EQ(point[1], static_cast<double>(scene.heart.positions[0].y()));
}

TEST(SceneExport, TheSameSceneGivesTheSameBytes) {
  for (const SceneFormat format : {SceneFormat::glb, SceneFormat::ply, SceneFormat::vtp}) {
    EXPECT_EQ(io::sceneBytes(Scene().meshes, format), io::sceneBytes(Scene().meshes, format));
  }
}

TEST(SceneExport, StructureWithoutTrianglesStaysANode) {
  const Scene scene;
  std::vector<SceneMesh> meshes = scene.meshes;
  meshes.push_back({"nothing", "armor", {}, {}});
  const io::Model model = importBytes(io::sceneBytes(meshes, SceneFormat::glb), "scene.glb");
  EXPECT_EQ(model.parts.size(), 2U);
  EXPECT_FALSE(io::sceneBytes({}, SceneFormat::glb).empty());
}

TEST(SceneExport, WritesAWholeFile) {
  const Scene scene;
  const ScratchFolder folder;
  const auto path = folder.path() / "out" / "scene.glb";
  io::writeScene(scene.meshes, SceneFormat::glb, path);
  EXPECT_EQ(base::readFile(path), io::sceneBytes(scene.meshes, SceneFormat::glb));
  folder.write("file", "");
  EXPECT_THROW(io::writeScene(scene.meshes, SceneFormat::glb, folder.path() / "file" / "scene.glb"), base::InputError);
}

}  // namespace
}  // namespace lorica::test
