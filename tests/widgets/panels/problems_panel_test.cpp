#include "lorica/panels/problems_panel.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>

#include "sample_document.h"

namespace lorica::panels {
namespace {

using base::Severity;

TEST(ProblemsPanel, CountsAndCopiesWhatTheDocumentFound) {
  document::StudyDocument document;
  testsupport::openSample(document);
  ProblemsPanel panel(document);
  EXPECT_FALSE(panel.table().isVisibleTo(&panel)) << "nothing was found yet";
  QSignalSpy counts(&panel, &ProblemsPanel::countChanged);
  const base::Issues issues{{Severity::warning, "", "heart", "It is odd."},
                            {Severity::error, "x.obj", "", "It is bad."}};
  document.setProblems(issues);
  ASSERT_EQ(counts.count(), 1);
  EXPECT_EQ(counts[0][0].toInt(), 1);
  EXPECT_EQ(counts[0][1].toInt(), 1);
  EXPECT_TRUE(panel.table().isVisibleTo(&panel));
  panel.findChild<QPushButton*>()->click();
  EXPECT_EQ(QApplication::clipboard()->text().toStdString(), issues[1].line() + "\n" + issues[0].line() + "\n");
  panel.table().selectRow(1);
  panel.findChild<QPushButton*>()->click();
  EXPECT_EQ(QApplication::clipboard()->text().toStdString(), issues[0].line() + "\n");
  document.setProblems({});
  EXPECT_FALSE(panel.table().isVisibleTo(&panel));
}

}  // namespace
}  // namespace lorica::panels
