#include "lorica/analysis/deformation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "lorica/analysis/import_study.h"
#include "lorica/analysis/results.h"
#include "lorica/geometry/primitives.h"
#include "lorica/io/export.h"
#include "lorica/study/study_file.h"
#include "temporary_folder.h"

namespace lorica::analysis {
namespace {

namespace fs = std::filesystem;

using geometry::Vec3d;
using geometry::Vec3f;
using viscera::OrganModel;

const std::vector<OrganModel> allModels = {OrganModel::staticJoint, OrganModel::staticSkin, OrganModel::dynamicThesis,
                                           OrganModel::dynamic};

/// A trunk of two joints that bends in its middle.
/// \param belt blended linearly, with a belt that both joints hold alike: half a turn folds it onto the trunk's axis
std::shared_ptr<const parenting::BodyRig> trunk(bool belt = false) {
  parenting::Body body;
  body.skin = geometry::ellipsoid({0, 1, 0}, {0.2, 0.8, 0.15}, 4);
  human::Joint pelvis{"pelvis", std::nullopt, {}};
  pelvis.rest.translation = {0, 0.8, 0};
  human::Joint chest{"chest", human::JointIndex{0}, {}};
  chest.rest.translation = {0, 0.2, 0};
  body.skeleton = human::Skeleton({pelvis, chest});
  std::vector<human::Influence> influences;
  for (const Vec3f& p : body.skin.positions) {
    const double y = static_cast<double>(p.y());
    const double w = belt ? (y < 0.9 ? 0.0 : y > 1.1 ? 1.0 : 0.5) : std::clamp((y - 0.8) / 0.4, 0.0, 1.0);
    influences.push_back({0, 1 - w});
    influences.push_back({1, w});
  }
  body.weights = human::normaliseWeights(influences, 2).weights;
  body.regions = human::bodyRegions(body.skin, *body.weights, *body.skeleton);
  return std::make_shared<const parenting::BodyRig>(
      std::move(body),
      parenting::RigOptions{.siteSpacing = 0.06,
                            .skinning = belt ? human::Skinning::linear : human::Skinning::rotationCentres},
      base::Threads{});
}

struct NamedMesh {
  std::string name;
  geometry::TriangleMesh mesh;
  viscera::OrganOptions options{};
};

LoadedStudy studyOf(const std::shared_ptr<const parenting::BodyRig>& body, const std::vector<NamedMesh>& meshes) {
  LoadedStudy study;
  study.body = body;
  study.study.models = allModels;
  study.study.runPoses = {"rest", "bent"};
  study.study.poses = {{"bent", study::TurnedPose{{{"chest", Vec3d(50, 0, 0)}}}}};
  study.study.sources = {{"front", Vec3d(0, 1, 5), std::nullopt, study::Sampler::cone, 200}};
  study.study.trials = 1;
  for (const NamedMesh& named : meshes) {
    LoadedOrgan organ;
    organ.name = named.name;
    organ.rig = viscera::bindOrgan(named.mesh, named.name, *body, named.options, {});
    organ.topology = raycast::makeTopology(organ.rig.rest);
    study.study.organs.push_back({named.name, {study::Builtin{named.name}, {}}, "", std::nullopt, {}});
    study.organs.push_back(std::make_shared<const LoadedOrgan>(std::move(organ)));
  }
  return study;
}

NamedMesh gut() {
  return {"gut", geometry::ellipsoid({0.02, 1.0, 0.01}, {0.1, 0.3, 0.07}, 3)};
}

std::vector<NamedMesh> twoNeighbours() {
  return {{"upper", geometry::box({-0.08, 1.0, -0.05}, {0.08, 1.3, 0.05})},
          {"lower", geometry::box({-0.08, 0.75, -0.05}, {0.08, 0.9995, 0.05})}};
}

/// Fields of every line, the header first.
std::vector<std::vector<std::string>> fieldsOf(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream fields(line + ",");
    for (std::string field; std::getline(fields, field, ',');) {
      row.push_back(field);
    }
  }
  return rows;
}

TEST(DeformationTables, HaveARowPerOrganPoseAndModelAndAFieldPerColumn) {
  const LoadedStudy study = studyOf(trunk(), twoNeighbours());
  const RunResult result = run(study, {});
  const DeformationTables tables = deformationTables(study, result);
  const auto organs = fieldsOf(deformationCsv(tables));
  const auto contacts = fieldsOf(contactsCsv(tables));
  const auto rooms = fieldsOf(roomCsv(tables));
  EXPECT_EQ(organs.size(), 1 + 4 * 2 * 2U);
  EXPECT_EQ(contacts.size(), 1 + 4 * 2 * 1U);
  EXPECT_EQ(rooms.size(), 1 + 2U);
  for (const auto& table : {organs, contacts, rooms}) {
    for (const auto& row : table) {
      EXPECT_EQ(row.size(), table[0].size());
    }
  }
  for (const auto& row : organs) {
    if (row[2] == "rest") {
      EXPECT_EQ(std::vector(row.begin() + 3, row.begin() + 11),
                (std::vector<std::string>{"0.000000", "0.000000", "0.000000", "0.000000", "0.000000", "0", "1.000000",
                                          "1.000000"}))
          << row[0] << " in " << row[1];
    }
  }
}

TEST(DeformationTables, TheOverlapOfAnOrganIsTheSumOfItsContacts) {
  std::vector<NamedMesh> meshes = twoNeighbours();
  meshes.push_back(gut());
  const LoadedStudy study = studyOf(trunk(), meshes);
  const RunResult result = run(study, {});
  std::map<std::string, double> sums;
  for (const auto& row : fieldsOf(contactsCsv(deformationTables(study, result)))) {
    if (row[0] != "structure_a") {
      sums[row[0] + "/" + row[2] + "/" + row[3]] += std::stod(row[4]);
      sums[row[1] + "/" + row[2] + "/" + row[3]] += std::stod(row[4]);
    }
  }
  for (const auto& row : fieldsOf(deformationCsv(deformationTables(study, result)))) {
    if (row[0] != "structure") {
      EXPECT_NEAR(std::stod(row[6]), sums.at(row[0] + "/" + row[1] + "/" + row[2]), 3e-6) << row[0];
    }
  }
}

TEST(DeformationTables, ARigidModelPartsWhereALatticeKeepsTheSeal) {
  const LoadedStudy study = studyOf(trunk(), twoNeighbours());
  const RunResult result = run(study, {});
  std::map<std::string, double> gapOrOverlap;
  for (const ModelDeformation& row : result.deformations) {
    if (row.pose == 1) {
      const viscera::ContactAudit& contact = row.audit.contacts.at(0);
      gapOrOverlap[viscera::name(result.models[row.model])] = contact.gap->largest + std::cbrt(contact.overlap->value);
      EXPECT_EQ(row.lattices[0].cells == 0, row.model < 2) << "only lattice models have cells";
    }
  }
  EXPECT_GT(gapOrOverlap["static_joint"], 0.01);
  EXPECT_LT(gapOrOverlap["dynamic"], 0.2 * gapOrOverlap["static_joint"]);
}

TEST(DeformationTables, SayWhichBarGaveWayAndByHowMuch) {
  viscera::OrganAudit organ;
  organ.volume = 100e-6;
  organ.volumeChange = -0.031;
  organ.protrusion = 0.0009;
  organ.overlapBeyondRest = 0.4e-6;
  viscera::LatticeQuality lattice;
  EXPECT_EQ(gaveWay("liver", organ, lattice), "volume -3.1 %");
  EXPECT_EQ(gaveWay("lung_left", organ, lattice), "") << "lungs may give way by 5 %";
  organ.volumeChange = 0.2;
  organ.protrusion = 0.0123;
  organ.overlapBeyondRest = 0.6e-6;
  lattice.inverted = 3;
  EXPECT_EQ(gaveWay("lung_left", organ, lattice),
            "3 cells inverted; protrusion 12.3 mm; overlap 0.6 cm3; volume +20.0 %");
  EXPECT_EQ(gaveWay("liver", viscera::OrganAudit{}, viscera::LatticeQuality{}), "") << "nothing known, nothing said";
}

TEST(DeformationTables, AreTheSameBytesAtOneTwoAndFiveThreads) {
  const LoadedStudy study = studyOf(trunk(), twoNeighbours());
  std::vector<std::string> bytes;
  for (const int threads : {1, 2, 5}) {
    RunOptions options;
    options.threads = {threads};
    const DeformationTables tables = deformationTables(study, run(study, options));
    bytes.push_back(deformationCsv(tables) + contactsCsv(tables) + roomCsv(tables));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_EQ(bytes[0], bytes[2]);
}

TEST(DeformationTables, OfACancelledRunHoldOnlyWhatWasMeasured) {
  const LoadedStudy study = studyOf(trunk(), twoNeighbours());
  base::Task task;
  task.cancel();
  const RunResult result = run(study, {}, base::Progress(task));
  EXPECT_TRUE(result.partial);
  const DeformationTables tables = deformationTables(study, result);
  EXPECT_EQ(fieldsOf(deformationCsv(tables)).size(), 1U);
  EXPECT_EQ(fieldsOf(contactsCsv(tables)).size(), 1U);
  EXPECT_EQ(fieldsOf(roomCsv(tables)).size(), 1U);
}

TEST(DegenerateOrgans, SpoilNothingForTheOthers) {
  const auto body = trunk();
  geometry::TriangleMesh splinter;
  splinter.positions = {Vec3f(0, 1, 0), Vec3f(0.01F, 1, 0), Vec3f(0, 1.01F, 0)};
  splinter.triangles = {{0, 1, 2}};
  viscera::OrganOptions unpruned;
  unpruned.lattice.layout = viscera::LatticeOptions::Layout::uniform;
  unpruned.lattice.cells = {6, 6, 6};
  unpruned.lattice.prune = false;
  const LoadedStudy alone = studyOf(body, {gut()});
  const LoadedStudy crowd =
      studyOf(body, {gut(),
                     {"stray", geometry::ellipsoid({0.5, 1.0, 0}, Vec3d::Constant(0.05), 2)},
                     {"giant", geometry::ellipsoid({0, 1, 0}, {0.5, 1.2, 0.4}, 3)},
                     {"splinter", splinter},
                     {"hollow lattice", geometry::box({-0.05, 0.9, -0.05}, {0.05, 1.1, 0.05}), unpruned}});
  const RunResult one = run(alone, {});
  const RunResult many = run(crowd, {});
  ASSERT_EQ(many.deformations.size(), one.deformations.size());
  for (std::size_t r = 0; r < one.deformations.size(); ++r) {
    const viscera::OrganAudit& expected = one.deformations[r].audit.organs[0];
    const viscera::OrganAudit& found = many.deformations[r].audit.organs[0];
    EXPECT_EQ(found.volumeChange, expected.volumeChange);
    EXPECT_EQ(found.protrusion, expected.protrusion);
    EXPECT_EQ(found.largestStretch, expected.largestStretch);
    EXPECT_NEAR(found.outsideShare->value, expected.outsideShare->value, 1e-6);
    EXPECT_EQ(many.deformations[r].lattices[0], one.deformations[r].lattices[0]);
    EXPECT_EQ(many.deformations[r].audit.organs[1].outsideShare->value, 1.0) << "the stray is outside in every pose";
    EXPECT_GT(many.deformations[r].audit.organs[2].outsideShare->value, 0.5) << "the giant has no room";
    EXPECT_FALSE(many.deformations[r].audit.organs[3].volume) << "one triangle has no volume";
  }
  for (const auto& row : fieldsOf(deformationCsv(deformationTables(crowd, many)))) {
    for (const std::string& field : row) {
      EXPECT_EQ(field.find("nan"), std::string::npos) << row[0];
      EXPECT_EQ(field.find("inf"), std::string::npos) << row[0];
    }
  }
  const auto names = [&](const std::string& organ, const std::string& cause) {
    return std::any_of(many.issues.begin(), many.issues.end(), [&](const base::Issue& issue) {
      return issue.place == organ && issue.text.find(cause) != std::string::npos;
    });
  };
  EXPECT_TRUE(names("splinter", "does not close"));
}

TEST(DegenerateOrgans, OutsideTheSkinOrLargerThanItAreNamedOnReading) {
  const test::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  const auto file = [&](const std::string& name, const geometry::TriangleMesh& mesh) {
    const io::SceneMesh scene{name, "organ", mesh.positions, mesh.triangles};
    io::writeScene(std::span(&scene, 1), io::SceneFormat::ply, folder / (name + ".ply"));
    return folder / (name + ".ply");
  };
  ImportRequest request;
  request.skin = file("skin", geometry::ellipsoid({0, 1, 0}, {0.2, 0.8, 0.15}, 4));
  request.organs = {file("stray", geometry::ellipsoid({0.5, 1.0, 0}, Vec3d::Constant(0.05), 2)),
                    file("giant", geometry::ellipsoid({0, 1, 0}, {0.5, 1.2, 0.4}, 3))};
  request.studyFile = folder / "study.lorica.json";
  const LoadedStudy study = load(importStudy(request, {}).study, request.studyFile, {});
  for (const std::string name : {"stray", "giant"}) {
    EXPECT_TRUE(std::any_of(study.issues.begin(), study.issues.end(), [&](const base::Issue& issue) {
      return issue.place == name && issue.text.find("not inside the skin") != std::string::npos;
    })) << name;
  }
}

TEST(DegeneratePoses, CollapsedAnchorsGiveAnIssueAndFiniteOrgans) {
  LoadedStudy study = studyOf(trunk(true), {gut()});
  study.study.poses = {{"wrung", study::TurnedPose{{{"chest", Vec3d(0, 180, 0)}}}}};
  study.study.runPoses = {"wrung"};
  const RunResult result = run(study, {});
  EXPECT_GT(result.collapsedSites.at(0), 0U);
  EXPECT_TRUE(std::any_of(result.issues.begin(), result.issues.end(), [](const base::Issue& issue) {
    return issue.place == "wrung" && issue.text.find("collapsed") != std::string::npos;
  }));
  for (const auto& row : fieldsOf(deformationCsv(deformationTables(study, result)))) {
    for (const std::string& field : row) {
      EXPECT_EQ(field.find("nan"), std::string::npos) << row[1];
      EXPECT_EQ(field.find("inf"), std::string::npos) << row[1];
    }
  }
}

}  // namespace
}  // namespace lorica::analysis
