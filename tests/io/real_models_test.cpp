#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "import_bytes.h"
#include "lorica/base/files.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "real_data.h"

namespace lorica::test {
namespace {

using geometry::MeshAudit;
using geometry::Vec3d;
using io::Model;

Model load(const std::string& file) {
  return io::importModel(realData() / file);
}

std::size_t triangles(const Model& model) {
  std::size_t sum = 0;
  for (const io::Part& part : model.parts) {
    sum += part.mesh.triangles.size();
  }
  return sum;
}

/// Triangles that the issues about one part, or about all, say were dropped.
std::size_t droppedTriangles(const Model& model, const std::string& part = "") {
  std::size_t sum = 0;
  for (const base::Issue& issue : model.issues) {
    if (issue.text.ends_with("triangles without area were dropped") && (part.empty() || issue.place == part)) {
      sum += std::stoul(issue.text);
    }
  }
  return sum;
}

geometry::Box3d box(const Model& model) {
  geometry::Box3d all;
  for (const io::Part& part : model.parts) {
    all.extend(geometry::bounds(part.mesh.positions));
  }
  return all;
}

TEST(VisibleHuman, SkinIsClosedAndRigged) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/body.glb");
  const Model model = load("visible-human-male/body.glb");
  ASSERT_EQ(model.parts.size(), 1U);
  const geometry::TriangleMesh& mesh = model.parts[0].mesh;
  EXPECT_EQ(mesh.positions.size(), 53669U);
  EXPECT_EQ(mesh.triangles.size(), 107334U);
  EXPECT_TRUE(geometry::audit(mesh).closed());
  EXPECT_NEAR(geometry::signedVolume(mesh), 96.22e-3, 0.01e-3);
  EXPECT_NEAR(box(model).sizes().y(), 1.830, 1e-3);
  EXPECT_EQ(model.skeleton->size(), 48U);
  const human::Skeleton& skeleton = *model.skeleton;
  EXPECT_LT((skeleton.restPosition(*skeleton.find("knee_L")) - Vec3d(0.1481, -0.3927, -0.0122)).norm(), 1e-4);
  std::vector<std::string> clips;
  for (const human::Clip& clip : model.clips) {
    clips.push_back(clip.name);
  }
  EXPECT_EQ(clips,
            (std::vector<std::string>{"toe_touch", "belly_twist", "lateral_twist", "squat", "arm_raise", "walk"}));
  EXPECT_TRUE(model.issues.empty());
}

/// A row of PARTS.csv: one node of one organ file.
struct PartFacts {
  std::string name;
  std::size_t triangles = 0;
  bool closed = false;
  std::size_t components = 0;
  double cubicCentimetres = 0.0;
  Vec3d low, high;
};

std::map<std::string, std::vector<PartFacts>> partFacts() {
  std::istringstream table(base::readFile(realData() / "visible-human-male" / "PARTS.csv"));
  std::map<std::string, std::vector<PartFacts>> facts;
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) {
      cells.push_back(cell);
    }
    const auto number = [&](std::size_t column) { return cells[column].empty() ? 0.0 : std::stod(cells[column]); };
    facts[cells[0]].push_back({cells[1], static_cast<std::size_t>(number(2)), cells[4] == "1",
                               static_cast<std::size_t>(number(8)), number(9),
                               Vec3d(number(10), number(11), number(12)), Vec3d(number(13), number(14), number(15))});
  }
  return facts;
}

TEST(VisibleHuman, EveryPartOfEveryOrganIsAsItsTableSays) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/PARTS.csv");
  std::size_t files = 0;
  for (const auto& [file, rows] : partFacts()) {
    const Model model = load("visible-human-male/" + file);
    ASSERT_EQ(model.parts.size(), rows.size()) << file;
    ++files;
    for (std::size_t p = 0; p < rows.size(); ++p) {
      const PartFacts& facts = rows[p];
      const io::Part& part = model.parts[p];
      SCOPED_TRACE(file + " " + facts.name);
      EXPECT_EQ(part.name, facts.name);
      const geometry::Box3d found = geometry::bounds(part.mesh.positions);
      EXPECT_LT((found.min() - facts.low).cwiseAbs().maxCoeff(), 2e-5);
      EXPECT_LT((found.max() - facts.high).cwiseAbs().maxCoeff(), 2e-5);
      EXPECT_EQ(part.mesh.triangles.size() + droppedTriangles(model, part.name), facts.triangles);
      if (facts.closed) {
        EXPECT_TRUE(geometry::audit(part.mesh).closed());
        if (facts.components == 1) {
          EXPECT_NEAR(geometry::signedVolume(part.mesh) * 1e6, std::abs(facts.cubicCentimetres), 1e-3);
        }
      }
    }
  }
  EXPECT_EQ(files, 19U);
}

