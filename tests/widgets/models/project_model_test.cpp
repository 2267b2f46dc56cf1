#include "lorica/models/project_model.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QIcon>
#include <QSignalSpy>
#include <QUndoStack>

#include "lorica/commands/edits.h"
#include "lorica/document/appearance.h"
#include "sample_document.h"

namespace lorica::models {
namespace {

using document::ItemKind;
using document::ItemRef;

class ProjectModelTest : public testing::Test {
 protected:
  ProjectModelTest() { testsupport::openSample(document_); }

  Qt::CheckState stateAt(const QModelIndex& index) const {
    return static_cast<Qt::CheckState>(index.data(Qt::CheckStateRole).toInt());
  }
  bool isVisible(const std::string& name) const { return document::appearanceOf(document_.study(), name).visible; }
  QString details(const ItemRef& item) const {
    return model_.indexOf(item).siblingAtColumn(ProjectModel::detailsColumn).data().toString();
  }

  document::StudyDocument document_;
  ProjectModel model_{document_};
  QAbstractItemModelTester tester_{&model_, QAbstractItemModelTester::FailureReportingMode::Fatal};
  ItemRef heart_{ItemKind::organ, "heart"};
};

TEST_F(ProjectModelTest, IsEmptyWithoutAStudy) {
  document_.close();
  EXPECT_EQ(model_.rowCount(), 0);
  testsupport::openSample(document_);
  EXPECT_EQ(model_.rowCount(), 6);
}

TEST_F(ProjectModelTest, ShowsEveryThingOfTheStudyUnderItsSection) {
  const study::Study& study = document_.study();
  EXPECT_EQ(model_.rowCount(model_.indexOf(Section::organs)), static_cast<int>(study.organs.size()));
  EXPECT_EQ(model_.rowCount(model_.indexOf(Section::armor)), static_cast<int>(study.systems.size()));
  EXPECT_EQ(model_.rowCount(model_.indexOf(Section::poses)), static_cast<int>(study.poses.size()) + 1);
  EXPECT_EQ(model_.index(0, 0, model_.indexOf(Section::poses)).data().toString(), "rest");
  for (const study::ArmorSystem& system : study.systems) {
    const QModelIndex head = model_.indexOf(ItemRef{ItemKind::system, system.name});
    ASSERT_EQ(model_.rowCount(head), static_cast<int>(system.pieces.size()));
    for (const study::ArmorPiece& piece : system.pieces) {
      EXPECT_EQ(model_.indexOf(ItemRef{ItemKind::piece, piece.name}).parent(), head);
    }
  }
}

TEST_F(ProjectModelTest, FindsEachRowByItsItem) {
  testsupport::addSampleRun(document_);
  document_.setLoaded(testsupport::loadedSample());
  int items = 0;
  const std::function<void(const QModelIndex&)> visit = [&](const QModelIndex& parent) {
    for (int row = 0; row < model_.rowCount(parent); ++row) {
      const QModelIndex index = model_.index(row, 0, parent);
      if (const std::optional<ItemRef> item = model_.itemAt(index)) {
        EXPECT_EQ(model_.indexOf(*item), index) << item->name;
        EXPECT_EQ(index.data(ProjectModel::itemRole).value<ItemRef>(), *item);
        ++items;
      }
      visit(index);
    }
  };
  visit({});
  EXPECT_GT(items, 30);
  EXPECT_FALSE(model_.indexOf(ItemRef{ItemKind::organ, "no such organ"}).isValid());
}

TEST_F(ProjectModelTest, ShowsRegionsOnceTheBodyIsLoaded) {
  const QModelIndex body = model_.indexOf(Section::body);
  EXPECT_EQ(model_.rowCount(body), 0);
  document_.setLoaded(testsupport::loadedSample());
  EXPECT_EQ(model_.rowCount(model_.indexOf(Section::body)),
            static_cast<int>(testsupport::loadedSample()->body->body().regions.names.size()));
}

TEST_F(ProjectModelTest, ShowsRunsAndWhetherTheyArePartial) {
  testsupport::addSampleRun(document_);
  analysis::RunResult partial = testsupport::sampleResult();
  partial.partial = true;
  document_.addRun(testsupport::loadedSample(), partial);
  ASSERT_EQ(model_.rowCount(model_.indexOf(Section::runs)), 2);
  EXPECT_FALSE(details({ItemKind::run, document_.runs()[0]->name}).contains("partial"));
  EXPECT_TRUE(details({ItemKind::run, document_.runs()[1]->name}).contains("partial"));
  // One source, two poses, two trials of 2000.
  EXPECT_TRUE(details({ItemKind::run, document_.runs()[0]->name}).contains("8,000 shots, 2 poses"));
}

TEST_F(ProjectModelTest, CheckBoxPushesOneCommandAndFollowsUndo) {
  QSignalSpy resets(&model_, &QAbstractItemModel::modelReset);
  QSignalSpy changes(&model_, &QAbstractItemModel::dataChanged);
  const QModelIndex index = model_.indexOf(heart_);
  EXPECT_EQ(stateAt(index), Qt::Checked);
  ASSERT_TRUE(model_.setData(index, Qt::Unchecked, Qt::CheckStateRole));
  EXPECT_EQ(document_.undoStack().count(), 1);
  EXPECT_FALSE(isVisible("heart"));
  EXPECT_EQ(stateAt(index), Qt::Unchecked);
  EXPECT_EQ(stateAt(model_.indexOf(Section::organs)), Qt::PartiallyChecked);
  document_.undoStack().undo();
  EXPECT_EQ(stateAt(index), Qt::Checked);
  EXPECT_EQ(stateAt(model_.indexOf(Section::organs)), Qt::Checked);
  document_.undoStack().redo();
  EXPECT_EQ(stateAt(index), Qt::Unchecked);
  EXPECT_EQ(resets.count(), 0);
  EXPECT_GT(changes.count(), 0);
}

TEST_F(ProjectModelTest, CheckBoxOfASectionIsOneStepForAllBelow) {
  const QModelIndex organs = model_.indexOf(Section::organs);
  model_.setData(model_.indexOf(heart_), Qt::Unchecked, Qt::CheckStateRole);
  model_.setData(organs, Qt::Unchecked, Qt::CheckStateRole);
  EXPECT_EQ(document_.undoStack().count(), 2);
  EXPECT_EQ(stateAt(organs), Qt::Unchecked);
  for (const study::Organ& organ : document_.study().organs) {
    EXPECT_FALSE(isVisible(organ.name)) << organ.name;
  }
  EXPECT_TRUE(isVisible("body"));
  document_.undoStack().undo();
  EXPECT_EQ(stateAt(organs), Qt::PartiallyChecked);
  EXPECT_FALSE(isVisible("heart"));
  EXPECT_TRUE(isVisible("liver"));
}

TEST_F(ProjectModelTest, CheckBoxOfASystemIsThatOfItsPieces) {
  const QModelIndex system = model_.indexOf(ItemRef{ItemKind::system, "full_torso"});
  model_.setData(system, Qt::Checked, Qt::CheckStateRole);
  EXPECT_EQ(stateAt(system), Qt::Checked);
  model_.setData(model_.indexOf(ItemRef{ItemKind::piece, "plate_back"}), Qt::Unchecked, Qt::CheckStateRole);
  EXPECT_EQ(stateAt(system), Qt::PartiallyChecked);
  EXPECT_TRUE(isVisible("plate_front"));
  std::vector<std::string> pieces;
  for (const study::ArmorPiece& piece : document_.study().systems.front().pieces) {
    pieces.push_back(piece.name);
  }
  EXPECT_EQ(model_.structuresAt(system), pieces);
}

TEST_F(ProjectModelTest, OnlyWhatIsDrawnHasACheckBox) {
  document_.setLoaded(testsupport::loadedSample());
  for (const ItemRef& item : {ItemRef{ItemKind::pose, "rest"}, ItemRef{ItemKind::source, "front"}}) {
    EXPECT_FALSE(model_.indexOf(item).data(Qt::CheckStateRole).isValid());
    EXPECT_FALSE(model_.setData(model_.indexOf(item), Qt::Unchecked, Qt::CheckStateRole));
  }
  EXPECT_FALSE(model_.indexOf(Section::poses).data(Qt::CheckStateRole).isValid());
  EXPECT_TRUE(model_.indexOf(Section::body).data(Qt::CheckStateRole).isValid());
  EXPECT_FALSE(model_.index(0, 0, model_.indexOf(Section::body)).data(Qt::CheckStateRole).isValid());
}

TEST_F(ProjectModelTest, SwatchAndRolesFollowColourAndOpacity) {
  const QModelIndex index = model_.indexOf(heart_);
  commands::setColour(document_, "heart", std::array<std::uint8_t, 3>{1, 2, 3});
  commands::setOpacity(document_, "heart", 0.25);
  EXPECT_EQ(index.data(ProjectModel::colourRole).value<QColor>(), QColor(1, 2, 3));
  EXPECT_DOUBLE_EQ(index.data(ProjectModel::opacityRole).toDouble(), 0.25);
  const QImage swatch = index.data(Qt::DecorationRole).value<QIcon>().pixmap(16).toImage();
  EXPECT_EQ(swatch.pixelColor(swatch.rect().center()), QColor(1, 2, 3));
  EXPECT_EQ(swatch.pixelColor(0, 0).alpha(), 0) << "it is round";
}

TEST_F(ProjectModelTest, RenamesThroughACommandAndFollowsUndo) {
  ASSERT_TRUE(model_.setData(model_.indexOf(heart_), " pump ", Qt::EditRole));
  EXPECT_EQ(document_.study().organs[0].name, "pump");
  EXPECT_FALSE(model_.indexOf(heart_).isValid());
  EXPECT_TRUE(model_.indexOf(ItemRef{ItemKind::organ, "pump"}).isValid());
  document_.undoStack().undo();
  EXPECT_TRUE(model_.indexOf(heart_).isValid());
}

TEST_F(ProjectModelTest, RefusesANameThatCannotBeTakenAndSaysWhy) {
  QSignalSpy refusals(&model_, &ProjectModel::renameRefused);
  EXPECT_FALSE(model_.setData(model_.indexOf(heart_), "liver", Qt::EditRole));
  EXPECT_FALSE(model_.setData(model_.indexOf(heart_), "  ", Qt::EditRole));
  ASSERT_EQ(refusals.count(), 2);
  EXPECT_FALSE(refusals[0][0].toString().isEmpty());
  EXPECT_EQ(document_.undoStack().count(), 0);
  EXPECT_FALSE(model_.flags(model_.indexOf(ItemRef{ItemKind::pose, "rest"})) & Qt::ItemIsEditable);
  EXPECT_FALSE(model_.flags(model_.indexOf(Section::body)) & Qt::ItemIsEditable);
}

TEST_F(ProjectModelTest, FollowsThingsThatComeAndGo) {
  const std::string source = commands::addSource(document_);
  EXPECT_TRUE(model_.indexOf(ItemRef{ItemKind::source, source}).isValid());
  commands::removeItem(document_, heart_);
  EXPECT_FALSE(model_.indexOf(heart_).isValid());
  document_.undoStack().undo();
  document_.undoStack().undo();
  EXPECT_TRUE(model_.indexOf(heart_).isValid());
  EXPECT_FALSE(model_.indexOf(ItemRef{ItemKind::source, source}).isValid());
}

TEST_F(ProjectModelTest, DetailsFollowEditsWithoutAReset) {
  QSignalSpy resets(&model_, &QAbstractItemModel::modelReset);
  commands::setInjuryClass(document_, "stomach", "desirable");
  commands::setSourceShots(document_, "front", 1234567);
  commands::setCarriage(document_, "plate_front", study::Carriage::skinned);
  EXPECT_EQ(details({ItemKind::organ, "stomach"}), "desirable");
  EXPECT_TRUE(details({ItemKind::source, "front"}).contains("1,234,567"));
  EXPECT_EQ(details({ItemKind::piece, "plate_front"}), "skinned");
  EXPECT_EQ(details({ItemKind::pose, "toe_touch@2"}), "2 s of toe_touch");
  EXPECT_EQ(resets.count(), 0);
}

TEST_F(ProjectModelTest, MarksThePoseThatIsShown) {
  const auto isBold = [&](const std::string& pose) {
    return model_.indexOf(ItemRef{ItemKind::pose, pose}).data(Qt::FontRole).value<QFont>().bold();
  };
  EXPECT_TRUE(isBold("rest"));
  document_.showPose("toe_touch@2");
  EXPECT_FALSE(isBold("rest"));
  EXPECT_TRUE(isBold("toe_touch@2"));
}

}  // namespace
}  // namespace lorica::models
