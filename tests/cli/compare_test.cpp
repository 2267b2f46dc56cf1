#include <cmath>
#include <map>
#include <vector>

#include "program.h"

namespace lorica::test {
namespace {

struct ThesisRow {
  const char* structure;
  const char* kind;
  std::vector<double> fixed;    // Table 2: static models, five trials, per cent
  std::vector<double> dynamic;  // Table 3
};

const std::vector<ThesisRow>& thesisRows() {
  static const std::vector<ThesisRow> rows{
      {"body", "body", {3.85, 3.84, 3.85, 3.83, 3.82}, {3.84, 3.87, 3.82, 3.84, 3.87}},
      {"armor", "aggregate", {11.03, 11.05, 10.73, 10.99, 10.5}, {11.12, 10.42, 10.61, 10.57, 11.1}},
      {"organs", "aggregate", {10.57, 11.01, 10.92, 10.86, 11.27}, {10.87, 10.93, 10.98, 11.44, 10.55}},
      {"lungs", "organ", {6.86, 7.39, 7.14, 7.02, 7.2}, {5.83, 5.98, 6.07, 6.3, 5.67}},
      {"liver", "organ", {1.44, 1.17, 1.39, 1.45, 1.41}, {1.98, 1.62, 1.94, 2.06, 1.92}},
      {"large_intestine", "organ", {1.35, 1.37, 1.36, 1.37, 1.58}, {1.69, 1.65, 1.72, 1.66, 1.63}},
      {"kidneys", "organ", {0.06, 0.02, 0.06, 0.04, 0.07}, {0.29, 0.19, 0.2, 0.18, 0.24}},
      {"trachea", "organ", {0.34, 0.29, 0.29, 0.37, 0.39}, {0.44, 0.45, 0.49, 0.61, 0.48}},
      {"stomach", "organ", {0.47, 0.63, 0.56, 0.51, 0.52}, {0.35, 0.36, 0.3, 0.34, 0.37}},
      {"small_intestine", "organ", {0.06, 0.15, 0.12, 0.1, 0.1}, {0.29, 0.34, 0.26, 0.29, 0.24}},
  };
  return rows;
}

/// The values of a column by structure, of the rows with a measure.
std::map<std::string, std::string> columnOf(const std::string& csv, const std::string& column,
                                            const std::string& measure) {
  std::istringstream lines(csv);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields(1);
    for (const char letter : line) {
      if (letter == ',') {
        fields.emplace_back();
      } else {
        fields.back() += letter;
      }
    }
    rows.push_back(fields);
  }
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(rows.at(0).begin(), rows.at(0).end(), name) - rows.at(0).begin());
  };
  std::map<std::string, std::string> values;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    if (rows[r].at(place("measure")) == measure) {
      values[rows[r].at(place("structure"))] = rows[r].at(place(column));
    }
  }
  return values;
}

/// Results of runs as files, written by hand.
class CompareRuns : public Program {
 protected:
  static std::string row(const std::string& model, std::size_t trial, const std::string& structure,
                         const std::string& kind, int any, int guarded, double total = 0.5) {
    return "front,vest," + model + ",rest," + std::to_string(trial) + "," + structure + "," + kind + ",,10000," +
           std::to_string(any) + "," + std::to_string(guarded) + ",solid angle,sr," + std::to_string(total) + "\n";
  }
  inline static const std::string head =
      "source,system,model,pose,trial,structure,kind,class,shots,any_hit,protected_hit,basis,unit,basis_total\n";

  void writeRun(const std::string& folder, int seed, const std::string& rows) const {
    fs::create_directories(folder_ / folder);
    write(folder + "/trials.csv", head + rows);
    write(folder + "/provenance.json", "{\"seed\": " + std::to_string(seed) + "}\n");
  }
  /// Table 2 or 3 as counts of 10,000 shots.
  static std::string thesisTable(bool dynamic) {
    std::string text;
    for (const ThesisRow& here : thesisRows()) {
      for (std::size_t t = 0; t < 5; ++t) {
        const double percent = (dynamic ? here.dynamic : here.fixed)[t];
        text += row(dynamic ? "dynamic" : "static_joint", t + 1, here.structure, here.kind,
                    static_cast<int>(std::lround(100.0 * percent)), 0);
      }
    }
    return text;
  }
};

TEST_F(CompareRuns, GivesTheWelchValuesOfTheThesisTables2And3) {
  writeRun("dynamic", 1, thesisTable(true));
  writeRun("static", 2, thesisTable(false));
  const Outcome outcome = run("compare dynamic static --out c.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Welch"), std::string::npos);
  EXPECT_NE(outcome.out.find("7 differ at 5 % after Holm"), std::string::npos) << outcome.out;
  auto t = columnOf(read("c.csv"), "t", "pct_of_shots");
  auto holm = columnOf(read("c.csv"), "p_holm", "pct_of_shots");
  const std::map<std::string, double> expected{{"lungs", -8.29},         {"small_intestine", 7.94}, {"kidneys", 7.68},
                                               {"liver", 5.85},          {"stomach", -6.54},        {"trachea", 4.31},
                                               {"large_intestine", 5.69}};
  for (const auto& [structure, statistic] : expected) {
    EXPECT_NEAR(std::stod(t.at(structure)), statistic, 0.005) << structure;
    EXPECT_LT(std::stod(holm.at(structure)), 0.05) << structure;
  }
  for (const char* structure : {"body", "armor", "organs"}) {
    EXPECT_GT(std::stod(holm.at(structure)), 0.05) << structure;
  }
  // Nothing is protected there: the coverage does not vary, so there is no test of it.
  for (const auto& [structure, value] : columnOf(read("c.csv"), "t", "coverage")) {
    EXPECT_EQ(value, "") << structure;
  }
}

