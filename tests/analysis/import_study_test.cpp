#include "lorica/analysis/import_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lorica/analysis/check.h"
#include "lorica/analysis/export_pose.h"
#include "lorica/analysis/hashed_model.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/geometry/primitives.h"
#include "lorica/io/import.h"
#include "lorica/io/model_writer.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for every test.
class Import : public testing::Test {
 protected:
  Import() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("lorica_import_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Import() override { fs::remove_all(folder_); }

  fs::path ball(const std::string& name, const geometry::Vec3d& centre, double radius) const {
    const auto mesh = geometry::ellipsoid(centre, {radius, radius, radius}, 5);
    const io::SceneMesh scene{name, "organ", mesh.positions, mesh.triangles};
    const fs::path file = folder_ / (name + ".ply");
    io::writeScene(std::span(&scene, 1), io::SceneFormat::ply, file);
    return file;
  }
  ImportRequest request() const {
    ImportRequest made;
    made.skin = ball("skin", {0, 1, 0}, 0.9);
    made.studyFile = folder_ / "study.lorica.json";
    return made;
  }

  fs::path folder_;
};

TEST_F(Import, NestedSpheresWithoutARigGiveTheRatioOfTheirSolidAngles) {
  ImportRequest wanted = request();
  wanted.organs = {ball("core", {0, 1, 0}, 0.3)};
  const ImportedStudy imported = importStudy(wanted, {});
  study::saveStudy(imported.study, wanted.studyFile);
  const LoadedStudy loaded = load(study::loadStudy(wanted.studyFile), wanted.studyFile, {});
  const RunResult result = run(loaded, {});
  const double outer = shotline::solidAngle(std::asin(0.9 / 5.0));
  const double inner = shotline::solidAngle(std::asin(0.3 / 5.0));
  for (const ResultRow& row : summaryRows(loaded, result)) {
    if (row.structure == "core") {
      EXPECT_EQ(row.shots, 500000U) << "five trials of 100,000 by default";
      const double share = inner / outer;
      const double spread = std::sqrt(share * (1 - share) / static_cast<double>(row.bodyHits));
      EXPECT_NEAR(*row.percentOfBodyHits() / 100, share, 5 * spread + 2e-4);
    }
    if (row.structure == "body") {
      EXPECT_GT(row.percentOfShots(), 99.0) << "the cone bounds the sphere";
    }
  }
}

TEST_F(Import, ASkinWithoutARigCannotBePosed) {
  const ImportRequest wanted = request();
  const ImportedStudy imported = importStudy(wanted, {});
  const LoadedStudy loaded = load(imported.study, wanted.studyFile, {});
  EXPECT_THROW(resolvePose(loaded, "walk@1"), base::InputError);
}

TEST_F(Import, FollowsTheConventions) {
  ImportRequest wanted = request();
  wanted.organs = {ball("heart", {0, 1, 0}, 0.1), ball("lung_left", {0.2, 1, 0}, 0.1)};
  wanted.armor = {{"armor", ball("vest", {0, 1, 2}, 0.2)}, {"other", ball("helmet", {0, 2.2, 0}, 0.1)}};
  const study::Study study = importStudy(wanted, {}).study;
  EXPECT_EQ(study.name, "study");
  ASSERT_EQ(study.organs.size(), 2U);
  EXPECT_EQ(study.organs[0].name, "heart");
  EXPECT_EQ(study.organs[0].injuryClass, "essential");
  EXPECT_EQ(study.organs[1].injuryClass, "desirable");
  EXPECT_EQ(std::get<study::InputFile>(study.organs[0].mesh.from).path, "heart.ply");
  ASSERT_EQ(study.systems.size(), 2U);
  EXPECT_EQ(study.systems[0].name, "armor");
  EXPECT_EQ(study.systems[0].pieces[0].carriage, armor::Carriage::skinned);
  EXPECT_EQ(study.systems[1].pieces[0].carriage, armor::Carriage::rigid);
  ASSERT_EQ(study.sources.size(), 1U);
  EXPECT_EQ(study.sources[0].name, "front");
  EXPECT_LT((study.sources[0].position - geometry::Vec3d(0, 1, 5)).norm(), 1e-3);
  EXPECT_EQ(study.sources[0].shots, 100000U);
}

TEST_F(Import, SaysByHowMuchAnOrganIsOutsideTheSkin) {
  ImportRequest wanted = request();
  wanted.organs = {ball("spleen", {0.85, 1, 0}, 0.1)};
  bool said = false;
  for (const base::Issue& issue : importStudy(wanted, {}).issues) {
    said = said || (issue.place == "spleen" && issue.text.find("the farthest by 5") != std::string::npos);
  }
  EXPECT_TRUE(said) << "0.85 + 0.1 - 0.9 is 50 mm";
}

TEST_F(Import, SaysThatArmorFarFromTheBodyIsNotWorn) {
  ImportRequest wanted = request();
  wanted.armor = {{"armor", ball("near", {0, 1, 0.95}, 0.1)}, {"armor", ball("far", {0, 1, 3.0}, 0.1)}};
  std::vector<std::string> said;
  for (const base::Issue& issue : importStudy(wanted, {}).issues) {
    if (issue.text.find("not worn") != std::string::npos) {
      said.push_back(issue.place);
    }
  }
  EXPECT_EQ(said, std::vector<std::string>{"far"});
}

TEST_F(Import, AChangedInputIsRefusedUntilItIsAccepted) {
  ImportRequest wanted = request();
  wanted.organs = {ball("heart", {0, 1, 0}, 0.1)};
  const study::Study study = importStudy(wanted, {}).study;
  ball("heart", {0, 1, 0}, 0.2);
  try {
    load(study, wanted.studyFile, {});
    FAIL() << "the input has changed";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--accept-inputs"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(load(study::withCurrentHashes(study, wanted.studyFile), wanted.studyFile, {}));
}

TEST_F(Import, HashesAndReadsAFileAsOneAfterTheOther) {
  const fs::path file = ball("heart", {0, 1, 0}, 0.1);
  const HashedModel both = importHashed(file);
  const io::Model alone = io::importModel(file);
  EXPECT_EQ(both.sha256, study::sha256OfInput(file));
  ASSERT_EQ(both.model.parts.size(), 1U);
  EXPECT_EQ(both.model.parts[0].mesh.positions, alone.parts[0].mesh.positions);
  EXPECT_EQ(both.model.parts[0].mesh.triangles, alone.parts[0].mesh.triangles);
  EXPECT_THROW(importHashed(folder_ / "absent.ply"), base::InputError);
  EXPECT_THROW(importHashed("/dev/zero"), base::InputError) << "a device never ends";
}

TEST_F(Import, ExportsOfTheRestPoseComeBackAsTheSameMeshes) {
  ImportRequest wanted = request();
  wanted.organs = {ball("heart", {0, 1, 0}, 0.1)};
  const ImportedStudy imported = importStudy(wanted, {});
  const LoadedStudy loaded = load(imported.study, wanted.studyFile, {});
  const fs::path file = folder_ / "rest.glb";
  base::writeFileAtomically(file, exportPose(loaded, "rest", viscera::OrganModel::dynamic, io::SceneFormat::glb, {}));
  const io::Model model = io::importModel(file);
  ASSERT_EQ(model.parts.size(), 2U);
  EXPECT_EQ(model.parts[0].name, "body");
  EXPECT_EQ(model.parts[1].name, "heart");
  EXPECT_EQ(model.parts[1].mesh.positions, loaded.organs[0]->rig.rest.positions);
}

TEST_F(Import, AddsToAStudyAndKeepsWhatItHas) {
  ImportRequest first = request();
  first.organs = {ball("heart", {0, 1, 0}, 0.1)};
  first.armor = {{"armor", ball("vest", {0, 1, 1.0}, 0.05)}};
  const study::Study before = importStudy(first, {}).study;
  const LoadedStudy known = load(before, first.studyFile, {});

  ImportRequest more;
  more.studyFile = first.studyFile;
  more.skin = "not read";
  more.addTo = &before;
  more.organs = {ball("liver", {0.3, 1, 0}, 0.1), folder_ / "heart.ply"};
  more.armor = {{"armor", folder_ / "vest.ply"}, {"shield", ball("far", {0, 1, 3.0}, 0.1)}};
  for (const LoadedStudy* previous : {static_cast<const LoadedStudy*>(nullptr), &known}) {
    more.previous = previous;
    const ImportedStudy added = importStudy(more, {});
    study::Study rest = added.study;
    ASSERT_EQ(rest.organs.size(), 3U);
    EXPECT_EQ(rest.organs[1].name, "liver");
    EXPECT_EQ(rest.organs[2].name, "heart_2");
    ASSERT_EQ(rest.systems.size(), 2U);
    ASSERT_EQ(rest.systems[0].pieces.size(), 2U);
    EXPECT_EQ(rest.systems[0].pieces[1].name, "vest_2");
    EXPECT_EQ(rest.systems[1].name, "shield");
    rest.organs.resize(1);
    rest.systems.resize(1);
    rest.systems[0].pieces.resize(1);
    EXPECT_EQ(rest, before) << "nothing else was touched, and no source was added";
    EXPECT_NO_THROW(load(added.study, first.studyFile, {}));
    std::vector<std::string> notWorn;
    for (const base::Issue& issue : added.issues) {
      EXPECT_NE(issue.place, "heart") << "what was there before is not told again";
      if (issue.text.find("not worn") != std::string::npos) {
        notWorn.push_back(issue.place);
      }
    }
    EXPECT_EQ(notWorn, std::vector<std::string>{"far"});
  }
}

TEST_F(Import, CheckReportsWhatAnOpenMeshIs) {
  auto mesh = geometry::box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.pop_back();
  const io::SceneMesh scene{"box", "organ", mesh.positions, mesh.triangles};
  const fs::path file = folder_ / "box.ply";
  io::writeScene(std::span(&scene, 1), io::SceneFormat::ply, file);
  bool said = false;
  for (const base::Issue& issue : checkFile(file, {})) {
    said = said || issue.text.find("3 boundary edges") != std::string::npos;
  }
  EXPECT_TRUE(said);
}

TEST(InjuryClass, FollowsBreezeAndOthers) {
  EXPECT_EQ(injuryClassOf("Heart"), "essential");
  EXPECT_EQ(injuryClassOf("liver"), "essential");
  EXPECT_EQ(injuryClassOf("spleen"), "essential");
  EXPECT_EQ(injuryClassOf("VH_M_abdominal_aorta"), "essential");
  EXPECT_EQ(injuryClassOf("lung_right"), "desirable");
  EXPECT_EQ(injuryClassOf("small_intestine"), "desirable");
  EXPECT_EQ(injuryClassOf("spinal_cord"), "desirable");
  EXPECT_EQ(injuryClassOf("bladder"), "");
}

TEST_F(Import, ArmorWhoseFileSaysThatItDoesNotProtectIsLeftOut) {
  const auto mesh = geometry::ellipsoid({0, 1, 0}, {1.0, 1.0, 1.0}, 3);
  const auto piece = [&](const std::string& name, std::vector<bool> protects) {
    io::RiggedModel model;
    for (const bool part : protects) {
      model.meshes.push_back({{part ? "shell" : "cover", "armor", mesh.positions, mesh.triangles}, nullptr, part});
    }
    const fs::path file = folder_ / (name + ".glb");
    base::writeFileAtomically(file, io::modelBytes(model));
    return file;
  };
  ImportRequest wanted = request();
  wanted.armor = {{"covers", piece("satchel", {false})},
                  {"mixed", piece("satchel_2", {false})},
                  {"mixed", piece("vest", {true, false})}};
  const ImportedStudy imported = importStudy(wanted, {});
  ASSERT_EQ(imported.study.systems.size(), 1U) << "a system without a piece that protects is none";
  ASSERT_EQ(imported.study.systems[0].pieces.size(), 1U);
  EXPECT_EQ(imported.study.systems[0].pieces[0].name, "vest");
  EXPECT_EQ(imported.study.systems[0].pieces[0].nonProtecting, std::vector<std::string>{"cover"});
}

}  // namespace
}  // namespace lorica::analysis
