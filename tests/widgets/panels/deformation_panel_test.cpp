#include "lorica/panels/deformation_panel.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <QTest>

#include "lorica/commands/edits.h"
#include "lorica/panels/bar_figure.h"
#include "sample_document.h"
#include "two_poses.h"

namespace lorica::panels {
namespace {

using document::ItemKind;
using document::ItemRef;
using viscera::OrganModel;

constexpr int patience = 60000;

class DeformationPanelTest : public testing::Test {
 protected:
  DeformationPanelTest() { panel_.resize(900, 400); }

  static DeformationPanel::Report reportOfTwoPoses() {
    return std::make_shared<const jobs::DeformationReport>(
        jobs::DeformationReport{testsupport::loadedSample(), testsupport::twoPoses()});
  }
  QString emptyText() const {
    for (const QLabel* label : panel_.findChildren<QLabel*>()) {
      if (label->isVisibleTo(&panel_) && !label->text().isEmpty()) {
        return label->text();
      }
    }
    return {};
  }
  QPushButton* button(const char* name) { return panel_.findChild<QPushButton*>(name); }

  document::StudyDocument document_;
  DeformationPanel panel_{document_};
};

TEST_F(DeformationPanelTest, SaysWhyThereIsNothingToSee) {
  EXPECT_TRUE(emptyText().contains("No study")) << emptyText().toStdString();
  EXPECT_FALSE(button("measure_pose")->isEnabled());
  testsupport::openSample(document_);
  EXPECT_TRUE(emptyText().contains("being read")) << emptyText().toStdString();
  document_.setLoaded(testsupport::loadedSample());
  EXPECT_TRUE(button("measure_pose")->isEnabled());
  study::Study bare = document_.study();
  bare.organs.clear();
  document_.setStudy(bare, "bare.lorica.json");
  auto loaded = std::make_shared<analysis::LoadedStudy>(*testsupport::loadedSample());
  loaded->organs.clear();
  document_.setLoaded(loaded);
  EXPECT_TRUE(emptyText().contains("no organ")) << emptyText().toStdString();
}

TEST_F(DeformationPanelTest, MeasuresThePoseThatIsSeenAgainstTheStaticModel) {
  testsupport::openLoadedSample(document_);
  document_.showPose("toe_touch@2");
  panel_.show();
  ASSERT_TRUE(QTest::qWaitFor([this] { return panel_.report() != nullptr; }, patience));
  const analysis::DeformationTables& tables = panel_.report()->tables;
  EXPECT_EQ(tables.poses, std::vector<std::string>{"toe_touch@2"});
  EXPECT_EQ(tables.models, (std::vector{OrganModel::staticJoint, OrganModel::dynamic}));
  EXPECT_EQ(panel_.organs().rowCount(), static_cast<int>(2 * document_.study().organs.size()));
  EXPECT_TRUE(panel_.caption().contains("toe_touch@2"));

  // The same numbers as a run has.
  const auto& study = *testsupport::loadedSample();
  const analysis::StudyAudit audit(study, {});
  const analysis::PosedScene scene(study, tables.models, analysis::resolvePose(study, "toe_touch@2").pose,
                                   raycast::SceneUse::manyRays, {});
  for (std::size_t model = 0; model < 2; ++model) {
    EXPECT_EQ(tables.rows[model].audit, audit.measure(scene, model, {}).audit);
  }

  document_.showModels({OrganModel::staticSkin, OrganModel::dynamic});
  ASSERT_TRUE(
      QTest::qWaitFor([this] { return panel_.report()->tables.models.front() == OrganModel::staticSkin; }, patience));
}

TEST_F(DeformationPanelTest, NothingIsMeasuredWhileItIsNotSeen) {
  testsupport::openLoadedSample(document_);
  document_.showPose("toe_touch@2");
  QTest::qWait(700);
  EXPECT_EQ(panel_.report(), nullptr);
  EXPECT_EQ(panel_.controller().job(), nullptr);
}

TEST_F(DeformationPanelTest, StopsAndThenWaitsToBeAsked) {
  testsupport::openLoadedSample(document_);
  panel_.show();
  panel_.measureAllPoses();
  ASSERT_NE(panel_.controller().job(), nullptr);
  EXPECT_TRUE(button("stop")->isVisible());
  button("stop")->click();
  ASSERT_TRUE(QTest::qWaitFor([this] { return panel_.controller().job() == nullptr; }, patience));
  EXPECT_EQ(panel_.report(), nullptr);
  EXPECT_FALSE(button("stop")->isVisible());
  document_.showPose("toe_touch@1");
  QTest::qWait(700);
  EXPECT_EQ(panel_.controller().job(), nullptr);
  button("measure_pose")->click();
  ASSERT_TRUE(QTest::qWaitFor([this] { return panel_.report() != nullptr; }, patience));
}

TEST_F(DeformationPanelTest, OfSeveralPosesTheWorstOfEachOrganIsShown) {
  testsupport::openLoadedSample(document_);
  panel_.showReport(reportOfTwoPoses());
  EXPECT_EQ(panel_.organFilter().rowCount(), 4);
  EXPECT_FALSE(panel_.organView().isColumnHidden(panel_.organs().poseColumn()));
  panel_.findChild<QCheckBox*>()->setChecked(false);
  EXPECT_EQ(panel_.organFilter().rowCount(), 8);
}

TEST_F(DeformationPanelTest, BarsAreTheWorstOfEachOrganAndModelInItsUnit) {
  testsupport::openLoadedSample(document_);
  panel_.showReport(reportOfTwoPoses());
  const FigureData& data = panel_.figure().data();
  ASSERT_EQ(data.series.size(), 2U);
  EXPECT_EQ(data.categories, (std::vector<std::string>{"liver", "veins, small"}));
  EXPECT_NEAR(data.series[0].bars[0].value, 12.0, 1e-9) << "protrusion, mm";
  EXPECT_NEAR(data.series[1].bars[0].value, 4.0, 1e-9);
  auto* measure = panel_.findChild<QComboBox*>("measure");
  measure->setCurrentIndex(measure->findData(static_cast<int>(models::Measure::volume)));
  EXPECT_NEAR(panel_.figure().data().series[1].bars[0].value, -3.0, 1e-9);
  EXPECT_TRUE(panel_.figure().data().series[1].bars[1].isBlank()) << "open patches have no volume";
}

TEST_F(DeformationPanelTest, ARowSelectsItsOrganAndAnOrganItsRows) {
  testsupport::openLoadedSample(document_);
  panel_.showReport(reportOfTwoPoses());
  panel_.organView().selectRow(0);
  EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::organ, "liver"}));
  EXPECT_EQ(panel_.organView().selectionModel()->selectedRows().size(), 1);
  document_.select(std::nullopt);
  EXPECT_TRUE(panel_.organView().selectionModel()->selectedRows().isEmpty());
  document_.select(ItemRef{ItemKind::organ, "liver"});
  EXPECT_EQ(panel_.organView().selectionModel()->selectedRows().size(), 2) << "of both models";
}

