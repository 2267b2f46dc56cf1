#include "lorica/models/results_model.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QTemporaryDir>
#include <numeric>

#include "lorica/base/files.h"
#include "sample_document.h"

namespace lorica::models {
namespace {

class ResultsModelTest : public testing::Test {
 protected:
  ResultsModelTest() {
    testsupport::openLoadedSample(document_);
    testsupport::addSampleRun(document_);
    record_ = document_.runs().back();
    model_.setRecord(record_);
    filter_.setSourceModel(&model_);
  }

  std::vector<int> allRows() const {
    std::vector<int> rows(record_->summary.size());
    std::iota(rows.begin(), rows.end(), 0);
    return rows;
  }

  document::StudyDocument document_;
  std::shared_ptr<const document::RunRecord> record_;
  ResultsModel model_;
  ResultsFilter filter_;
};

TEST_F(ResultsModelTest, KeepsTheContractOfModelsThroughChanges) {
  ResultsModel model;
  ResultsFilter filter;
  filter.setSourceModel(&model);
  const auto mode = QAbstractItemModelTester::FailureReportingMode::Fatal;
  const QAbstractItemModelTester tester(&model, mode);
  const QAbstractItemModelTester filterTester(&filter, mode);
  model.setRecord(record_);
  filter.setWanted(ResultsModel::kindColumn, "organ");
  filter.sort(ResultsModel::coverageColumn, Qt::DescendingOrder);
  filter.setText("lung");
  filter.sort(-1);
  model.setRecord(nullptr);
  EXPECT_EQ(filter.rowCount(), 0);
}

TEST_F(ResultsModelTest, CopyOfAllRowsIsSummaryCsv) {
  const QByteArray copied = model_.csv(allRows());
  EXPECT_EQ(copied.toStdString(), analysis::summaryCsv(record_->summary));
  const QTemporaryDir folder;
  const std::filesystem::path place = folder.path().toStdString();
  analysis::writeResults(*record_->study, record_->result, place);
  EXPECT_EQ(copied.toStdString(), base::readFile(place / "summary.csv"));
}

TEST_F(ResultsModelTest, CopyOfSomeRowsIsTheirLinesOfSummaryCsv) {
  const QList<QByteArray> all = model_.csv(allRows()).split('\n');
  const QList<QByteArray> some = model_.csv({7, 3}).split('\n');
  ASSERT_EQ(some.size(), 4);  // header, two rows, nothing
  EXPECT_EQ(some[0], all[0]);
  EXPECT_EQ(some[1], all[8]);
  EXPECT_EQ(some[2], all[4]);
}

TEST_F(ResultsModelTest, HasTheColumnsThatSummaryCsvBeginsWithInItsOrder) {
  const QList<QByteArray> lines = model_.csv(allRows()).split('\n');
  ASSERT_GE(lines[0].split(',').size(), model_.columnCount());
  for (int row = 0; row < model_.rowCount(); row += 17) {
    const QList<QByteArray> fields = lines[row + 1].split(',');
    for (int column = 0; column < model_.columnCount(); ++column) {
      const QVariant raw = model_.index(row, column).data(ResultsModel::rawRole);
      const QByteArray& field = fields[column];
      if (column < ResultsModel::shotsColumn) {
        EXPECT_EQ(raw.toString().toUtf8(), field);
      } else if (field.isEmpty()) {
        EXPECT_FALSE(raw.isValid());
      } else {
        EXPECT_NEAR(raw.toDouble(), field.toDouble(), 1e-6) << column;
      }
    }
  }
}

TEST_F(ResultsModelTest, WritesNumbersForReading) {
  const auto row =
      static_cast<int>(std::find_if(record_->summary.begin(), record_->summary.end(),
                                    [](const analysis::ResultRow& one) { return one.coverage().value_or(0.0) > 0.0; }) -
                       record_->summary.begin());
  ASSERT_LT(row, model_.rowCount());
  const auto text = [&](int column) { return model_.index(row, column).data().toString(); };
  EXPECT_EQ(text(ResultsModel::shotsColumn), "4,000");
  const double coverage = *record_->summary[static_cast<std::size_t>(row)].coverage();
  EXPECT_NEAR(text(ResultsModel::coverageColumn).toDouble(), 100.0 * coverage, 0.0501);
  EXPECT_EQ(text(ResultsModel::coverageColumn).section('.', 1).size(), 1);
  EXPECT_EQ(text(ResultsModel::ofShotsColumn).section('.', 1).size(), 2);
}

TEST_F(ResultsModelTest, ExplainsEveryColumn) {
  for (int column = 0; column < model_.columnCount(); ++column) {
    EXPECT_FALSE(model_.headerData(column, Qt::Horizontal).toString().isEmpty());
    EXPECT_FALSE(model_.headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString().isEmpty());
  }
}

class Sorting : public ResultsModelTest, public testing::WithParamInterface<Qt::SortOrder> {};

TEST_P(Sorting, ByCoverageIsNumericWithBlanksLast) {
  filter_.sort(ResultsModel::coverageColumn, GetParam());
  ASSERT_EQ(filter_.rowCount(), model_.rowCount());
  std::vector<double> values;
  int blanks = 0;
  for (int row = 0; row < filter_.rowCount(); ++row) {
    const QVariant raw = filter_.index(row, ResultsModel::coverageColumn).data(ResultsModel::rawRole);
    if (!raw.isValid()) {
      ++blanks;
      continue;
    }
    EXPECT_EQ(blanks, 0) << "a number stands behind a blank";
    values.push_back(raw.toDouble());
  }
  EXPECT_GT(blanks, 0) << "the sample has structures that are never hit";
  const bool up = GetParam() == Qt::AscendingOrder;
  EXPECT_TRUE(up ? std::is_sorted(values.begin(), values.end()) : std::is_sorted(values.rbegin(), values.rend()));
  EXPECT_NE(values.front(), values.back());
}

TEST_P(Sorting, OfCountsIsNumeric) {
  filter_.sort(ResultsModel::anyColumn, GetParam());
  std::vector<std::uint64_t> counts;
  for (const int row : filter_.shownRows()) {
    counts.push_back(model_.row(row).count.any);
  }
  EXPECT_TRUE(GetParam() == Qt::AscendingOrder ? std::is_sorted(counts.begin(), counts.end())
                                               : std::is_sorted(counts.rbegin(), counts.rend()));
}

INSTANTIATE_TEST_SUITE_P(BothWays, Sorting, testing::Values(Qt::AscendingOrder, Qt::DescendingOrder),
                         [](const auto& order) { return order.param == Qt::AscendingOrder ? "Up" : "Down"; });

TEST_F(ResultsModelTest, UnsortedRowsKeepTheOrderOfTheFile) {
  filter_.sort(ResultsModel::anyColumn, Qt::DescendingOrder);
  EXPECT_NE(filter_.shownRows(), allRows());
  filter_.sort(-1);
  EXPECT_EQ(filter_.shownRows(), allRows());
}

TEST_F(ResultsModelTest, FiltersKeepExactlyTheRowsThatFit) {
  filter_.setWanted(ResultsModel::systemColumn, "full_torso");
  filter_.setWanted(ResultsModel::poseColumn, "toe_touch@2");
  filter_.setWanted(ResultsModel::kindColumn, "organ");
  filter_.setText("LUNG");
  std::vector<int> expected;
  for (const int row : allRows()) {
    const analysis::ResultRow& one = model_.row(row);
    if (one.system == "full_torso" && one.pose == "toe_touch@2" && one.kind == "organ" &&
        one.structure.starts_with("lung")) {
      expected.push_back(row);
    }
  }
  EXPECT_EQ(expected.size(), 4U);  // two lungs, two models
  EXPECT_EQ(filter_.shownRows(), expected);
  filter_.setText("");
  filter_.setWanted(ResultsModel::systemColumn, "");
  filter_.setWanted(ResultsModel::poseColumn, "");
  filter_.setWanted(ResultsModel::kindColumn, "");
  EXPECT_EQ(filter_.shownRows(), allRows());
}

TEST_F(ResultsModelTest, RowsKnowWhatTheyCount) {
  for (const analysis::ResultRow& row : record_->summary) {
    const std::optional<document::ItemRef> item = itemOf(row);
    const bool sums = row.kind == "aggregate" || row.kind == "class";
    EXPECT_EQ(item.has_value(), !sums && row.structure != "miss") << row.structure;
    EXPECT_TRUE(!item || document::exists(document_, *item)) << row.structure;
  }
}

}  // namespace
}  // namespace lorica::models
