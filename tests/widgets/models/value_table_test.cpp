#include "lorica/models/value_table.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QSortFilterProxyModel>

#include "lorica/models/model_texts.h"

namespace lorica::models {
namespace {

TableContent content() {
  return {{{"name", {}, false, false}, {"size", "how large", true}, {"pose", {}, false, false}},
          {{{"b"}, {"9", 9.0}, {"rest"}}, {{"a"}, {"10", 10.0}, {"rest"}}, {{"c"}, {"-"}, {"rest"}}}};
}

TEST(ValueTable, IsAModelBeforeAndAfterItIsFilled) {
  ValueTable table;
  const QAbstractItemModelTester tester(&table, QAbstractItemModelTester::FailureReportingMode::Fatal);
  table.setContent(content());
  table.setContent({});
  table.setContent(content());
  EXPECT_EQ(table.index(1, 0).data().toString(), "a");
  EXPECT_EQ(table.headerData(1, Qt::Horizontal, Qt::ToolTipRole).toString(), "how large");
}

TEST(ValueTable, SortsNumbersAsNumbersAndBlanksBelowThem) {
  ValueTable table;
  table.setContent(content());
  QSortFilterProxyModel sorted;
  sorted.setSourceModel(&table);
  sorted.setSortRole(ValueTable::orderRole);
  sorted.sort(1, Qt::DescendingOrder);
  EXPECT_EQ(sorted.index(0, 0).data().toString(), "a");
  EXPECT_EQ(sorted.index(1, 0).data().toString(), "b");
  EXPECT_EQ(sorted.index(2, 0).data().toString(), "c");
}

TEST(ValueTable, AColumnThatIsTheSameInEveryRowIsIdleUnlessItTells) {
  ValueTable table;
  table.setContent(content());
  EXPECT_FALSE(table.isIdle(0));
  EXPECT_FALSE(table.isIdle(1));
  EXPECT_TRUE(table.isIdle(2));
}

TEST(ModelNames, AreTheSameWhetherAFileOrTheProgramSaysWhichModel) {
  QStringList labels;
  for (const ModelText& text : modelTexts()) {
    EXPECT_EQ(modelLabel(text.model), text.label);
    EXPECT_EQ(modelFromFile(viscera::name(text.model)), text.label);
    EXPECT_FALSE(labels.contains(text.label));
    labels.append(text.label);
  }
  EXPECT_EQ(modelFromFile("what is no model"), "what is no model");
}

}  // namespace
}  // namespace lorica::models