TEST_F(DeformationPanelTest, CopiesTheRowsThatAreShownAsTheyStandInTheFile) {
  testsupport::openLoadedSample(document_);
  panel_.showReport(reportOfTwoPoses());
  button("copy")->click();
  const std::string copied = QApplication::clipboard()->text().toStdString();
  EXPECT_EQ(copied, panel_.organs().csv(panel_.organFilter().shownRows()).toStdString());
  const std::string file = analysis::deformationCsv(testsupport::twoPoses());
  for (const QByteArray& line : QByteArray::fromStdString(copied).split('\n')) {
    EXPECT_NE(file.find(line.toStdString() + (line.isEmpty() ? "" : "\n")), std::string::npos) << line.toStdString();
  }
}

TEST_F(DeformationPanelTest, SaysWhenTheNumbersAreOfAnotherStudyOrPose) {
  testsupport::openLoadedSample(document_);
  panel_.showReport(reportOfTwoPoses());
  EXPECT_FALSE(panel_.caption().contains("changed"));
  document_.setLoaded(std::make_shared<const analysis::LoadedStudy>(*testsupport::loadedSample()));
  EXPECT_TRUE(panel_.caption().contains("changed")) << panel_.caption().toStdString();
  document_.close();
  EXPECT_EQ(panel_.report(), nullptr);
}

}  // namespace
}  // namespace lorica::panels
