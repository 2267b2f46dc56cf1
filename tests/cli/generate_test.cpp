#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "lorica/io/import.h"
#include "program.h"

namespace lorica::test {
namespace {

using Json = nlohmann::json;

class Generate : public Program {
 protected:
  // Nothing of these tests is kept for other runs of the program, nor taken from them.
  Generate() { setenv("LORICA_CACHE", (folder_ / "cache").c_str(), 1); }
  ~Generate() override { unsetenv("LORICA_CACHE"); }

  std::map<std::string, std::string> filesBelow(const std::string& name) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name)) {
      if (entry.is_regular_file()) {
        files[fs::relative(entry.path(), folder_ / name).generic_string()] = contents(entry.path());
      }
    }
    return files;
  }

  void holdsTheWholeHuman() const;
  void saysWhatWasMeasured() const;
  void becomesAStudyThatRuns() const;
};

void Generate::holdsTheWholeHuman() const {
  const io::Model body = io::importModel(folder_ / "her" / "body.glb");
  ASSERT_EQ(body.parts.size(), 1U);
  ASSERT_TRUE(body.skeleton && body.parts[0].weights);
  EXPECT_TRUE(body.issues.empty()) << body.issues.front().line();
  EXPECT_EQ(body.skeleton->size(), 55U);
  std::set<std::string> clips;
  for (const human::Clip& clip : body.clips) {
    clips.insert(clip.name);
  }
  EXPECT_EQ(clips, (std::set<std::string>{"toe_touch", "belly_twist", "lateral_twist", "squat", "kneel_aim",
                                          "prone_aim", "arm_raise", "walk", "sit"}));
  for (const char* organ : {"heart", "lung_left", "lung_right", "liver", "stomach", "kidney_left", "kidney_right",
                            "spleen", "pancreas", "small_intestine", "large_intestine", "trachea", "bladder", "brain",
                            "spinal_cord", "thyroid", "eyes", "arteries", "veins"}) {
    EXPECT_TRUE(exists(std::string("her/organs/") + organ + ".glb")) << organ;
  }
  const io::Model vest = io::importModel(folder_ / "her" / "armor" / "full_torso" / "vest_front.glb");
  ASSERT_TRUE(vest.parts.at(0).weights && vest.skeleton);
  EXPECT_EQ(vest.skeleton->size(), body.skeleton->size());
  EXPECT_FALSE(io::importModel(folder_ / "her" / "armor" / "helmet" / "helmet.glb").parts.at(0).weights);
}

/// Decimals of the number with most of them, in the text of a JSON value.
std::size_t mostDecimals(const Json& value) {
  std::size_t most = 0;
  if (value.is_structured()) {
    for (const Json& below : value) {
      most = std::max(most, mostDecimals(below));
    }
  } else if (value.is_number_float()) {
    const std::string text = value.dump();
    EXPECT_EQ(text.find('e'), std::string::npos) << text;
    most = text.size() - 1 - std::min(text.find('.'), text.size() - 1);
  }
  return most;
}

void Generate::saysWhatWasMeasured() const {
  const Json facts = Json::parse(read("her/facts.json"));
  EXPECT_EQ(facts["person"], (Json{{"sex", "female"}, {"stature_m", 1.6}, {"mass_kg", 58.0}}));
  EXPECT_LE(mostDecimals(facts), 6U) << "more than the quantities support";
  EXPECT_EQ(facts["mass"]["target_kg"], 58.0);
  for (const Json& dimension : facts["dimensions"]) {
    const double off = dimension["measured_m"].get<double>() / dimension["target_m"].get<double>() - 1.0;
    EXPECT_LT(std::abs(off), 0.06) << dimension["name"];
    EXPECT_NEAR(dimension["difference_pct"].get<double>(), 100.0 * off, 0.1) << dimension["name"];
    EXPECT_FALSE(dimension["source"].get<std::string>().empty());
  }
  const Json& mass = facts["mass"];
  EXPECT_NEAR(
      mass["measured_kg"].get<double>(),
      (mass["volume_m3"].get<double>() - mass["lung_air_m3"].get<double>()) * mass["density_kg_m3"].get<double>(),
      0.01);
  EXPECT_NEAR(mass["measured_kg"].get<double>() / 58.0, 1.0, 0.03);
  EXPECT_EQ(facts["organs"].size(), 19U);
  std::size_t files = 2 + facts["organs"].size();
  for (const Json& organ : facts["organs"]) {
    EXPECT_TRUE(exists("her/" + organ["file"].get<std::string>()));
    if (!organ["target_cm3"].is_null()) {
      EXPECT_NEAR(organ["volume_cm3"].get<double>() / organ["target_cm3"].get<double>(), 1.0, 0.02) << organ["name"];
    }
  }
  for (const Json& system : facts["armor"]) {
    double sum = 0.0;
    for (const Json& piece : system["pieces"]) {
      EXPECT_TRUE(exists("her/" + piece["file"].get<std::string>()));
      sum += piece["mass_kg"].get<double>();
      ++files;
    }
    EXPECT_NEAR(system["mass_kg"].get<double>(), sum, 0.01) << system["system"];
  }
  EXPECT_EQ(files, filesBelow("her").size());
}

