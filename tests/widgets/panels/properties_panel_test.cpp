#include "lorica/panels/properties_panel.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QUndoStack>

#include "lorica/commands/edits.h"
#include "lorica/document/appearance.h"
#include "lorica/panels/property_form.h"
#include "sample_document.h"

namespace lorica::panels {
namespace {

using document::ItemKind;
using document::ItemRef;

class Properties : public testing::Test {
 protected:
  Properties() : panel_(document_) {
    testsupport::openLoadedSample(document_);
    panel_.resize(360, 700);
    panel_.show();
  }

  template <class Editor>
  Editor* editor(const char* name) const {
    auto* found = panel_.form()->findChild<Editor*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  void select(ItemKind kind, const std::string& name = {}) { document_.select(ItemRef{kind, name}); }
  /// One named command was pushed by `edit`, undoing it gives the study back, redoing it the edit.
  void expectOneEdit(const std::function<void()>& edit, const std::function<QString()>& shown) {
    QUndoStack& stack = document_.undoStack();
    const study::Study before = document_.study();
    const QString shownBefore = shown();
    const int count = stack.count();
    edit();
    ASSERT_EQ(stack.count(), count + 1);
    EXPECT_FALSE(stack.undoText().isEmpty());
    const study::Study after = document_.study();
    EXPECT_NE(after, before);
    const QString shownAfter = shown();
    EXPECT_NE(shownAfter, shownBefore);
    stack.undo();
    EXPECT_EQ(document_.study(), before);
    EXPECT_EQ(shown(), shownBefore) << "the editor follows undo";
    stack.redo();
    EXPECT_EQ(document_.study(), after);
    EXPECT_EQ(shown(), shownAfter) << "and redo";
  }
  void expectNumberEdit(const char* name, double value) {
    auto* spin = editor<QDoubleSpinBox>(name);
    expectOneEdit([&] { spin->setValue(value); }, [spin] { return spin->text(); });
  }
  void expectChoiceEdit(const char* name, const QString& id) {
    auto* combo = editor<QComboBox>(name);
    ASSERT_GE(combo->findData(id), 0);
    expectOneEdit([&] { combo->setCurrentIndex(combo->findData(id)); },
                  [combo] { return combo->currentData().toString(); });
  }
  void expectLineEdit(const char* name, const QString& text) {
    auto* line = editor<QLineEdit>(name);
    expectOneEdit(
        [&] {
          line->selectAll();
          QTest::keyClicks(line, text);
          QTest::keyClick(line, Qt::Key_Return);
        },
        [line] { return line->text(); });
  }
  void expectCheckEdit(const char* name) {
    auto* box = editor<QCheckBox>(name);
    expectOneEdit([&] { box->toggle(); }, [box] { return QString::number(int(box->isChecked())); });
  }

  document::StudyDocument document_;
  PropertiesPanel panel_;
};

TEST(PropertiesPanel, IsEmptyWithoutASelection) {
  document::StudyDocument document;
  PropertiesPanel panel(document);
  EXPECT_EQ(panel.form(), nullptr);
  testsupport::openSample(document);
  EXPECT_EQ(panel.form(), nullptr);
  document.select(ItemRef{ItemKind::organ, "heart"});
  EXPECT_NE(panel.form(), nullptr);
  document.close();
  EXPECT_EQ(panel.form(), nullptr);
}

TEST_F(Properties, LookingAtThingsEditsNothing) {
  testsupport::addSampleRun(document_);
  QSignalSpy edits(&document_, &document::StudyDocument::studyChanged);
  for (const ItemRef& item : {ItemRef{}, ItemRef{ItemKind::body, ""}, ItemRef{ItemKind::organ, "heart"},
                              ItemRef{ItemKind::system, "full_torso"}, ItemRef{ItemKind::piece, "plate_front"},
                              ItemRef{ItemKind::pose, "rest"}, ItemRef{ItemKind::pose, "toe_touch@2"},
                              ItemRef{ItemKind::source, "front"}, ItemRef{ItemKind::run, "Run 1"},
                              ItemRef{ItemKind::region, document_.loaded()->body->body().regions.names.front()}}) {
    document_.select(item);
    ASSERT_NE(panel_.form(), nullptr) << item.name;
    EXPECT_EQ(document_.selection(), item);
    panel_.form()->refresh();
    QTest::qWait(1);
  }
  EXPECT_EQ(edits.count(), 0);
  EXPECT_EQ(document_.undoStack().count(), 0);
}

TEST_F(Properties, EveryEditorOfTheStudyPushesOneCommand) {
  select(ItemKind::study);
  expectLineEdit("name", "walking");
  expectNumberEdit("trials", 7);
  expectLineEdit("seed", "18446744073709551615");
  EXPECT_EQ(document_.study().seed, 18446744073709551615ULL);
  expectCheckEdit("model_static_skin");
  expectCheckEdit("model_static_joint");
  auto* text = editor<QPlainTextEdit>("description");
  expectOneEdit(
      [&] {
        text->setFocus();
        QTest::keyClicks(text, "x");
        text->clearFocus();
        QFocusEvent out(QEvent::FocusOut);
        QApplication::sendEvent(text, &out);
      },
      [text] { return text->toPlainText(); });
}

TEST_F(Properties, TheLastModelCannotBeTakenAway) {
  select(ItemKind::study);
  editor<QCheckBox>("model_static_joint")->setChecked(false);
  EXPECT_EQ(document_.study().models, std::vector{study::OrganModel::dynamic});
  EXPECT_FALSE(editor<QCheckBox>("model_dynamic")->isEnabled());
}

TEST_F(Properties, EveryEditorOfAnOrganPushesOneCommand) {
  select(ItemKind::organ, "heart");
  expectChoiceEdit("class", "desirable");
  expectChoiceEdit("joint", QString::fromStdString(document_.loaded()->body->body().skeleton->joints().front().name));
  expectNumberEdit("cell", 25.0);
  EXPECT_DOUBLE_EQ(document_.study().organs[0].lattice.cellMetres, 0.025);
  using Layout = study::LatticeSettings::Layout;
  expectChoiceEdit("layout", QString::number(int(Layout::uniform)));
  expectNumberEdit("cells", 4.0);
  expectChoiceEdit("layout", QString::number(int(Layout::perAxis)));
  expectNumberEdit("axis_cells_y", 6.0);
  EXPECT_EQ(document_.study().organs[0].lattice.cells[1], 6);
  expectCheckEdit("visible");
  expectNumberEdit("opacity", 35.0);
  EXPECT_EQ(document_.study().organs[1].lattice, study::LatticeSettings{}) << "other organs are as they were";
}

TEST_F(Properties, LatticeShowsWhatItsLayoutUses) {
  select(ItemKind::organ, "heart");
  auto* layout = editor<QComboBox>("layout");
  using Layout = study::LatticeSettings::Layout;
  for (const auto& [wanted, shown] : {std::pair{Layout::cellSize, "cell"},
                                      {Layout::uniform, "cells"},
                                      {Layout::perAxis, "axis_cells"},
                                      {Layout::boundingBox, "none"}}) {
    layout->setCurrentIndex(layout->findData(QString::number(int(wanted))));
    for (const char* id : {"cell", "cells", "axis_cells"}) {
      EXPECT_EQ(editor<QWidget>(id)->isVisibleTo(panel_.form()), std::string(id) == shown) << id;
    }
  }
}

TEST_F(Properties, DraggingAValueIsOneStepOfUndo) {
  select(ItemKind::organ, "heart");
  auto* opacity = editor<QDoubleSpinBox>("opacity");
  for (const double percent : {90.0, 70.0, 50.0, 30.0}) {
    opacity->setValue(percent);
  }
  EXPECT_EQ(document_.undoStack().count(), 1);
  document_.undoStack().undo();
  EXPECT_TRUE(document_.study().displays.empty());
}

TEST_F(Properties, ColourGoesBackToTheDefault) {
  select(ItemKind::organ, "heart");
  commands::setColour(document_, "heart", std::array<std::uint8_t, 3>{1, 2, 3});
  EXPECT_EQ(editor<QToolButton>("colour")->text(), "#010203");
  editor<QToolButton>("colour_default")->click();
  EXPECT_EQ(document::appearanceOf(document_.study(), "heart").colour,
            document::defaultAppearance(document_.study(), "heart").colour);
}

TEST_F(Properties, WhatAPieceIsMadeOfIsKeptForTheRecordAndCanBeTakenBack) {
  select(ItemKind::piece, "plate_front");
  ASSERT_EQ(document_.study().systems[0].pieces[8].name, "plate_front");
  const auto piece = [this]() -> const study::ArmorPiece& { return document_.study().systems[0].pieces[8]; };
  const study::Study before = document_.study();
  auto* material = editor<QLineEdit>("material");
  material->setFocus();
  material->selectAll();
  QTest::keyClicks(material, "  boron  carbide ");
  QTest::keyClick(material, Qt::Key_Return);
  EXPECT_EQ(piece().material, "boron carbide");
  auto* density = editor<QDoubleSpinBox>("density");
  density->setValue(32.5);
  EXPECT_EQ(piece().arealDensity, 32.5);
  EXPECT_TRUE(document::sameNumbers(before, document_.study())) << "a run stays as true as it was";
  density->setValue(0.0);
  EXPECT_FALSE(piece().arealDensity.has_value());
  EXPECT_EQ(density->text(), density->specialValueText()) << "not given is no number";
}

TEST_F(Properties, EveryEditorOfAPiecePushesOneCommand) {
  select(ItemKind::piece, "plate_front");
  expectChoiceEdit("carriage", "skinned");
  auto* parts = editor<QPlainTextEdit>("non_protecting");
  expectOneEdit(
      [&] {
        parts->setFocus();
        QTest::keyClicks(parts, "strap*");
        QTest::keyClick(parts, Qt::Key_Return);
        QTest::keyClick(parts, Qt::Key_Return);
        QTest::keyClicks(parts, "  pouch ");
        QFocusEvent out(QEvent::FocusOut);
        QApplication::sendEvent(parts, &out);
      },
      [parts] { return parts->toPlainText(); });
  EXPECT_EQ(document_.study().systems[0].pieces[8].nonProtecting, (std::vector<std::string>{"strap*", "pouch"}));
  expectCheckEdit("visible");
}

TEST_F(Properties, EveryEditorOfASourcePushesOneCommand) {
  select(ItemKind::source, "front");
  expectNumberEdit("position_x", 1.25);
  expectNumberEdit("shots", 123456.0);
  EXPECT_EQ(document_.study().sources[0].shots, 123456U);
  expectNumberEdit("position_y", 1.5);
  EXPECT_EQ(document_.study().sources[0].position, geometry::Vec3d(1.25, 1.5, 5.0));
  EXPECT_FALSE(editor<QWidget>("target_point")->isVisibleTo(panel_.form()));
  expectChoiceEdit("target", "point");
  EXPECT_TRUE(editor<QWidget>("target_point")->isVisibleTo(panel_.form()));
  EXPECT_FALSE(editor<QLabel>("sampler_warning")->isVisibleTo(panel_.form()));
  expectChoiceEdit("sampler", QString::number(static_cast<int>(study::Sampler::thesis)));
  EXPECT_TRUE(editor<QLabel>("sampler_warning")->isVisibleTo(panel_.form()));
}

TEST_F(Properties, DigitsThatAreNotShownStay) {
  commands::setSourcePosition(document_, "front", {0.123456789, 1.0, 5.0});
  select(ItemKind::source, "front");
  editor<QDoubleSpinBox>("position_y")->setValue(2.0);
  EXPECT_EQ(document_.study().sources[0].position, geometry::Vec3d(0.123456789, 2.0, 5.0));
}

TEST_F(Properties, RenamesWithOneCommandAndSaysWhyNot) {
  select(ItemKind::organ, "heart");
  auto* name = editor<QLineEdit>("name");
  name->selectAll();
  QTest::keyClicks(name, "liver");
  QTest::keyClick(name, Qt::Key_Return);
  EXPECT_EQ(document_.study().organs[0].name, "heart");
  EXPECT_TRUE(editor<QLabel>("name_trouble")->isVisibleTo(panel_.form()));
  EXPECT_EQ(document_.undoStack().count(), 0);
  name->selectAll();
  QTest::keyClicks(name, "pump");
  QTest::keyClick(name, Qt::Key_Return);
  EXPECT_EQ(document_.study().organs[0].name, "pump");
  EXPECT_EQ(document_.undoStack().count(), 1);
  EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::organ, "pump"}));
  EXPECT_EQ(editor<QLineEdit>("name")->text(), "pump");
}

