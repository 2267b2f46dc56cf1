#include "lorica/dialogs/import_dialog.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "lorica/base/files.h"
#include "lorica/geometry/primitives.h"
#include "lorica/io/export.h"
#include "lorica/study/study_file.h"

namespace lorica::dialogs {
namespace {

namespace fs = std::filesystem;

class Import : public testing::Test {
 protected:
  fs::path ball(const std::string& name, const geometry::Vec3d& centre, double radius) const {
    const auto mesh = geometry::ellipsoid(centre, {radius, radius, radius}, 4);
    const io::SceneMesh scene{name, "organ", mesh.positions, mesh.triangles};
    const fs::path file = folder_ / (name + ".ply");
    io::writeScene(std::span(&scene, 1), io::SceneFormat::ply, file);
    return file;
  }
  fs::path objBall(const std::string& name, const geometry::Vec3d& centre, double radius) const {
    const auto mesh = geometry::ellipsoid(centre, {radius, radius, radius}, 3);
    std::string text;
    for (const geometry::Vec3f& v : mesh.positions) {
      text += "v " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + "\n";
    }
    for (const geometry::Triangle& t : mesh.triangles) {
      text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
    }
    const fs::path file = folder_ / (name + ".obj");
    base::writeFileAtomically(file, text);
    return file;
  }
  template <class Widget>
  static Widget* part(const ImportDialog& dialog, const char* name) {
    auto* found = dialog.findChild<Widget*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  static bool canAccept(const ImportDialog& dialog) { return part<QPushButton>(dialog, "accept")->isEnabled(); }
  static bool waitUntilRead(const ImportDialog& dialog) {
    return QTest::qWaitFor([&] { return canAccept(dialog); }, 60000);
  }
  static std::string previewText(const ImportDialog& dialog) {
    std::string text;
    auto* table = part<QTableWidget>(dialog, "preview");
    for (int row = 0; row < table->rowCount(); ++row) {
      for (int column = 0; column < table->columnCount(); ++column) {
        text += table->item(row, column)->text().toStdString() + " | ";
      }
      text += "\n";
    }
    return text;
  }

  QTemporaryDir own_;
  fs::path folder_ = own_.path().toStdString();
  document::StudyDocument document_;
};

TEST(FileKinds, AreToldByTheEnding) {
  EXPECT_TRUE(isStudyFile("a/b.lorica.json"));
  EXPECT_TRUE(isStudyFile("a/b.JSON"));
  EXPECT_FALSE(isStudyFile("a/b.obj"));
  for (const char* ending : {"glb", "gltf", "obj", "stl", "ply", "off", "GLB"}) {
    EXPECT_TRUE(isMeshFile(std::string("x.") + ending)) << ending;
  }
  EXPECT_FALSE(isMeshFile("x.fbx"));
  EXPECT_FALSE(isMeshFile("glb"));
}

TEST(GuessRoles, FollowsNames) {
  using Files = std::vector<fs::path>;
  using Roles = std::vector<FileRole>;
  EXPECT_EQ(guessRoles(Files{"heart.ply", "Body.obj", "Vest_left.stl", "ESAPI_plate.stl", "human_liver.ply"}, true),
            (Roles{FileRole::organ, FileRole::skin, FileRole::armor, FileRole::armor, FileRole::organ}));
  EXPECT_EQ(guessRoles(Files{"body_armor.ply", "skin.ply"}, true), (Roles{FileRole::armor, FileRole::skin}));
  EXPECT_EQ(guessRoles(Files{"peter.obj"}, true), Roles{FileRole::skin}) << "the only file there is";
  EXPECT_EQ(guessRoles(Files{"peter.obj"}, false), Roles{FileRole::organ});
  EXPECT_EQ(guessRoles(Files{"heart.obj"}, true), Roles{FileRole::organ});
  EXPECT_EQ(guessRoles(Files{"body.obj", "heart.obj"}, false), (Roles{FileRole::ignore, FileRole::organ}));
  EXPECT_EQ(guessRoles(Files{"body.obj", "skin.obj"}, true), (Roles{FileRole::skin, FileRole::organ}))
      << "there is one skin";
}

TEST_F(Import, AFileWithASkeletonIsTheSkin) {
  const fs::path file = folder_ / "peter.gltf";
  std::ofstream(file) << R"({"asset": {"version": "2.0"}, "skins": [{"joints": [0]}]})";
  EXPECT_EQ(guessRoles(std::vector<fs::path>{"body.obj", file}, true), (std::vector{FileRole::organ, FileRole::skin}));
}

TEST_F(Import, NamesOfStudiesAreFree) {
  EXPECT_EQ(freeStudyFile(folder_, "peter"), folder_ / "peter.lorica.json");
  std::ofstream(folder_ / "peter.lorica.json") << "{}";
  std::ofstream(folder_ / "peter_2.lorica.json") << "{}";
  EXPECT_EQ(freeStudyFile(folder_, "peter"), folder_ / "peter_3.lorica.json");
}

TEST_F(Import, MakesAStudyOfFiles) {
  ImportDialog dialog(document_);
  dialog.show();
  EXPECT_FALSE(canAccept(dialog));
  EXPECT_FALSE(part<QRadioButton>(dialog, "open_study")->isEnabled()) << "there is none";
  dialog.addFiles({ball("body", {0, 1, 0}, 0.9), objBall("heart", {0, 1, 0}, 0.1), ball("vest", {0, 1, 1.0}, 0.05)});
  EXPECT_EQ(dialog.roles(), (std::vector{FileRole::skin, FileRole::organ, FileRole::armor}));
  EXPECT_FALSE(canAccept(dialog)) << "nothing was read yet";
  ASSERT_TRUE(waitUntilRead(dialog)) << part<QLabel>(dialog, "message")->text().toStdString();
  EXPECT_NE(previewText(dialog).find("heart"), std::string::npos);
  EXPECT_EQ(previewText(dialog).find("--units"), std::string::npos) << "a window has no options to type";
  dialog.accept();
  EXPECT_EQ(dialog.result(), QDialog::Accepted);
  EXPECT_FALSE(dialog.addsToOpenStudy());
  EXPECT_EQ(dialog.suggestedFile(), folder_ / "body.lorica.json");
  const study::Study made = dialog.study();
  ASSERT_EQ(made.organs.size(), 1U);
  EXPECT_EQ(made.organs[0].name, "heart");
  ASSERT_EQ(made.systems.size(), 1U);
  EXPECT_EQ(made.systems[0].pieces[0].name, "vest");
  EXPECT_NO_THROW(analysis::load(made, dialog.suggestedFile(), {}));
}

TEST_F(Import, PlatesJoinTheArmor) {
  ImportDialog dialog(document_);
  dialog.addFiles({ball("body", {0, 1, 0}, 0.9)});
  part<QCheckBox>(dialog, "plates")->setChecked(true);
  ASSERT_TRUE(waitUntilRead(dialog)) << previewText(dialog);
  dialog.accept();
  ASSERT_EQ(dialog.study().systems.size(), 1U);
  EXPECT_EQ(dialog.study().systems[0].pieces.size(), 2U);
}

TEST_F(Import, UnitsAreObeyed) {
  ImportDialog dialog(document_);
  dialog.addFiles({ball("body", {0, 1000, 0}, 900)});
  auto* units = part<QComboBox>(dialog, "units");
  units->setCurrentIndex(units->findData("mm"));
  ASSERT_TRUE(waitUntilRead(dialog)) << previewText(dialog);
  dialog.accept();
  EXPECT_EQ(std::get<study::InputFile>(dialog.study().human.from).units, base::LengthUnit::millimetre);
  EXPECT_NE(previewText(dialog).find("1.800"), std::string::npos) << previewText(dialog);
}

TEST_F(Import, SaysWhatIsMissing) {
  ImportDialog dialog(document_);
  dialog.addFiles({ball("heart", {0, 1, 0}, 0.1), ball("liver", {0, 1, 0}, 0.1)});
  EXPECT_FALSE(canAccept(dialog));
  EXPECT_TRUE(part<QLabel>(dialog, "message")->text().contains("skin")) << "there is no body";
  dialog.setRole(0, FileRole::skin);
  dialog.setRole(1, FileRole::skin);
  EXPECT_TRUE(part<QLabel>(dialog, "message")->text().contains("Only one"));
  QTest::qWait(500);
  EXPECT_FALSE(canAccept(dialog));
  dialog.setRole(1, FileRole::ignore);
  ASSERT_TRUE(waitUntilRead(dialog));
  EXPECT_TRUE(dialog.study().organs.empty());
}

TEST_F(Import, AChangeMakesWhatWasReadStale) {
  ImportDialog dialog(document_);
  dialog.addFiles({ball("body", {0, 1, 0}, 0.9), ball("heart", {0, 1, 0}, 0.1)});
  ASSERT_TRUE(waitUntilRead(dialog));
  dialog.setRole(1, FileRole::ignore);
  EXPECT_FALSE(canAccept(dialog));
  dialog.accept();
  EXPECT_NE(dialog.result(), QDialog::Accepted);
  ASSERT_TRUE(waitUntilRead(dialog));
  EXPECT_TRUE(dialog.study().organs.empty());
}

TEST_F(Import, ADamagedFileIsNamedAndNothingCanBeAccepted) {
  ImportDialog dialog(document_);
  const fs::path damaged = folder_ / "liver.ply";
  std::ofstream(damaged) << "ply\nformat ascii 1.0\nelement vertex 3\n";
  dialog.addFiles({ball("body", {0, 1, 0}, 0.9), damaged});
  ASSERT_TRUE(QTest::qWaitFor([&] { return previewText(dialog).find("Error") != std::string::npos; }, 30000));
  EXPECT_NE(previewText(dialog).find("liver.ply"), std::string::npos) << previewText(dialog);
  EXPECT_FALSE(canAccept(dialog));
  ball("liver", {0, 1, 0}, 0.1);
  part<QPushButton>(dialog, "read")->click();
  EXPECT_TRUE(waitUntilRead(dialog)) << "it was mended";
}

TEST_F(Import, UnknownKindsAreRefusedWithASentence) {
  ImportDialog dialog(document_);
  dialog.addFiles({folder_ / "body.fbx", folder_ / "old.lorica.json"});
  EXPECT_TRUE(dialog.roles().empty());
  const QString said = part<QLabel>(dialog, "message")->text();
  EXPECT_TRUE(said.contains("body.fbx"));
  EXPECT_TRUE(said.contains("old.lorica.json is a study"));
}

TEST_F(Import, AddingKeepsWhatTheOpenStudyHas) {
  const study::Study before = study::parseStudy(study::templateText("sample"), "sample");
  document_.setStudy(before, folder_ / "sample.lorica.json");
  ImportDialog dialog(document_);
  part<QRadioButton>(dialog, "open_study")->setChecked(true);
  dialog.addFiles({ball("heart", {0, 1.2, 0}, 0.05), ball("body", {0, 1, 0}, 0.9)});
  EXPECT_EQ(dialog.roles(), (std::vector{FileRole::organ, FileRole::ignore})) << "there is a body already";
  ASSERT_TRUE(waitUntilRead(dialog)) << previewText(dialog);
  dialog.accept();
  EXPECT_TRUE(dialog.addsToOpenStudy());
  EXPECT_EQ(dialog.suggestedFile(), document_.file());
  EXPECT_EQ(dialog.addText(), "Add 1 organ");
  study::Study after = dialog.study();
  ASSERT_EQ(after.organs.size(), before.organs.size() + 1);
  EXPECT_EQ(after.organs.back().name, "heart_2");
  after.organs.pop_back();
  EXPECT_EQ(after, before);
}

TEST_F(Import, ClosingWhileItReadsIsSafe) {
  auto dialog = std::make_unique<ImportDialog>(document_);
  dialog->addFiles({ball("body", {0, 1, 0}, 0.9)});
  part<QPushButton>(*dialog, "read")->click();
  dialog.reset();
  QTest::qWait(50);
}

}  // namespace
}  // namespace lorica::dialogs
