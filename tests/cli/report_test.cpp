#include "program.h"

namespace lorica::test {
namespace {

class ReportCommand : public Program {
 protected:
  void writeMinimal() const { write("s.lorica.json", run("template minimal").out); }
};

#ifdef LORICA_REPORTS

TEST_F(ReportCommand, RunLeavesAReportThatTheFolderGivesAgain) {
  writeMinimal();
  const Outcome made = run("run s.lorica.json --out out --shots 500 --trials 2 --pdf");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("report.pdf"), std::string::npos) << made.out;
  EXPECT_TRUE(read("out/report.pdf").starts_with("%PDF-"));
  EXPECT_TRUE(exists("out/pictures/pose_1_front.png"));
  const Outcome again = run("report out --out 'my reports/again.pdf'");
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.err, "");
  EXPECT_TRUE(read("out/report.pdf") == read("my reports/again.pdf")) << "the same bytes";
}

TEST_F(ReportCommand, AFolderThatIsNoRunIsOneClearLine) {
  expectOneClearLine(run("report nowhere --out r.pdf"), {"nowhere", "lorica-cli run"});
  fs::create_directories(folder_ / "empty");
  expectOneClearLine(run("report empty --out r.pdf"), {"provenance.json"});
  fs::create_directories(folder_ / "foreign");
  write("foreign/provenance.json", "{\n  \"seed\": 1,\n}\n");
  expectOneClearLine(run("report foreign --out r.pdf"), {"provenance.json", "line 3"});
  write("foreign/provenance.json", "{\"seed\": 1}\n");
  expectOneClearLine(run("report foreign --out r.pdf"), {"provenance.json", "/lorica_version"});
  EXPECT_FALSE(exists("r.pdf"));
}

TEST_F(ReportCommand, ACutTableIsOneClearLineAndLeavesTheOldReport) {
  writeMinimal();
  ASSERT_EQ(run("run s.lorica.json --out out --shots 200 --trials 1 --quiet").code, 0);
  const std::string table = read("out/summary.csv");
  write("out/summary.csv", table.substr(0, table.size() - 100));
  write("r.pdf", "the old one");
  expectOneClearLine(run("report out --out r.pdf"), {"out/summary.csv", "line", "run the study again"});
  EXPECT_EQ(read("r.pdf"), "the old one");
}

TEST_F(ReportCommand, APlaceThatCannotBeWrittenIsOneClearLine) {
  writeMinimal();
  ASSERT_EQ(run("run s.lorica.json --out out --shots 200 --trials 1 --quiet").code, 0);
  fs::create_directories(folder_ / "taken.pdf" / "x");
  expectOneClearLine(run("report out --out taken.pdf"), {"taken.pdf"});
}

#else

TEST_F(ReportCommand, WithoutQtIsOneClearLineBeforeAnythingIsRun) {
  writeMinimal();
  expectOneClearLine(run("report out --out r.pdf"), {"without reports", "LORICA_WINDOW"});
  expectOneClearLine(run("run s.lorica.json --out out --pdf"), {"without reports"});
  EXPECT_FALSE(exists("out"));
}

#endif

}  // namespace
}  // namespace lorica::test
