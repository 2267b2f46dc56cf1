#include <functional>
#include <nlohmann/json.hpp>

#include "program.h"

namespace lorica::test {
namespace {

using Json = nlohmann::ordered_json;

class Merge : public Program {
 protected:
  void writeStudy() const {
    auto study = Json::parse(run("template sample").out);
    study["models"] = {"static_joint", "dynamic"};
    study["deformer"] = "lattice";  // is read faster
    const Json organs = study["organs"];
    study["organs"] = {organs[0], organs[1]};
    study["analyses"] = {{"compare", true}, {"convergence", true}};
    write("s.lorica.json", study.dump());
  }
  void shoot(const std::string& out, const std::string& more) const {
    const Outcome outcome = run("run s.lorica.json --pose rest --trials 2 --shots 301 --quiet --out " + out + more);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  /// What merging says when part 2 has been changed.
  void complainsOf(const std::function<void(Json&)>& change, std::initializer_list<std::string> words) const {
    Json part = Json::parse(read("p2/part.json"));
    change(part);
    fs::create_directories(folder_ / "bad");
    write("bad/part.json", part.dump());
    expectOneClearLine(run("merge p1 bad --out out --quiet"), words);
    EXPECT_FALSE(exists("out"));
  }
};

TEST_F(Merge, OfAllPartsGivesTheBytesOfTheWholeRunAndOfFewerSaysWhatIsWrong) {
  writeStudy();
  shoot("whole", "");
  shoot("p1", " --part 1/2");
  shoot("p2", " --part 2/2");
  EXPECT_FALSE(exists("p1/summary.csv"));
  const Outcome merged = run("merge p2 p1 --out merged --quiet");
  ASSERT_EQ(merged.code, 0) << merged.err;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "whole")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(read("whole/" + name), read("merged/" + name)) << name;
    ++files;
  }
  EXPECT_EQ(files, 10U);

  expectOneClearLine(run("merge p1 --out out --quiet"), {"2 parts", "part 2 is missing"});
  expectOneClearLine(run("merge p1 p2 p1 --out out --quiet"), {"p1/part.json", "part 1 of 2, and so is", "once"});
  expectOneClearLine(run("merge p1 whole --out out --quiet"), {"whole/part.json", "no such file"});
  complainsOf([](Json& part) { part["run"]["seed"] = 9; },
              {"bad/part.json: /run/seed", "another run than p1/part.json: 9 here, 1 there"});
  complainsOf([](Json& part) { part["of"] = 3; }, {"bad/part.json", "one of 3 parts", "one of 2"});

  write("cut.json", read("p2/part.json").substr(0, 2000));
  fs::create_directories(folder_ / "cut");
  fs::rename(folder_ / "cut.json", folder_ / "cut/part.json");
  expectOneClearLine(run("merge p1 cut --out out --quiet"), {"cut/part.json", "damaged or cut off"});
  complainsOf([](Json& part) { part["lorica_part"] = 2; }, {"bad/part.json: /lorica_part", "this version"});
  complainsOf([](Json& part) { part["part"] = 3; }, {"/part", "3 of 2"});
  complainsOf([](Json& part) { part["trials"] = "two"; }, {"/trials", "whole number"});
  complainsOf([](Json& part) { part.erase("counts"); }, {"/counts", "missing"});
  complainsOf([](Json& part) { part["counts"][0]["trials"].erase(0); }, {"/counts/0/trials", "1 trials, the run 2"});
  complainsOf([](Json& part) { part["counts"][0]["trials"][1].erase(3); }, {"/counts/0/trials/1", "counts of 151"});
  complainsOf([](Json& part) { part["counts"][0]["trials"][1][5] = -4; }, {"/counts/0/trials/1", "whole numbers"});
  complainsOf([](Json& part) { part["counts"][0]["trials"][1][5] = 152; }, {"/counts/0/trials/1", "counts of 151"});
  complainsOf([](Json& part) { part["counts"][0]["rays"] = 1; }, {"/counts/0", "2 trials of 151 shots"});

  // The study is another one by now.
  auto study = Json::parse(read("s.lorica.json"));
  study["models"] = {"dynamic"};
  write("s.lorica.json", study.dump());
  expectOneClearLine(run("merge p1 p2 --out out --quiet"), {"p1/part.json: /run/study", "s.lorica.json as it is now"});
  EXPECT_FALSE(exists("out"));
}

TEST_F(Merge, AndPartsAreAskedForProperly) {
  for (const char* part : {"0/2", "3/2", "2", "1/", "/2", "1/2x", "-1/2", "1/100001"}) {
    const Outcome outcome = run(std::string("run s.lorica.json --out o --part ") + part);
    EXPECT_EQ(outcome.code, 2) << part;
    EXPECT_NE(outcome.err.find("I/N"), std::string::npos) << part << outcome.err;
  }
  EXPECT_EQ(run("run s.lorica.json --out o --part 1/2 --hits csv").code, 2);
  EXPECT_EQ(run("merge --out o").code, 2);
}

}  // namespace
}  // namespace lorica::test