TEST_F(Properties, RemovingWhatIsShownWhileItIsEditedIsSafe) {
  select(ItemKind::organ, "heart");
  auto* name = editor<QLineEdit>("name");
  name->setFocus();
  QTest::keyClicks(name, "half typed");
  commands::removeItem(document_, {ItemKind::organ, "heart"});
  EXPECT_EQ(panel_.form(), nullptr);
  QTest::qWait(10);
  EXPECT_EQ(document_.undoStack().count(), 1);
  document_.undoStack().undo();
  EXPECT_EQ(document_.study().organs[0].name, "heart");
}

TEST_F(Properties, APoseIsShownOnRequest) {
  select(ItemKind::pose, "toe_touch@2");
  EXPECT_EQ(editor<ElidedLabel>("clip")->text(), "toe_touch");
  editor<QPushButton>("show")->click();
  EXPECT_EQ(document_.shownPose(), "toe_touch@2");
}

TEST_F(Properties, AreasOfRegionsSumUpToThatOfTheSkin) {
  const auto number = [](const QString& text) {
    QString digits = text;
    digits.remove(',');
    return digits.section(' ', 0, 0).toDouble();
  };
  select(ItemKind::body);
  const double whole = number(editor<ElidedLabel>("area")->text());
  EXPECT_GT(whole, 10000.0) << "a person's skin is above a square metre";
  double sum = 0.0;
  for (const std::string& region : document_.loaded()->body->body().regions.names) {
    select(ItemKind::region, region);
    sum += number(editor<ElidedLabel>("area")->text());
  }
  EXPECT_NEAR(sum, whole, 0.01 * whole);
}

TEST_F(Properties, OfTheBuiltInHumanNameThePersonAndOfferAnother) {
  select(ItemKind::body);
  EXPECT_EQ(editor<ElidedLabel>("person")->text(), "man, 175.5 cm, 84.6 kg");
  QSignalSpy requested(&panel_, &PropertiesPanel::personRequested);
  editor<QPushButton>("change_person")->click();
  EXPECT_EQ(requested.count(), 1);
  commands::setPerson(document_, {human::Sex::female, 1.628, 65.8});
  EXPECT_EQ(editor<ElidedLabel>("person")->text(), "woman, 162.8 cm, 65.8 kg");
}

TEST_F(Properties, TheFormScrollsAndNeverWidensThePanel) {
  study::Study study = document_.study();
  study.organs[0].description = std::string(400, 'x') + " a long word";
  commands::replaceStudy(document_, study, "long");
  select(ItemKind::organ, "heart");
  panel_.resize(280, 200);
  QTest::qWait(20);
  EXPECT_LE(panel_.widget()->minimumSizeHint().width(), 280);
}

}  // namespace
}  // namespace lorica::panels
