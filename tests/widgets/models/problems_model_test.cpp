#include "lorica/models/problems_model.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QIcon>

namespace lorica::models {
namespace {

using base::Severity;

const base::Issues mixed{{Severity::note, "a.obj", "", "First note."},
                         {Severity::error, "b.obj", "line 3", "An error."},
                         {Severity::warning, "", "heart", "First warning."},
                         {Severity::warning, "", "", "Second warning."}};

TEST(ProblemsModel, PutsErrorsFirstAndKeepsTheOrderWithinASeverity) {
  ProblemsModel model;
  const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
  model.setIssues(mixed);
  QStringList texts;
  for (int row = 0; row < model.rowCount(); ++row) {
    texts << model.index(row, ProblemsModel::textColumn).data().toString();
  }
  EXPECT_EQ(texts, QStringList({"An error.", "First warning.", "Second warning.", "First note."}));
  model.setIssues({});
  EXPECT_EQ(model.rowCount(), 0);
}

TEST(ProblemsModel, CountsBySeverity) {
  ProblemsModel model;
  model.setIssues(mixed);
  EXPECT_EQ(model.count(Severity::error), 1);
  EXPECT_EQ(model.count(Severity::warning), 2);
  EXPECT_EQ(model.count(Severity::note), 1);
}

TEST(ProblemsModel, CopiesLinesAsTheCommandLinePrintsThem) {
  ProblemsModel model;
  model.setIssues(mixed);
  EXPECT_EQ(model.lines({0, 3}).toStdString(), mixed[1].line() + "\n" + mixed[0].line() + "\n");
}

TEST(ProblemsModel, MarksSeverityWithAnIconAndAWord) {
  ProblemsModel model;
  model.setIssues(mixed);
  for (int row = 0; row < model.rowCount(); ++row) {
    const QModelIndex index = model.index(row, ProblemsModel::severityColumn);
    EXPECT_FALSE(index.data(Qt::DecorationRole).value<QIcon>().isNull());
    EXPECT_FALSE(index.data().toString().isEmpty());
  }
}

}  // namespace
}  // namespace lorica::models