/// A row of the tables in README.md: one organ file.
struct FileFacts {
  std::string folder, name;
  std::size_t parts = 0, triangles = 0, open = 0;
  double cubicCentimetres = 0.0;
};

std::vector<FileFacts> fileFacts() {
  std::istringstream text(base::readFile(realData() / "visible-human-male" / "README.md"));
  std::vector<FileFacts> facts;
  std::string folder;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("### ")) {
      folder = line.substr(4);
    }
    std::replace(line.begin(), line.end(), '|', ' ');
    line.erase(std::remove(line.begin(), line.end(), ','), line.end());
    std::istringstream row(line);
    FileFacts file{folder, {}, 0, 0, 0, 0.0};
    if (!folder.empty() && row >> file.name >> file.parts >> file.triangles >> file.open >> file.cubicCentimetres) {
      facts.push_back(file);
    }
  }
  return facts;
}

TEST(VisibleHuman, EveryOrganFileIsAsTheReadmeSays) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/README.md");
  const std::vector<FileFacts> files = fileFacts();
  EXPECT_EQ(files.size(), 50U);
  for (const FileFacts& facts : files) {
    SCOPED_TRACE(facts.folder + facts.name);
    const Model model = load("visible-human-male/" + facts.folder + facts.name);
    EXPECT_EQ(model.parts.size(), facts.parts);
    EXPECT_EQ(triangles(model) + droppedTriangles(model), facts.triangles);
    std::size_t open = 0;
    double volume = 0.0;
    for (const io::Part& part : model.parts) {
      const MeshAudit audit = geometry::audit(part.mesh);
      open += audit.closed() ? 0 : 1;
      volume += geometry::signedVolume(part.mesh);
    }
    EXPECT_LE(open, facts.open) << "odd edges may still balance, but what closes stays closed";
    if (facts.folder == "organs_closed/") {
      EXPECT_NEAR(volume * 1e6, facts.cubicCentimetres, 0.6);
    }
  }
}

struct BodyCase {
  const char* file;
  std::size_t joints;
  std::size_t clips;
};

TEST(MakeHuman, BodiesAreOneClosedSurfaceOfThreeRigs) {
  LORICA_NEEDS_REAL_DATA("makehuman-male/body.glb");
  for (const BodyCase& body : {BodyCase{"body.glb", 163, 6}, {"body_12.glb", 163, 6}, {"body_cmu.glb", 31, 4}}) {
    SCOPED_TRACE(body.file);
    const Model model = load(std::string("makehuman-male/") + body.file);
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].mesh.positions.size(), 13380U);
    EXPECT_EQ(model.parts[0].mesh.triangles.size(), 26756U);
    const MeshAudit audit = geometry::audit(model.parts[0].mesh);
    EXPECT_TRUE(audit.closed());
    EXPECT_EQ(audit.components.size(), 1U);
    EXPECT_NEAR(geometry::signedVolume(model.parts[0].mesh), 65.28e-3, 0.01e-3);
    EXPECT_NEAR(geometry::area(model.parts[0].mesh), 1.830, 1e-3);
    EXPECT_EQ(model.skeleton->size(), body.joints);
    EXPECT_EQ(model.clips.size(), body.clips);
  }
  const Model raw = load("makehuman-male/body_12.glb");
  EXPECT_EQ(raw.parts[0].weights->influences, 9U) << "9 of the 12 places are used";
  EXPECT_EQ(issuesAbout(raw, base::Severity::warning, "did not sum to 1"), 1U);
}

TEST(MakeHuman, ObjHasTheSameVerticesAsTheGlb) {
  LORICA_NEEDS_REAL_DATA("makehuman-male/body_rest.obj");
  const Model obj = load("makehuman-male/body_rest.obj");
  const Model glb = load("makehuman-male/body.glb");
  EXPECT_EQ(obj.units, base::LengthUnit::metre);
  EXPECT_EQ(obj.up, io::UpAxis::y);
  EXPECT_EQ(obj.parts.at(0).mesh.triangles, glb.parts.at(0).mesh.triangles);
  for (std::size_t v = 0; v < glb.parts[0].mesh.positions.size(); ++v) {
    ASSERT_LT((obj.parts[0].mesh.positions[v] - glb.parts[0].mesh.positions[v]).norm(), 2e-6F) << v;
  }
}

