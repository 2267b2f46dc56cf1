#include "lorica/panels/project_panel.h"

#include <gtest/gtest.h>

#include <QLineEdit>
#include <QMenu>
#include <QSlider>
#include <QTest>
#include <QTreeView>
#include <QUndoStack>

#include "lorica/commands/edits.h"
#include "lorica/document/appearance.h"
#include "sample_document.h"

namespace lorica::panels {
namespace {

using document::ItemKind;
using document::ItemRef;
using models::Section;

class ProjectPanelTest : public testing::Test {
 protected:
  ProjectPanelTest() { testsupport::openLoadedSample(document_); }

  void choose(const ItemRef& item) { panel_.tree().setCurrentIndex(panel_.model().indexOf(item)); }
  std::optional<ItemRef> current() const { return panel_.model().itemAt(panel_.tree().currentIndex()); }
  bool isVisible(const std::string& name) const { return document::appearanceOf(document_.study(), name).visible; }
  /// Null when the menu has no such entry.
  QAction* entry(const QString& text) {
    menu_.clear();
    panel_.fillMenu(menu_);
    for (QAction* action : menu_.actions()) {
      if (action->text() == text) {
        return action;
      }
    }
    return nullptr;
  }

  document::StudyDocument document_;
  ProjectPanel panel_{document_};
  QMenu menu_;
  ItemRef heart_{ItemKind::organ, "heart"};
  ItemRef liver_{ItemKind::organ, "liver"};
};

TEST_F(ProjectPanelTest, SelectionGoesBothWays) {
  choose(heart_);
  EXPECT_EQ(document_.selection(), heart_);
  document_.select(liver_);
  EXPECT_EQ(current(), liver_);
  document_.select(std::nullopt);
  EXPECT_FALSE(current().has_value());
  panel_.tree().setCurrentIndex(panel_.model().indexOf(Section::organs));
  EXPECT_FALSE(document_.selection().has_value());
  EXPECT_TRUE(panel_.tree().currentIndex().isValid());
}

TEST_F(ProjectPanelTest, KeepsSelectionAndExpansionOverStructuralEdits) {
  document_.select(liver_);
  panel_.tree().collapse(panel_.model().indexOf(Section::poses));
  panel_.tree().expand(panel_.model().indexOf(Section::body));
  commands::removeItem(document_, heart_);
  EXPECT_EQ(document_.selection(), liver_);
  EXPECT_EQ(current(), liver_);
  EXPECT_FALSE(panel_.tree().isExpanded(panel_.model().indexOf(Section::poses)));
  EXPECT_TRUE(panel_.tree().isExpanded(panel_.model().indexOf(Section::body)));
  EXPECT_TRUE(panel_.tree().isExpanded(panel_.model().indexOf(Section::organs)));
}

TEST_F(ProjectPanelTest, ShowOnlyThisIsOneStep) {
  choose(heart_);
  ASSERT_NE(entry("Show only this"), nullptr);
  entry("Show only this")->trigger();
  for (const std::string& name : document::drawnStructures(document_.study())) {
    EXPECT_EQ(isVisible(name), name == "heart") << name;
  }
  EXPECT_EQ(document_.undoStack().count(), 1);
  document_.undoStack().undo();
  EXPECT_TRUE(isVisible("liver"));
}

TEST_F(ProjectPanelTest, ResetLookGivesTheDefaultsBack) {
  commands::setColour(document_, "heart", std::array<std::uint8_t, 3>{1, 2, 3});
  commands::setOpacity(document_, "heart", 0.5);
  commands::setVisible(document_, "heart", false);
  choose(heart_);
  entry("Reset look")->trigger();
  const document::Appearance now = document::appearanceOf(document_.study(), "heart");
  const document::Appearance usual = document::defaultAppearance(document_.study(), "heart");
  EXPECT_EQ(now.colour, usual.colour);
  EXPECT_EQ(now.opacity, usual.opacity);
  EXPECT_EQ(now.visible, usual.visible);
}

TEST_F(ProjectPanelTest, MenuOffersWhatFitsTheRow) {
  choose({ItemKind::pose, "toe_touch@2"});
  ASSERT_NE(entry("Show this pose"), nullptr);
  EXPECT_EQ(entry("Hide"), nullptr);
  entry("Show this pose")->trigger();
  EXPECT_EQ(document_.shownPose(), "toe_touch@2");
  choose({ItemKind::pose, "rest"});
  EXPECT_EQ(entry("Remove"), nullptr);
  panel_.tree().setCurrentIndex(panel_.model().indexOf(Section::sources));
  ASSERT_NE(entry("Add source"), nullptr);
  const std::size_t before = document_.study().sources.size();
  entry("Add source")->trigger();
  EXPECT_EQ(document_.study().sources.size(), before + 1);
}

TEST_F(ProjectPanelTest, HideAndShowGoThroughTheMenu) {
  choose({ItemKind::system, "full_torso"});
  commands::setAllVisible(document_, {"plate_front", "plate_back"}, true, "Show");
  entry("Hide")->trigger();
  EXPECT_FALSE(isVisible("plate_front"));
  EXPECT_FALSE(isVisible("plate_back"));
  entry("Show")->trigger();
  EXPECT_TRUE(isVisible("plate_back"));
}

TEST_F(ProjectPanelTest, DeleteKeyRemovesTheCurrentItem) {
  panel_.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel_));
  panel_.tree().setFocus();
  choose(heart_);
  QTest::keyClick(&panel_.tree(), Qt::Key_Delete);
  EXPECT_FALSE(document::exists(document_, heart_));
  document_.undoStack().undo();
  choose({ItemKind::pose, "rest"});
  QTest::keyClick(&panel_.tree(), Qt::Key_Delete);
  EXPECT_TRUE(panel_.model().indexOf(ItemRef{ItemKind::pose, "rest"}).isValid());
}

TEST_F(ProjectPanelTest, RenamingInTheTreeKeepsTheItemSelected) {
  panel_.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel_));
  choose(heart_);
  entry("Rename")->trigger();
  auto* editor = panel_.tree().viewport()->findChild<QLineEdit*>();
  ASSERT_NE(editor, nullptr);
  editor->setText("pump");
  QTest::keyClick(editor, Qt::Key_Return);
  EXPECT_TRUE(QTest::qWaitFor([this] { return document_.study().organs[0].name == "pump"; }, 2000));
  EXPECT_EQ(current(), (ItemRef{ItemKind::organ, "pump"}));
}

TEST_F(ProjectPanelTest, OpacitySliderEditsTheSelectedStructureInOneStep) {
  auto* slider = panel_.findChild<QSlider*>("opacity");
  choose({ItemKind::pose, "rest"});
  EXPECT_FALSE(slider->isEnabled());
  choose(heart_);
  EXPECT_TRUE(slider->isEnabled());
  EXPECT_EQ(slider->value(), 100);
  for (const int percent : {80, 60, 40}) {
    slider->setValue(percent);
  }
  EXPECT_DOUBLE_EQ(document::appearanceOf(document_.study(), "heart").opacity, 0.4);
  EXPECT_EQ(document_.undoStack().count(), 1);
  document_.undoStack().undo();
  EXPECT_EQ(slider->value(), 100);
}

TEST_F(ProjectPanelTest, SaysSoWhenNoStudyIsOpen) {
  EXPECT_TRUE(panel_.tree().isVisibleTo(&panel_));
  document_.close();
  EXPECT_FALSE(panel_.tree().isVisibleTo(&panel_));
}

}  // namespace
}  // namespace lorica::panels