void Generate::becomesAStudyThatRuns() const {
  const Outcome imported = run(
      "import her/body.glb her/organs/*.glb --system full_torso --armor her/armor/full_torso --system plate_carrier "
      "--armor her/armor/plate_carrier --out her.lorica.json");
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_EQ(imported.out.find("warning"), std::string::npos) << imported.out;
  EXPECT_EQ(imported.out.find("error"), std::string::npos) << imported.out;
  const Json study = Json::parse(read("her.lorica.json"));
  EXPECT_EQ(study["organs"].size(), 19U);
  ASSERT_EQ(study["armor"].size(), 2U);
  std::set<std::string> carrier;
  for (const Json& piece : study["armor"][1]["pieces"]) {
    carrier.insert(piece["name"].get<std::string>());
  }
  EXPECT_EQ(carrier.size(), 2U) << "only the plates of a plate carrier protect";
  const Outcome checked = run("check her.lorica.json");
  EXPECT_EQ(checked.code, 0) << checked.out;
  EXPECT_EQ(checked.out.find("warning"), std::string::npos) << checked.out;
  const Outcome shot = run("run her.lorica.json --quiet --out out --pose toe_touch@2 --trials 1 --shots 2000");
  EXPECT_EQ(shot.code, 0) << shot.err;
  EXPECT_EQ(shot.err, "");
  EXPECT_NE(read("out/summary.csv").find("full_torso,dynamic,toe_touch@2,heart"), std::string::npos);
}

// One test for all of it: a human takes some ten seconds to make.
TEST_F(Generate, WritesAHumanThatOtherCommandsTake) {
  const Outcome outcome = run("generate human --sex female --stature 1.6000000001 --mass 58.0000000001 --out her");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  holdsTheWholeHuman();
  saysWhatWasMeasured();
  becomesAStudyThatRuns();
  ASSERT_EQ(run("generate human --sex female --stature 1.6000000001 --mass 58.0000000001 --out again").code, 0);
  EXPECT_EQ(filesBelow("again"), filesBelow("her"));
}

TEST_F(Generate, WrongUsageIsOneLineThatNamesTheLimits) {
  const std::map<std::string, std::string> cases{
      {"generate", "subcommand"},
      {"generate human --out x", "--sex"},
      {"generate human --sex man --out x", "male"},
      {"generate human --sex male", "--out"},
      {"generate human --sex male --stature 1.755 --out x", "--mass"},
      {"generate human --sex male --mass 81 --out x", "--stature"},
      {"generate human --sex male --stature 175.5 --mass 81 --out x", "1.40 to 2.10 m"},
      {"generate human --sex male --stature nan --mass 81 --out x", "--stature"},
      {"generate human --sex male --stature 1.8 --mass 20 --out x", "59 to 145 kg"},
      {"generate human --sex male --stature 1.8 --mass 80 --percentile 5 --out x", "--percentile"},
      {"generate human --sex male --percentile 0 --out x", "0.1 to 99.9"},
      {"generate human --sex male --percentile nan --out x", "0.1 to 99.9"},
  };
  for (const auto& [arguments, word] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << arguments << ": " << outcome.err;
  }
  EXPECT_EQ(files(), 0U) << "nothing is written";
}

TEST_F(Generate, AFolderThatCannotBeWrittenIsSaidBeforeTheWork) {
  write("file", "");
  const auto start = std::chrono::steady_clock::now();
  expectOneClearLine(run("generate human --sex male --out file/below"), {"file/below", "cannot be written"});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_EQ(files(), 1U);
}

TEST_F(Generate, InterruptLeavesNothing) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder_.c_str()) == 0 && std::freopen("/dev/null", "w", stderr) != nullptr) {
      execl(LORICA_CLI, LORICA_CLI, "generate", "human", "--sex", "male", "--out", "far/out", nullptr);
    }
    _exit(127);
  }
  for (int tenths = 0; tenths < 300 && !exists("far/out"); ++tenths) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const auto start = std::chrono::steady_clock::now();
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_LT(seconds, 5.0) << "a second on a quiet machine, more under a sanitizer";
  EXPECT_EQ(files(), 0U);
}

}  // namespace
}  // namespace lorica::test
