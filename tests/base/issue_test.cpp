#include "lorica/base/issue.h"

#include <gtest/gtest.h>

namespace lorica::base {
namespace {

TEST(Issue, LineNamesFilePlaceSeverityAndText) {
  EXPECT_EQ((Issue{Severity::warning, "body.glb", "node 3", "it has no skin"}.line()),
            "body.glb:node 3: warning: it has no skin");
}

TEST(Issue, LineLeavesOutMissingPieces) {
  EXPECT_EQ((Issue{Severity::note, "body.glb", "", "it is large"}.line()), "body.glb: note: it is large");
  EXPECT_EQ((Issue{Severity::error, "", "line 7", "it is bad"}.line()), "line 7: error: it is bad");
  EXPECT_EQ((Issue{Severity::warning, "", "", "it is odd"}.line()), "warning: it is odd");
}

TEST(Issue, AppendKeepsTheOrderOfBoth) {
  Issues issues = {{Severity::note, "", "", "one"}};
  append(issues, {{Severity::note, "", "", "two"}, {Severity::note, "", "", "three"}});
  append(issues, {});
  ASSERT_EQ(issues.size(), 3U);
  EXPECT_EQ(issues[0].text, "one");
  EXPECT_EQ(issues[1].text, "two");
  EXPECT_EQ(issues[2].text, "three");
}

}  // namespace
}  // namespace lorica::base