TEST_F(CompareRuns, OnTheSameSeedTakesTrialsInPairs) {
  std::string first;
  std::string second;
  const std::vector<int> common{1010, 2020, 3010, 4020, 5010};
  for (std::size_t t = 0; t < 5; ++t) {
    first += row("dynamic", t + 1, "heart", "organ", common[t] + 10 + static_cast<int>(t % 2), 100);
    second += row("dynamic", t + 1, "heart", "organ", common[t], 100);
  }
  writeRun("a", 7, first);
  writeRun("b", 7, second);
  ASSERT_EQ(run("compare a b --out paired.csv").code, 0);
  writeRun("b", 8, second);
  ASSERT_EQ(run("compare a b --out welch.csv").code, 0);
  const auto p = [&](const char* file) { return std::stod(columnOf(read(file), "p", "pct_of_shots").at("heart")); };
  EXPECT_EQ(columnOf(read("paired.csv"), "test", "pct_of_shots").at("heart"), "paired");
  EXPECT_LT(p("paired.csv"), 1e-4);
  EXPECT_GT(p("welch.csv"), 0.9);
  const auto low = columnOf(read("paired.csv"), "difference_lo", "pct_of_shots");
  EXPECT_GT(std::stod(low.at("heart")), 0.09);
}

TEST_F(CompareRuns, StatesTheCountsBehindItsMeansAndThatARunWasCutShort) {
  const std::string rows = row("dynamic", 1, "heart", "organ", 10, 4) + row("dynamic", 2, "heart", "organ", 12, 7);
  writeRun("a", 1, rows);
  writeRun("b", 2, rows);
  ASSERT_EQ(run("compare a b --out whole.csv").code, 0);
  const auto count = [&](const char* column, const char* measure) {
    return columnOf(read("whole.csv"), column, measure).at("heart");
  };
  EXPECT_EQ(count("hits_first", "pct_of_shots"), "22");
  EXPECT_EQ(count("of_first", "pct_of_shots"), "20000");
  EXPECT_EQ(count("hits_second", "coverage"), "11");
  EXPECT_EQ(count("of_second", "coverage"), "22");
  EXPECT_EQ(read("whole.csv").find("partial"), std::string::npos);
  write("b/provenance.json", R"({"seed": 2, "partial": true})");
  const Outcome outcome = run("compare a b --out part.csv");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("b: the run was cut short"), std::string::npos) << outcome.err;
  EXPECT_EQ(columnOf(read("part.csv"), "partial", "coverage").at("heart"), "yes");
  write("b/provenance.json", R"({"seed": 2, "partial": "no"})");
  expectOneClearLine(run("compare a b --out c.csv"), {"b/provenance.json", "/partial", "true or false"});
}

TEST_F(CompareRuns, SaysInOneLineWhatItCannotCompare) {
  const std::string sound = row("dynamic", 1, "heart", "organ", 10, 5) + row("dynamic", 2, "heart", "organ", 11, 5);
  writeRun("a", 1, sound);
  const auto complain = [&](const std::string& rows, std::initializer_list<std::string> words) {
    writeRun("b", 2, rows);
    expectOneClearLine(run("compare a b --out c.csv"), words);
    EXPECT_FALSE(exists("c.csv"));
  };
  complain("", {"b/trials.csv", "no trial"});
  complain(row("dynamic", 1, "heart", "organ", 10, 5), {"two trials"});
  complain(sound + row("dynamic", 2, "heart", "organ", 11, 5), {"line 4", "twice"});
  complain(row("dynamic", 1, "heart", "organ", 10, 12), {"line 2", "'protected_hit' is 12, more than 'any_hit'"});
  complain(row("dynamic", 1, "heart", "organ", 10001, 5), {"more than 'shots'"});
  complain(row("dynamic", 1, "heart", "organ", -1, 0), {"whole number from 0", "'any_hit'", "-1"});
  complain(row("dynamic", 1, "heart", "organ", 10, 5, 0.6) + row("dynamic", 2, "heart", "organ", 10, 5, 0.6),
           {"basis of solid angle 0.6 sr", "0.5 sr", "same poses"});
  writeRun("b", 2, sound);
  write("b/trials.csv",
        "source,system,model,pose,trial,structure,kind,any_hit\nfront,vest,dynamic,rest,1,heart,organ,1\n");
  expectOneClearLine(run("compare a b --out c.csv"), {"b/trials.csv", "no column 'shots'"});
  writeRun("b", 2, sound);
  write("b/provenance.json", "{}");
  expectOneClearLine(run("compare a b --out c.csv"), {"b/provenance.json", "seed"});
  expectOneClearLine(run("compare a a --out c.csv"), {"both runs"});
  expectOneClearLine(run("compare a nowhere --out c.csv"), {"nowhere"});
}

}  // namespace
}  // namespace lorica::test
