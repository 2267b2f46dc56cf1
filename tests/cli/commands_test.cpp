#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "lorica/io/import.h"
#include "program.h"

namespace lorica::test {
namespace {

class Commands : public Program {
 protected:
  void writeSample() const { write("s.lorica.json", run("template sample").out); }
};

TEST_F(Commands, TemplatesAreListedPrintedAndSound) {
  const Outcome list = run("template --list");
  EXPECT_EQ(list.code, 0);
  std::istringstream names(list.out);
  std::set<std::string> seen;
  for (std::string name; std::getline(names, name);) {
    seen.insert(name);
    const Outcome text = run("template " + name);
    EXPECT_EQ(text.code, 0);
    write(name + ".lorica.json", text.out);
    EXPECT_EQ(run("check " + name + ".lorica.json").code, 0) << name;
  }
  EXPECT_TRUE(seen.contains("sample"));
}

TEST_F(Commands, RunTellsAllOfOneShotAndWritesEveryShot) {
  writeSample();
  const Outcome report = run("run s.lorica.json --pose rest --shot-report front:1:17");
  ASSERT_EQ(report.code, 0) << report.err;
  EXPECT_TRUE(report.out.starts_with("shot front:1:17, pose rest\n")) << report.out;
  expectOneClearLine(run("run s.lorica.json --pose rest --shot-report rear:1:17"), {"no source named \"rear\""});
  expectOneClearLine(run("run s.lorica.json --pose rest --shot-report front:1"), {"SOURCE:TRIAL:SHOT"});
  const Outcome hits = run("run s.lorica.json --out out --pose rest --trials 1 --shots 500 --hits csv --quiet");
  ASSERT_EQ(hits.code, 0) << hits.err;
  EXPECT_TRUE(read("out/hits.csv").starts_with("source,pose,trial,shot,order,structure,"));
}

TEST_F(Commands, RunWritesGapsAndAnatomyWhereTheStudyAsks) {
  auto study = nlohmann::json::parse(run("template sample").out);
  study["models"] = {"dynamic"};
  study["analyses"] = {{"gaps", {{"structures", {"heart", "body"}}}}, {"anatomy", {{"draws", 2}}}};
  write("s.lorica.json", study.dump());
  const Outcome outcome = run("run s.lorica.json --out out --pose rest --trials 1 --shots 60000 --quiet");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(read("out/gaps.csv").starts_with("source,system,model,pose,structure,patch,region,area_cm2,"));
  EXPECT_NE(read("out/gaps.csv").find("front,plate_carrier,dynamic,rest,body,1,"), std::string::npos);
  EXPECT_TRUE(exists("out/gaps.front.full_torso.dynamic.rest.vtp"));
  EXPECT_NE(read("out/anatomy.csv").find("front,full_torso,dynamic,rest,heart,organ,essential,unverified,"),
            std::string::npos);
  study["analyses"]["gaps"]["structures"] = {"gall_bladder"};
  write("s.lorica.json", study.dump());
  expectOneClearLine(run("run s.lorica.json --out out2 --quiet"), {"/analyses/gaps/structures/0", "gall_bladder"});
  const Outcome check = run("check s.lorica.json");
  EXPECT_EQ(check.code, 3);
  EXPECT_NE(check.out.find("/analyses/gaps/structures/0: error"), std::string::npos) << check.out;
  study["analyses"]["gaps"]["structures"] = {"heart"};
  study["analyses"]["anatomy"] = {{"draws", 0}};
  write("s.lorica.json", study.dump());
  expectOneClearLine(run("run s.lorica.json --out out2 --quiet"), {"/analyses/anatomy/draws", "found 0"});
  study["analyses"]["anatomy"] = {{"sd_mm", {{"gall_bladder", {1, 2, 3}}}}};
  write("s.lorica.json", study.dump());
  expectOneClearLine(run("run s.lorica.json --out out2 --quiet"), {"/analyses/anatomy/sd_mm", "gall_bladder"});
}

TEST_F(Commands, RunLeavesThreeFilesWithThePromisedColumns) {
  writeSample();
  const Outcome outcome = run("run s.lorica.json --out out --pose rest --trials 2 --shots 2000");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("heart"), std::string::npos);
  const std::string columns =
      "structure,kind,class,shots,any_hit,first_hit,unprotected_hit,protected_hit,pct_of_shots,pct_of_body_hits,"
      "coverage,coverage_lo,coverage_hi,pct_of_shots_lo,pct_of_shots_hi,interval,basis,unit,basis_total,"
      "coverage_trials_mean,coverage_trials_sd,coverage_trials_se\n";
  EXPECT_TRUE(read("out/summary.csv").starts_with("source,system,model,pose," + columns));
  EXPECT_TRUE(read("out/trials.csv").starts_with("source,system,model,pose,trial," + columns));
  EXPECT_TRUE(read("out/deformation.csv")
                  .starts_with("structure,model,pose,volume_change_pct,outside_skin_pct,protrusion_mm,overlap_cm3,"
                               "gap_mm,inverted_cells,min_jacobian,max_stretch"));
  EXPECT_TRUE(read("out/contacts.csv").starts_with("structure_a,structure_b,model,pose,overlap_cm3,gap_mm"));
  EXPECT_TRUE(read("out/room.csv").starts_with("pose,skin_l,"));
  const auto provenance = nlohmann::json::parse(read("out/provenance.json"));
  EXPECT_EQ(provenance["partial"], false);
  EXPECT_EQ(provenance["seed"], 1);
  EXPECT_GT(provenance["sources"][0]["solid_angle_sr"], 0.0);
}

TEST_F(Commands, RunGivesTheSameBytesAtOneTwoAndFiveThreads) {
  writeSample();
  for (const std::string threads : {"1", "2", "5"}) {
    ASSERT_EQ(run("run s.lorica.json --quiet --out out" + threads + " --threads " + threads +
                  " --pose toe_touch@2 --pose rest --shots 5000 --trials 2 --model dynamic --model dynamic_thesis")
                  .code,
              0);
  }
  for (const std::string file :
       {"summary.csv", "trials.csv", "deformation.csv", "contacts.csv", "room.csv", "provenance.json"}) {
    EXPECT_EQ(read("out1/" + file), read("out2/" + file));
    EXPECT_EQ(read("out1/" + file), read("out5/" + file));
    EXPECT_FALSE(read("out1/" + file).empty());
  }
}

TEST_F(Commands, QuietPrintsNothing) {
  writeSample();
  const Outcome outcome = run("run s.lorica.json --quiet --out out --pose rest --trials 1 --shots 500");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Commands, WrongUsageIsExitCode2WithOneLine) {
  writeSample();
  for (const std::string arguments :
       {"", "fly", "template nope", "run s.lorica.json --out o --seed -1", "run", "run s.lorica.json",
        "run s.lorica.json --out o --shots 0", "run s.lorica.json --out o --shots x",
        "run s.lorica.json --out o --model soft", "export s.lorica.json --pose rest --format stl --out x"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST_F(Commands, HelpNamesEveryCommand) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.code, 0);
  for (const std::string name :
       {"run", "check", "template", "generate", "import", "export", "report", "upgrade", "bench"}) {
    EXPECT_NE(outcome.out.find("  " + name), std::string::npos) << name;
    EXPECT_EQ(run(name + " --help").code, 0);
  }
}

TEST_F(Commands, UpgradeOfACurrentStudySavesTheSameBytes) {
  writeSample();
  ASSERT_EQ(run("upgrade s.lorica.json --out once.lorica.json").code, 0);
  ASSERT_EQ(run("upgrade once.lorica.json --out twice.lorica.json").code, 0);
  EXPECT_EQ(read("once.lorica.json"), read("twice.lorica.json"));
  EXPECT_EQ(read("s.lorica.json"), read("once.lorica.json")) << "the sample is canonical";
}

TEST_F(Commands, ExportWritesEveryFormatAndImportsBack) {
  writeSample();
  for (const std::string format : {"glb", "ply", "vtp"}) {
    ASSERT_EQ(run("export s.lorica.json --pose toe_touch@2 --format " + format + " --out pose." + format).code, 0);
    EXPECT_GT(read("pose." + format).size(), 100000U);
  }
  const io::Model model = io::importModel(folder_ / "pose.glb");
  EXPECT_EQ(model.parts.front().name, "body");
  EXPECT_GT(model.parts.size(), 10U);
}

TEST_F(Commands, ImportOfAnExportRunsAndKeepsSystemsApart) {
  writeSample();
  ASSERT_EQ(run("export s.lorica.json --pose rest --format glb --out all.glb").code, 0);
  const Outcome outcome = run("import all.glb --armor all.glb --system light --plates --out made.lorica.json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto study = nlohmann::json::parse(read("made.lorica.json"));
  ASSERT_EQ(study["armor"].size(), 2U);
  EXPECT_EQ(study["armor"][0]["name"], "armor");
  EXPECT_EQ(study["armor"][1]["name"], "light");
  EXPECT_EQ(study["armor"][1]["pieces"].size(), 2U);
}

TEST_F(Commands, ImportTakesRecordedMotions) {
  const std::string joint = "CHANNELS 3 Zrotation Xrotation Yrotation\n";
  write("walk.bvh",
        "HIERARCHY\nROOT Hips\n{\nOFFSET 0 1 0\n" + joint + "}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n");
  EXPECT_EQ(run("check walk.bvh").code, 0);
  writeSample();
  ASSERT_EQ(run("export s.lorica.json --pose rest --format ply --out body.ply").code, 0);
  expectOneClearLine(run("import body.ply --motion walk.bvh --out made.lorica.json"), {"/motions/0", "no skeleton"});
  write("broken.bvh", "HIERARCHY\nROOT Hips\n{\nOFFSET 0 x 0\n");
  expectOneClearLine(run("import body.ply --motion broken.bvh --out made.lorica.json"), {"broken.bvh", "line 4"});
}

TEST_F(Commands, AcceptInputsTakesAChangedFile) {
  writeSample();
  ASSERT_EQ(run("export s.lorica.json --pose rest --format ply --out body.ply").code, 0);
  ASSERT_EQ(run("import body.ply --out made.lorica.json").code, 0);
  ASSERT_EQ(run("export s.lorica.json --pose squat@1 --format ply --out body.ply").code, 0);
  expectOneClearLine(run("run made.lorica.json --quiet --out out"), {"body.ply", "changed", "--accept-inputs"});
  EXPECT_FALSE(exists("out"));
  EXPECT_EQ(run("check made.lorica.json").code, 3);
  EXPECT_EQ(run("check --accept-inputs made.lorica.json").code, 0);
  EXPECT_EQ(run("run made.lorica.json --quiet --out out --trials 1 --shots 100").code, 0);
}

/// A box as OBJ, standing on y = 0 around the axis; without its last faces it is open.
std::string boxObj(double halfWidth, double height, double halfDepth, std::size_t faces = 6) {
  std::ostringstream text;
  for (const int corner : {0, 1, 2, 3, 4, 5, 6, 7}) {
    text << "v " << (corner & 1 ? halfWidth : -halfWidth) << ' ' << (corner & 2 ? height : 0.1) << ' '
         << (corner & 4 ? halfDepth : -halfDepth) << '\n';
  }
  const std::vector<std::string> sides{"1 3 4 2", "5 6 8 7", "1 5 7 3", "2 4 8 6", "1 2 6 5", "3 7 8 4"};
  for (std::size_t f = 0; f < faces; ++f) {
    text << "f " << sides[f] << '\n';
  }
  return text.str();
}

TEST_F(Commands, CheckNamesEachStructureThatDoesNotCloseWithItsOpenEdges) {
  write("skin.obj", boxObj(0.3, 1.8, 0.2));
  write("liver.obj", boxObj(0.1, 0.3, 0.1));
  write("heart.obj", boxObj(0.1, 0.4, 0.1, 5));
  ASSERT_EQ(run("import skin.obj liver.obj heart.obj --units m --up y --out s.lorica.json").code, 0);
  const Outcome outcome = run("check s.lorica.json");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("s.lorica.json:heart: warning: 1 of its 1 piece(s) do not close: 4 boundary edges"),
            std::string::npos)
      << outcome.out;
  for (const char* closed : {"s.lorica.json:body: warning", "s.lorica.json:liver: warning"}) {
    EXPECT_EQ(outcome.out.find(closed), std::string::npos) << outcome.out;
  }
}

TEST_F(Commands, WhatIsWrittenNeverReplacesWhatIsRead) {
  writeSample();
  const std::string before = read("s.lorica.json");
  expectOneClearLine(run("export s.lorica.json --pose rest --format glb --out s.lorica.json"),
                     {"s.lorica.json", "--out"});
  EXPECT_EQ(read("s.lorica.json"), before);
  ASSERT_EQ(run("export s.lorica.json --pose rest --format ply --out body.ply").code, 0);
  expectOneClearLine(run("import body.ply --out body.ply"), {"body.ply", "--out"});
}

TEST_F(Commands, ARunThatCannotWriteAllItsTablesWritesNone) {
  writeSample();
  fs::create_directories(folder_ / "out" / "provenance.json");
  expectOneClearLine(run("run s.lorica.json --quiet --out out --pose rest --trials 1 --shots 100"),
                     {"provenance.json"});
  EXPECT_FALSE(exists("out/summary.csv"));
  EXPECT_FALSE(exists("out/trials.csv"));
  EXPECT_FALSE(exists("out/deformation.csv"));
}

TEST_F(Commands, InterruptStopsWithinASecondAndLeavesAResultThatSaysItIsPartial) {
  writeSample();
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder_.c_str()) == 0) {
      execl(LORICA_CLI, LORICA_CLI, "run", "s.lorica.json", "--quiet", "--out", "out", "--pose", "rest", "--shots",
            "1000000", "--trials", "100000", nullptr);
    }
    _exit(127);
  }
  // The folder is made when everything is read and the shooting begins.
  for (int tenths = 0; tenths < 1200 && !exists("out"); ++tenths) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  std::this_thread::sleep_for(std::chrono::seconds(2));
  const auto start = std::chrono::steady_clock::now();
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_LT(seconds, 5.0) << "a second on a quiet machine, more under a sanitizer";
  EXPECT_EQ(nlohmann::json::parse(read("out/provenance.json"))["partial"], true);
  for (const char* table : {"summary.csv", "trials.csv", "deformation.csv", "contacts.csv", "room.csv"}) {
    std::istringstream lines(read(std::string("out/") + table));
    std::string line;
    ASSERT_TRUE(std::getline(lines, line)) << table;
    EXPECT_TRUE(line.ends_with(",partial")) << line;
    while (std::getline(lines, line)) {
      ASSERT_TRUE(line.ends_with(",yes")) << line;
    }
  }
}

TEST_F(Commands, ARunThatFailsLeavesNoFolderBehind) {
  auto study = nlohmann::json::parse(run("template sample").out);
  study["analyses"] = {{"gaps", {{"structures", {"gall_bladder"}}}}};
  write("s.lorica.json", study.dump());
  expectOneClearLine(run("run s.lorica.json --quiet --out made/out --pose rest --trials 1 --shots 100"),
                     {"gall_bladder"});
  EXPECT_FALSE(exists("made"));
  fs::create_directories(folder_ / "there");
  expectOneClearLine(run("run s.lorica.json --quiet --out there --pose rest --trials 1 --shots 100"), {"gall_bladder"});
  EXPECT_TRUE(exists("there"));
  EXPECT_TRUE(fs::is_empty(folder_ / "there"));
}

}  // namespace
}  // namespace lorica::test
