#include "lorica/dialogs/shot_line_dialog.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <QUndoStack>

#include "lorica/commands/shot_edits.h"
#include "lorica/jobs/run_planner.h"
#include "lorica/jobs/study_loader.h"
#include "sample_document.h"

namespace lorica::dialogs {
namespace {

class ShotLine : public testing::Test {
 protected:
  ShotLine() : runs_(document_), dialog_(document_, runs_) { testsupport::openLoadedSample(document_); }

  template <class Widget>
  Widget* part(const char* name) const {
    auto* found = dialog_.findChild<Widget*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  QString estimate() const { return part<QLabel>("estimate")->text(); }
  QString outcome() const { return part<QLabel>("outcome")->text(); }
  /// Makes the run short, and the loaded study agree with it.
  void loadWithShots(std::uint64_t shots) {
    commands::setSourceShots(document_, "front", shots);
    reload();
  }
  void reload() {
    auto loaded = std::make_shared<analysis::LoadedStudy>(*document_.loaded());
    loaded->study = document_.study();
    document_.setLoaded(loaded);
  }
  void check(int pose, bool on) const {
    part<QListWidget>("poses")->item(pose)->setCheckState(on ? Qt::Checked : Qt::Unchecked);
  }
  std::size_t checked() const {
    std::size_t count = 0;
    for (int i = 0; i < part<QListWidget>("poses")->count(); ++i) {
      count += part<QListWidget>("poses")->item(i)->checkState() == Qt::Checked ? 1U : 0U;
    }
    return count;
  }

  document::StudyDocument document_;
  jobs::RunController runs_;
  ShotLineDialog dialog_;
};

TEST(ShotLineDialog, CannotRunWithoutAStudy) {
  document::StudyDocument document;
  jobs::RunController runs(document);
  ShotLineDialog dialog(document, runs);
  dialog.show();
  EXPECT_FALSE(dialog.isModal());
  EXPECT_FALSE(dialog.findChild<QPushButton*>("run")->isEnabled());
  EXPECT_FALSE(dialog.findChild<QLabel*>("outcome")->text().isEmpty()) << "it says why";
  EXPECT_EQ(dialog.findChild<QListWidget*>("poses")->count(), 0);
}

TEST_F(ShotLine, EditsReachTheStudyAndFollowUndo) {
  part<QDoubleSpinBox>("position_z")->setValue(7.5);
  EXPECT_EQ(document_.study().sources[0].position.z(), 7.5);
  part<QDoubleSpinBox>("shots")->setValue(1234.0);
  EXPECT_EQ(document_.study().sources[0].shots, 1234U);
  part<QDoubleSpinBox>("trials")->setValue(9.0);
  EXPECT_EQ(document_.study().trials, 9U);
  part<QCheckBox>("model_dynamic_thesis")->setChecked(true);
  EXPECT_EQ(document_.study().models.size(), 3U);
  EXPECT_EQ(document_.undoStack().count(), 4);
  while (document_.undoStack().canUndo()) {
    document_.undoStack().undo();
  }
  EXPECT_EQ(part<QDoubleSpinBox>("position_z")->value(), 5.0);
  EXPECT_EQ(part<QDoubleSpinBox>("shots")->value(), 20000.0);
  EXPECT_EQ(part<QDoubleSpinBox>("trials")->value(), 5.0);
  EXPECT_FALSE(part<QCheckBox>("model_dynamic_thesis")->isChecked());
}

TEST_F(ShotLine, PosesAreChosenForTheRun) {
  EXPECT_EQ(part<QListWidget>("poses")->count(), 6);
  EXPECT_EQ(checked(), 6U);
  check(1, false);
  EXPECT_EQ(document_.study().runPoses,
            (std::vector<std::string>{"rest", "belly_twist@1", "belly_twist@3", "lateral_twist@1", "lateral_twist@3"}));
  check(1, true);
  EXPECT_TRUE(document_.study().runPoses.empty()) << "all of them, also those that come later";
  part<QToolButton>("no_poses")->click();
  EXPECT_EQ(checked(), 0U);
  EXPECT_FALSE(part<QPushButton>("run")->isEnabled());
  EXPECT_TRUE(document_.study().runPoses.empty()) << "a study without poses to run cannot be said";
  check(2, true);
  EXPECT_EQ(document_.study().runPoses, std::vector<std::string>{"belly_twist@1"});
  EXPECT_EQ(checked(), 1U);
  document_.undoStack().undo();
  EXPECT_EQ(checked(), 6U) << "as the study says";
}

TEST_F(ShotLine, AMomentThatOnlyTheRunListsStaysInTheList) {
  commands::setRunPoses(document_, {"rest", "toe_touch@1.5"});
  EXPECT_EQ(part<QListWidget>("poses")->count(), 7);
  EXPECT_EQ(checked(), 2U);
  check(6, false);
  EXPECT_EQ(document_.study().runPoses, std::vector<std::string>{"rest"});
  EXPECT_EQ(part<QListWidget>("poses")->count(), 7);
  part<QToolButton>("all_poses")->click();
  EXPECT_EQ(document_.study().runPoses.size(), 7U);
}

TEST_F(ShotLine, SourcesAreAddedAndRemoved) {
  part<QToolButton>("add_source")->click();
  ASSERT_EQ(document_.study().sources.size(), 2U);
  EXPECT_EQ(dialog_.source(), document_.study().sources[1].name);
  part<QDoubleSpinBox>("position_x")->setValue(3.0);
  EXPECT_EQ(document_.study().sources[1].position.x(), 3.0);
  EXPECT_EQ(document_.study().sources[0].position.x(), 0.0);
  part<QToolButton>("remove_source")->click();
  part<QToolButton>("remove_source")->click();
  EXPECT_TRUE(document_.study().sources.empty());
  EXPECT_FALSE(part<QPushButton>("run")->isEnabled());
  EXPECT_FALSE(part<QDoubleSpinBox>("position_x")->isEnabled());
  document_.undoStack().undo();
  EXPECT_EQ(dialog_.source(), "front");
}

TEST_F(ShotLine, ASourceIsDuplicatedBesideItself) {
  commands::addSource(document_);
  auto* list = part<QComboBox>("source");
  list->setCurrentIndex(0);
  Q_EMIT list->activated(0);
  part<QDoubleSpinBox>("shots")->setValue(777.0);
  part<QToolButton>("duplicate_source")->click();
  ASSERT_EQ(document_.study().sources.size(), 3U);
  EXPECT_EQ(document_.study().sources[1].name, "front 2");
  EXPECT_EQ(document_.study().sources[1].shots, 777U);
  EXPECT_EQ(dialog_.source(), "front 2");
  document_.undoStack().undo();
  EXPECT_EQ(document_.study().sources.size(), 2U);
}

TEST_F(ShotLine, WhatIsWrongWithTheSourceIsSaidAndKeepsTheRunFromStarting) {
  auto* sampler = part<QComboBox>("sampler");
  sampler->setCurrentIndex(sampler->findData(QString::number(static_cast<int>(study::Sampler::disk))));
  reload();
  ASSERT_TRUE(part<QPushButton>("run")->isEnabled()) << outcome().toStdString();
  part<QDoubleSpinBox>("radius")->setValue(0.0);
  EXPECT_FALSE(part<QPushButton>("run")->isEnabled());
  EXPECT_TRUE(part<QLabel>("radius_trouble")->isVisibleTo(&dialog_));
  EXPECT_FALSE(outcome().isEmpty());
  part<QDoubleSpinBox>("radius")->setValue(0.25);
  EXPECT_TRUE(part<QPushButton>("run")->isEnabled()) << outcome().toStdString();
}

TEST_F(ShotLine, ASourceInsideTheBodyIsSaidBesideItsPlaceAndCannotBeRun) {
  jobs::RunPlanner planner(document_);
  commands::setSourcePosition(document_, "front", {0.0, 1.1, 0.0});
  reload();
  ASSERT_TRUE(QTest::qWaitFor([this] { return document_.plan() != nullptr; }, 30000));
  ASSERT_TRUE(document_.plan()->trouble);
  EXPECT_TRUE(part<QLabel>("position_trouble")->isVisibleTo(&dialog_));
  EXPECT_TRUE(part<QLabel>("position_trouble")->text().contains("inside the body"));
  EXPECT_FALSE(part<QPushButton>("run")->isEnabled());
  commands::setSourcePosition(document_, "front", {0.0, 1.1, 4.0});
  EXPECT_FALSE(part<QLabel>("position_trouble")->isVisibleTo(&dialog_)) << "of another place nothing is known yet";
  reload();
  ASSERT_TRUE(QTest::qWaitFor([this] { return !document_.plan()->trouble; }, 30000));
  EXPECT_TRUE(part<QPushButton>("run")->isEnabled()) << outcome().toStdString();
  EXPECT_TRUE(part<QLabel>("measure")->text().contains("sr")) << part<QLabel>("measure")->text().toStdString();
}

TEST_F(ShotLine, CountsTheCellsOfAGridOnceTheRunIsPlanned) {
  study::Source source = document_.study().sources.front();
  source.type = study::SourceType::parallel;
  source.sequence = study::Sequence::grid;
  source.cell = 0.05;
  commands::setSource(document_, "front", source, "type", "Grid", commands::Merge::no);
  commands::setRunPoses(document_, {"rest"});
  jobs::RunPlanner planner(document_);
  reload();
  ASSERT_TRUE(QTest::qWaitFor([this] { return document_.plan() != nullptr; }, 30000));
  const std::uint64_t cells = document_.plan()->result.sources[0].shots;
  EXPECT_TRUE(estimate().remove(',').contains(QString::number(5 * cells))) << estimate().toStdString();
}

TEST_F(ShotLine, APickedPointMovesTheSourceOnce) {
  QSignalSpy picking(&dialog_, &ShotLineDialog::pickRequested);
  part<QPushButton>("pick")->click();
  ASSERT_EQ(picking.count(), 1);
  EXPECT_TRUE(picking[0][0].toBool());
  dialog_.setPickedPoint({1.0, 2.0, 3.0});
  EXPECT_EQ(document_.study().sources[0].position, geometry::Vec3d(1.0, 2.0, 3.0));
  ASSERT_EQ(picking.count(), 2);
  EXPECT_FALSE(picking[1][0].toBool());
  part<QPushButton>("pick")->click();
  dialog_.show();
  dialog_.hide();
  EXPECT_FALSE(part<QPushButton>("pick")->isChecked()) << "nobody picks for a dialog that is gone";
}

TEST_F(ShotLine, SaysWhichShotsAreShown) {
  ShotDisplay last;
  int told = 0;
  QObject::connect(&dialog_, &ShotLineDialog::shotDisplayChanged, &dialog_, [&](const ShotDisplay& display) {
    last = display;
    ++told;
  });
  part<QCheckBox>("show_shots")->setChecked(true);
  EXPECT_EQ(last, (ShotDisplay{true, 0, 300, "hits"})) << "misses say little";
  part<QSpinBox>("limit")->setValue(1000);
  auto* first = part<QComboBox>("first_hit");
  first->setCurrentIndex(first->findData("heart"));
  EXPECT_EQ(last, (ShotDisplay{true, 0, 1000, "heart"}));
  EXPECT_EQ(told, 3);
  part<QToolButton>("add_source")->click();
  EXPECT_EQ(last.source, 1U);
  commands::renameItem(document_, {document::ItemKind::organ, "heart"}, "pump");
  EXPECT_EQ(last.onlyFirstHit, "hits") << "nothing has that name any more";
  first->setCurrentIndex(first->findText("anything or nothing"));
  EXPECT_EQ(last.onlyFirstHit, "");
  part<QDoubleSpinBox>("position_x")->setValue(1.0);
  EXPECT_EQ(last.onlyFirstHit, "") << "an edit does not change the choice";
  part<QCheckBox>("show_shots")->setChecked(false);
  EXPECT_FALSE(last.on);
}

TEST_F(ShotLine, CountsTheShotsAndEstimatesTheTime) {
  commands::setRunPoses(document_, {"rest", "toe_touch@2", "belly_twist@1"});
  commands::setSourceShots(document_, "front", 100000);
  reload();
  EXPECT_TRUE(estimate().contains("3 poses")) << estimate().toStdString();
  EXPECT_TRUE(estimate().contains("1 source ")) << estimate().toStdString();
  EXPECT_TRUE(estimate().contains("5 trials")) << estimate().toStdString();
  EXPECT_TRUE(estimate().contains("1,500,000 shots")) << estimate().toStdString();
  EXPECT_FALSE(estimate().contains("about"));
  dialog_.show();
  EXPECT_TRUE(estimate().contains("estimating")) << estimate().toStdString();
  ASSERT_TRUE(QTest::qWaitFor([this] { return estimate().contains("about"); }, 60000));
  const QString before = estimate();
  commands::setSourceShots(document_, "front", 100000000);
  EXPECT_NE(estimate().section("about", 1), before.section("about", 1)) << "more shots take longer";
}

TEST_F(ShotLine, ARunIsAddedToTheDocument) {
  loadWithShots(500);
  dialog_.show();
  ASSERT_TRUE(part<QPushButton>("run")->isEnabled()) << outcome().toStdString();
  part<QPushButton>("run")->click();
  EXPECT_TRUE(part<QProgressBar>("progress")->isVisible());
  EXPECT_TRUE(part<QPushButton>("cancel")->isVisible());
  EXPECT_FALSE(part<QPushButton>("run")->isVisible());
  ASSERT_TRUE(QTest::qWaitFor([this] { return runs_.job() == nullptr; }, 120000));
  ASSERT_EQ(document_.runs().size(), 1U);
  EXPECT_FALSE(document_.runs()[0]->result.partial);
  EXPECT_EQ(document_.runs()[0]->result.poses.size(), 6U);
  EXPECT_TRUE(outcome().startsWith("Finished in")) << outcome().toStdString();
  EXPECT_TRUE(part<QPushButton>("run")->isVisible());
  EXPECT_TRUE(part<QPushButton>("run")->isEnabled());
}

TEST_F(ShotLine, ACancelledRunLeavesTheDialogUsable) {
  loadWithShots(1000000000);
  dialog_.show();
  part<QPushButton>("run")->click();
  QTest::qWait(1500);
  ASSERT_NE(runs_.job(), nullptr);
  part<QPushButton>("cancel")->click();
  EXPECT_FALSE(part<QPushButton>("cancel")->isEnabled());
  ASSERT_TRUE(QTest::qWaitFor([this] { return runs_.job() == nullptr; }, 30000));
  for (const auto& run : document_.runs()) {
    EXPECT_TRUE(run->result.partial);
  }
  EXPECT_TRUE(outcome().startsWith("Stopped")) << outcome().toStdString();
  loadWithShots(200);
  part<QPushButton>("run")->click();
  ASSERT_TRUE(QTest::qWaitFor([this] { return runs_.job() == nullptr; }, 120000));
  EXPECT_FALSE(document_.runs().back()->result.partial);
}

TEST_F(ShotLine, AnEditWaitsUntilItIsRead) {
  jobs::StudyLoader loader(document_);
  commands::setSourceShots(document_, "front", 300);
  EXPECT_FALSE(part<QPushButton>("run")->isEnabled());
  EXPECT_FALSE(outcome().isEmpty());
  ASSERT_TRUE(QTest::qWaitFor([this] { return part<QPushButton>("run")->isEnabled(); }, 60000));
  EXPECT_TRUE(outcome().isEmpty()) << outcome().toStdString();
}

}  // namespace
}  // namespace lorica::dialogs
