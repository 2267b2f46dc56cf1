#include "lorica/panels/results_panel.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>
#include <QTest>
#include <set>

#include "lorica/commands/edits.h"
#include "sample_document.h"

namespace lorica::panels {
namespace {

using document::ItemKind;
using document::ItemRef;
using models::ResultsModel;

class ResultsPanelTest : public testing::Test {
 protected:
  ResultsPanelTest() { testsupport::openLoadedSample(document_); }

  std::set<int> selectedRows() const {
    std::set<int> rows;
    for (const QModelIndex& index : panel_.table().selectionModel()->selectedRows()) {
      rows.insert(index.row());
    }
    return rows;
  }
  std::set<int> rowsOf(const std::string& structure) const {
    std::set<int> rows;
    for (int row = 0; row < panel_.filter().rowCount(); ++row) {
      if (panel_.filter().index(row, ResultsModel::structureColumn).data().toString().toStdString() == structure) {
        rows.insert(row);
      }
    }
    return rows;
  }
  void filterBy(const QString& combo, const QString& text) {
    auto* box = panel_.findChild<QComboBox*>(combo);
    box->setCurrentIndex(box->findData(text));
  }
  QPushButton* button(const QString& text) const {
    for (QPushButton* one : panel_.findChildren<QPushButton*>()) {
      if (one->text() == text) {
        return one;
      }
    }
    return nullptr;
  }
  std::string clipboard() const { return QApplication::clipboard()->text().toStdString(); }

  document::StudyDocument document_;
  ResultsPanel panel_{document_};
};

TEST_F(ResultsPanelTest, ShowsTheNewestRunAndLetsChooseAnother) {
  EXPECT_EQ(panel_.run(), nullptr);
  EXPECT_FALSE(panel_.table().isVisibleTo(&panel_));
  QSignalSpy shown(&panel_, &ResultsPanel::runShown);
  testsupport::addSampleRun(document_);
  testsupport::addSampleRun(document_);
  EXPECT_EQ(shown.count(), 2);
  EXPECT_EQ(panel_.run(), document_.runs().back());
  panel_.findChild<QComboBox*>("run")->setCurrentIndex(0);
  EXPECT_EQ(panel_.run(), document_.runs().front());
  EXPECT_EQ(shown.count(), 3);
  document_.close();
  EXPECT_EQ(panel_.run(), nullptr);
  EXPECT_FALSE(panel_.table().isVisibleTo(&panel_));
}

TEST_F(ResultsPanelTest, SaysWhatTheRunWas) {
  testsupport::addSampleRun(document_);
  std::uint64_t hits = 0;
  for (const analysis::ResultRow& row : panel_.run()->summary) {
    if (row.structure == "body" && row.system == "unarmored" && row.model == "dynamic") {
      hits += row.count.any;
    }
  }
  const QString percent = QString::number(100.0 * static_cast<double>(hits) / 8000.0, 'f', 1);
  EXPECT_TRUE(panel_.summary().contains("2,000 shots")) << panel_.summary().toStdString();
  EXPECT_TRUE(panel_.summary().contains("2 trials"));
  EXPECT_TRUE(panel_.summary().contains("2 poses"));
  EXPECT_TRUE(panel_.summary().contains(percent + QChar(0xA0) + "% hit the body")) << panel_.summary().toStdString();
}

TEST_F(ResultsPanelTest, WarnsOfPartialRunsAndChangedStudies) {
  testsupport::addSampleRun(document_);
  EXPECT_EQ(panel_.caution(), "");
  commands::setVisible(document_, "heart", false);
  commands::setStudyDescription(document_, "Another text.");
  EXPECT_EQ(panel_.caution(), "") << "neither changes a number";
  commands::setTrials(document_, 9);
  EXPECT_TRUE(panel_.caution().contains("changed"));
  document_.undoStack().undo();
  EXPECT_EQ(panel_.caution(), "");
  analysis::RunResult partial = testsupport::sampleResult();
  partial.partial = true;
  document_.addRun(testsupport::loadedSample(), partial);
  EXPECT_TRUE(panel_.caution().contains("Partial"));
}

TEST_F(ResultsPanelTest, SelectingARowSelectsItsOrganAndKeepsTheRow) {
  testsupport::addSampleRun(document_);
  const int row = *rowsOf("liver").begin();
  panel_.table().selectRow(row);
  EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::organ, "liver"}));
  EXPECT_EQ(selectedRows(), std::set<int>{row});
}

TEST_F(ResultsPanelTest, SelectingAnOrganSelectsAllItsRows) {
  testsupport::addSampleRun(document_);
  document_.select(ItemRef{ItemKind::organ, "heart"});
  EXPECT_EQ(selectedRows(), rowsOf("heart"));
  EXPECT_EQ(rowsOf("heart").size(), 12U);  // three systems, two models, two poses
  document_.select(ItemRef{ItemKind::piece, "plate_back"});
  EXPECT_EQ(selectedRows(), rowsOf("plate_back"));
  document_.select(std::nullopt);
  EXPECT_TRUE(selectedRows().empty());
  EXPECT_FALSE(document_.selection().has_value());
}

TEST_F(ResultsPanelTest, FiltersKeepTheSelectionOfTheDocument) {
  testsupport::addSampleRun(document_);
  document_.select(ItemRef{ItemKind::organ, "heart"});
  filterBy("system", "full_torso");
  EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::organ, "heart"}));
  EXPECT_EQ(selectedRows(), rowsOf("heart"));
  EXPECT_EQ(selectedRows().size(), 4U);
}

TEST_F(ResultsPanelTest, CopiesWhatIsShownInItsOrder) {
  testsupport::addSampleRun(document_);
  button("Copy as CSV")->click();
  EXPECT_EQ(clipboard(), analysis::summaryCsv(panel_.run()->summary));
  filterBy("kind", "organ");
  panel_.table().sortByColumn(ResultsModel::anyColumn, Qt::DescendingOrder);
  std::vector<analysis::ResultRow> expected = panel_.run()->summary;
  std::erase_if(expected, [](const analysis::ResultRow& row) { return row.kind != "organ"; });
  std::stable_sort(expected.begin(), expected.end(), [](const analysis::ResultRow& a, const analysis::ResultRow& b) {
    return a.count.any > b.count.any;
  });
  button("Copy as CSV")->click();
  EXPECT_EQ(clipboard(), analysis::summaryCsv(expected));
}

TEST_F(ResultsPanelTest, CopiesSelectedRowsWithTheKeyboard) {
  testsupport::addSampleRun(document_);
  panel_.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel_));
  panel_.table().setFocus();
  panel_.table().selectRow(5);
  QTest::keyClick(&panel_.table(), Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(clipboard(), analysis::summaryCsv({panel_.run()->summary[5]}));
}

TEST_F(ResultsPanelTest, AsksToSaveTheRunThatIsShown) {
  testsupport::addSampleRun(document_);
  QSignalSpy requests(&panel_, &ResultsPanel::saveRequested);
  button("Save tables...")->click();
  ASSERT_EQ(requests.count(), 1);
  EXPECT_EQ(requests[0][0].value<ResultsPanel::Record>(), panel_.run());
}

TEST_F(ResultsPanelTest, BeginsInTheOrderOfTheFile) {
  testsupport::addSampleRun(document_);
  const std::vector<int> rows = panel_.filter().shownRows();
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_EQ(rows.size(), panel_.run()->summary.size());
}

}  // namespace
}  // namespace lorica::panels