TEST(MakeHuman, ArmorAndClothesAreOpenAndOfTheStatedSize) {
  LORICA_NEEDS_REAL_DATA("makehuman-male/armor/tactical_vest.glb");
  struct Case {
    const char* file;
    std::size_t triangles, pieces, boundary;
    Vec3d low, high;
  };
  const Vec3d vestLow(-0.2081, 0.9844, -0.1132), vestHigh(0.2099, 1.4999, 0.2311);
  const Vec3d suitLow(-0.3230, 0.0390, -0.1077), suitHigh(0.3203, 1.5191, 0.1655);
  const Vec3d shoesLow(-0.2525, -0.0019, -0.0555), shoesHigh(0.2525, 0.2166, 0.2201);
  for (const Case& piece : {Case{"armor/tactical_vest.glb", 37056, 59, 2722, vestLow, vestHigh},
                            {"armor/tactical_vest.obj", 37056, 59, 2722, vestLow, vestHigh},
                            {"armor/tactical_vest_skinned.glb", 37056, 59, 2722, vestLow, vestHigh},
                            {"clothes/worksuit.glb", 6986, 6, 554, suitLow, suitHigh},
                            {"clothes/worksuit.obj", 6986, 6, 554, suitLow, suitHigh},
                            {"clothes/shoes.glb", 3320, 4, 120, shoesLow, shoesHigh},
                            {"clothes/shoes.obj", 3320, 4, 120, shoesLow, shoesHigh}}) {
    SCOPED_TRACE(piece.file);
    const Model model = load(std::string("makehuman-male/") + piece.file);
    EXPECT_EQ(triangles(model), piece.triangles);
    const MeshAudit audit = geometry::audit(model.parts.at(0).mesh);
    EXPECT_FALSE(audit.closed());
    EXPECT_EQ(audit.components.size(), piece.pieces);
    EXPECT_EQ(audit.boundaryEdges, piece.boundary);
    EXPECT_LT((box(model).min() - piece.low).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_LT((box(model).max() - piece.high).cwiseAbs().maxCoeff(), 1e-4);
  }
  EXPECT_EQ(load("makehuman-male/armor/tactical_vest_skinned.glb").skeleton->size(), 163U);
}

TEST(CesiumMan, StandsUprightAndIsNormalised) {
  LORICA_NEEDS_REAL_DATA("cesium-man/cesium_man.gltf");
  const Model model = load("cesium-man/cesium_man.gltf");
  const Vec3d size = box(model).sizes();
  EXPECT_NEAR(size.y(), 1.507, 2e-3) << "its z before the turned root";
  EXPECT_GT(size.y(), size.x());
  EXPECT_GT(size.y(), size.z());
  EXPECT_EQ(model.skeleton->size(), 21U) << "19 joints and two nodes above them";
  EXPECT_EQ(model.clips.at(0).name, "clip_0");
  EXPECT_EQ(issuesAbout(model, base::Severity::warning, "did not sum to 1"), 1U);
  EXPECT_EQ(triangles(model), 4672U);
}

TEST(FlightHelmet, IsSixPartsWithoutItsTextures) {
  LORICA_NEEDS_REAL_DATA("flight-helmet/FlightHelmet.gltf");
  const Model model = load("flight-helmet/FlightHelmet.gltf");
  const std::vector<std::pair<std::string, std::size_t>> expected{
      {"Hose_low", 19680},       {"RubberWood_low", 24178},   {"GlassPlastic_low", 8136},
      {"MetalParts_low", 20096}, {"LeatherParts_low", 21896}, {"Lenses_low", 736}};
  ASSERT_EQ(model.parts.size(), expected.size());
  for (std::size_t p = 0; p < expected.size(); ++p) {
    EXPECT_EQ(model.parts[p].name, expected[p].first);
    EXPECT_EQ(model.parts[p].mesh.triangles.size(), expected[p].second);
  }
  EXPECT_NEAR(box(model).sizes().y(), 0.7160, 1e-4);
}

}  // namespace
}  // namespace lorica::test
