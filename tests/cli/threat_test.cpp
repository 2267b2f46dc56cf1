// The command `threat` as a user meets it.

#include <gtest/gtest.h>

#include "program.h"

namespace lorica::test {
namespace {

class ThreatCommand : public Program {
 protected:
  /// A study of the minimal template with threat data that a text describes.
  void writeStudy(const std::string& threats) const {
    const Outcome minimal = run("template minimal");
    std::string text = minimal.out;
    text.insert(text.find_last_of('}'), ", \"threats\": " + threats);
    write("s.lorica.json", text);
  }
};

TEST_F(ThreatCommand, TellsWhatABlastDoesToEveryRegion) {
  writeStudy(R"([{"name": "charge", "builtin": "blast", "tnt_kg": 2, "position": [0, 1, 4], "threshold": 50}])");
  const Outcome told = run("threat s.lorica.json --out out --pose rest --threads 2");
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.out.find("charge, pose rest: pressure (kPa)"), std::string::npos);
  const std::string table = read("out/threat.csv");
  EXPECT_TRUE(table.starts_with("threat,attribute,unit,structure,kind,model,pose,at_ms,peak,"));
  EXPECT_NE(table.find("\ncharge,pressure,kPa,body,body,,rest,,"), std::string::npos);
  EXPECT_NE(table.find("\ncharge,pressure,kPa,chest_front,region,,rest,,"), std::string::npos);
  EXPECT_FALSE(exists("out/fragments.csv"));
}

TEST_F(ThreatCommand, RefusesWhatCannotBeInOneLine) {
  writeStudy("[]");
  const Outcome none = run("threat s.lorica.json --out out");
  EXPECT_EQ(none.code, 3);
  EXPECT_NE(none.err.find("s.lorica.json: /threats: the study has no threat data; add one"), std::string::npos);
  write("p.csv", "x,y,z,p\n0,0,0,high\n");
  writeStudy(R"([{"name": "t", "file": "p.csv"}])");
  const Outcome bad = run("threat s.lorica.json --out out");
  EXPECT_EQ(bad.code, 3);
  EXPECT_NE(bad.err.find("p.csv: line 2, column p: expected a number, found \"high\""), std::string::npos);
  EXPECT_EQ(std::count(bad.err.begin(), bad.err.end(), '\n'), 1);
  EXPECT_EQ(run("threat s.lorica.json --out out --slice up").code, 2);
  EXPECT_FALSE(exists("out/threat.csv"));
}

TEST_F(ThreatCommand, CheckAuditsAFile) {
  write("p.csv", "x_mm,y_mm,z_mm,t_ms,score\n0,0,0,1,5\n0,0,0,1,7\n10,0,0,2,6\n");
  const Outcome told = run("check p.csv");
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.out.find("1 point(s) lie at the place of another at the same time"), std::string::npos);
  EXPECT_NE(told.out.find("2 scattered points at the first time, 2 time(s) from 1 to 2 ms"), std::string::npos);
  EXPECT_NE(told.out.find("p.csv:score: note: from 5 to 7"), std::string::npos);
  write("p.csv", "x,y,z,t\n0,0,0,late\n");
  const Outcome bad = run("check p.csv");
  EXPECT_EQ(bad.code, 3);
  EXPECT_NE(bad.out.find("line 2, column t"), std::string::npos);
}

}  // namespace
}  // namespace lorica::test
