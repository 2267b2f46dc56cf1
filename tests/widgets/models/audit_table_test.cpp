#include "lorica/models/audit_table.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <algorithm>
#include <numeric>

#include "lorica/models/model_texts.h"
#include "two_poses.h"

namespace lorica::models {
namespace {

using testsupport::twoPoses;

int columnOf(Measure measure) {
  return 3 + static_cast<int>(measure);
}

class AuditTableTest : public testing::Test {
 protected:
  AuditTableTest() { table_.setTable(organTable(twoPoses())); }

  QString at(int row, int column, int role = Qt::DisplayRole) const {
    return table_.index(row, column).data(role).toString();
  }
  /// The row of a thing in the order of the file: models, then poses, then organs.
  static int row(int model, int pose, int organ) { return 4 * model + 2 * pose + organ; }
  std::vector<int> shown(const AuditFilter& filter) const { return filter.shownRows(); }

  AuditTable table_;
  AuditFilter filter_{table_};
};

TEST_F(AuditTableTest, IsASoundModelWhileItIsFilledFilteredAndEmptied) {
  const QAbstractItemModelTester tester(&table_, QAbstractItemModelTester::FailureReportingMode::Fatal);
  const QAbstractItemModelTester filterTester(&filter_, QAbstractItemModelTester::FailureReportingMode::Fatal);
  table_.setTable(contactTable(twoPoses()));
  table_.setTable(organTable(twoPoses()));
  filter_.keepWorst(columnOf(Measure::gap));
  filter_.sort(columnOf(Measure::volume), Qt::DescendingOrder);
  table_.setTable(organTable({}));
  filter_.keepWorst(std::nullopt);
  EXPECT_EQ(filter_.rowCount(), 0);
}

TEST_F(AuditTableTest, ShowsTheNumbersInTheirUnits) {
  ASSERT_EQ(table_.rowCount(), 8);
  const int liver = row(1, 1, 0);
  EXPECT_EQ(at(liver, 0), "liver");
  EXPECT_EQ(at(liver, 1), "Dynamic");
  EXPECT_EQ(at(liver, 2), "turn");
  EXPECT_EQ(at(liver, columnOf(Measure::volume)), "-3.00");
  EXPECT_EQ(at(liver, columnOf(Measure::outside)), "1.00");
  EXPECT_EQ(at(liver, columnOf(Measure::protrusion)), "2.0");
  EXPECT_EQ(at(liver, columnOf(Measure::overlap)), "0.0");
  EXPECT_EQ(at(liver, columnOf(Measure::gap)), "1.20");
  EXPECT_EQ(at(liver, columnOf(Measure::inverted)), "1");
  EXPECT_EQ(at(liver, columnOf(Measure::jacobian)), "0.500");
  EXPECT_EQ(at(liver, columnOf(Measure::stretch)), "1.250");
  EXPECT_EQ(table_.index(liver, 0).data(AuditTable::itemRole).value<document::ItemRef>(),
            (document::ItemRef{document::ItemKind::organ, "liver"}));
}

TEST_F(AuditTableTest, BlankCellsSayWhyTheyAreBlank) {
  for (const Measure measure : {Measure::volume, Measure::outside, Measure::overlap, Measure::gap}) {
    const int open = row(1, 0, 1);
    EXPECT_EQ(at(open, columnOf(measure)), "") << static_cast<int>(measure);
    EXPECT_FALSE(table_.index(open, columnOf(measure)).data(AuditTable::rawRole).isValid());
    EXPECT_NE(at(open, columnOf(measure), Qt::ToolTipRole), "");
  }
  EXPECT_TRUE(at(row(1, 0, 1), columnOf(Measure::volume), Qt::ToolTipRole).contains("open patches"));
  EXPECT_EQ(at(row(0, 0, 0), columnOf(Measure::inverted)), "") << "rigid";
  EXPECT_TRUE(at(row(0, 0, 0), columnOf(Measure::inverted), Qt::ToolTipRole).contains("rigid"));
}

TEST_F(AuditTableTest, RowsAreCopiedAsTheyStandInTheFile) {
  const analysis::DeformationTables tables = twoPoses();
  std::vector<int> all(static_cast<std::size_t>(table_.rowCount()));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(table_.csv(all).toStdString(), analysis::deformationCsv(tables));
  const QByteArrayList lines = QByteArray::fromStdString(analysis::deformationCsv(tables)).split('\n');
  EXPECT_EQ(table_.csv({5, 2}), lines[0] + "\n" + lines[6] + "\n" + lines[3] + "\n");
  EXPECT_TRUE(lines[6].startsWith("\"veins, small\",dynamic,bend")) << lines[6].toStdString();
  EXPECT_EQ(at(5, 0), "veins, small");

  AuditTable contacts;
  contacts.setTable(contactTable(tables));
  ASSERT_EQ(contacts.rowCount(), 4);
  all.resize(4);
  EXPECT_EQ(contacts.csv(all).toStdString(), analysis::contactsCsv(tables));
}

TEST_F(AuditTableTest, OrderOfTheRowsOfAnAuditIsThatOfTheFileWhateverOrderItWasMadeIn) {
  analysis::DeformationTables tables = twoPoses();
  std::reverse(tables.rows.begin(), tables.rows.end());
  table_.setTable(organTable(tables));
  for (int r = 0; r < table_.rowCount(); ++r) {
    const QByteArray line = table_.csv({r}).split('\n')[1];
    for (const int column : {0, 2}) {
      EXPECT_TRUE(line.contains(at(r, column).toUtf8())) << line.toStdString();
    }
    const QByteArray model = line.contains(",static_joint,") ? "static_joint" : "dynamic";
    EXPECT_EQ(at(r, 1), modelFromFile(model.toStdString())) << line.toStdString();
  }
}

TEST_F(AuditTableTest, TheWorstPoseDependsOnWhatIsAskedFor) {
  filter_.keepWorst(columnOf(Measure::protrusion));
  std::vector<int> rows = filter_.shownRows();
  std::sort(rows.begin(), rows.end());
  EXPECT_EQ(rows, (std::vector<int>{row(0, 0, 0), row(0, 0, 1), row(1, 0, 0), row(1, 0, 1)}));
  filter_.keepWorst(columnOf(Measure::volume));
  rows = filter_.shownRows();
  EXPECT_NE(std::find(rows.begin(), rows.end(), row(1, 1, 0)), rows.end()) << "-3 % is worse than +1 %";
  filter_.keepWorst(columnOf(Measure::jacobian));
  rows = filter_.shownRows();
  EXPECT_NE(std::find(rows.begin(), rows.end(), row(1, 1, 0)), rows.end()) << "the smaller Jacobian is worse";
  filter_.keepWorst(std::nullopt);
  EXPECT_EQ(filter_.rowCount(), 8);
}

TEST_F(AuditTableTest, BlankCellsComeLastInEitherDirection) {
  for (const Qt::SortOrder order : {Qt::AscendingOrder, Qt::DescendingOrder}) {
    filter_.sort(columnOf(Measure::volume), order);
    for (int r = 4; r < 8; ++r) {
      EXPECT_FALSE(filter_.index(r, columnOf(Measure::volume)).data(AuditTable::rawRole).isValid()) << r;
    }
  }
  filter_.sort(columnOf(Measure::protrusion), Qt::DescendingOrder);
  EXPECT_EQ(filter_.index(0, columnOf(Measure::protrusion)).data().toString(), "12.0") << "as numbers, not as texts";
}

}  // namespace
}  // namespace lorica::models
