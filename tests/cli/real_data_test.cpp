#include "real_data.h"
#include "program.h"

namespace lorica::test {
namespace {

class RealData : public Program {
 protected:
  std::string quoted(const fs::path& path) const { return "'" + (realData() / path).string() + "'"; }
  std::string organFiles(const fs::path& folder) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(realData() / folder)) {
      files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::string list;
    for (const fs::path& file : files) {
      list += " '" + file.string() + "'";
    }
    return list;
  }
  /// Rows of one structure, as text after its name.
  std::vector<std::string> rowsOf(const std::string& table, const std::string& start) const {
    std::vector<std::string> rows;
    std::istringstream lines(read(table));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(start)) {
        rows.push_back(line);
      }
    }
    return rows;
  }
};

TEST_F(RealData, TheVisibleHumanRunsInEveryPoseWithBothSetsOfOrgans) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/body.glb");
  for (const std::string set : {"organs", "organs_closed"}) {
    const Outcome imported = run("import " + quoted("visible-human-male/body.glb") +
                                 organFiles("visible-human-male/" + set) + " --plates --out " + set + ".lorica.json");
    ASSERT_EQ(imported.code, 0) << imported.err;
    const Outcome ran = run("run " + set + ".lorica.json --quiet --out " + set +
                            " --trials 1 --shots 20000 --pose rest --pose toe_touch@2 --pose belly_twist@1");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(rowsOf(set + "/summary.csv", "front,armor,dynamic,rest,heart,").size(), 1U);
  }
  // Shots that meet the heart, whether it is one closed surface or fourteen open patches.
  const auto closed = rowsOf("organs_closed/trials.csv", "front,unarmored,static_joint,rest,1,heart,");
  ASSERT_EQ(closed.size(), 1U);
}

TEST_F(RealData, TheTacticalVestIsWornByBothRigsOfTheMakeHumanBody) {
  LORICA_NEEDS_REAL_DATA("makehuman-male/body.glb");
  for (const std::string body : {"body", "body_12"}) {
    const Outcome imported =
        run("import " + quoted("makehuman-male/" + body + ".glb") + " --armor " +
            quoted("makehuman-male/armor/tactical_vest_skinned.glb") + " --out " + body + ".lorica.json");
    ASSERT_EQ(imported.code, 0) << imported.err;
    EXPECT_EQ(imported.out.find("reaches into the body"), std::string::npos)
        << "not one vertex of the vest is inside the body";
    const Outcome ran = run("run " + body + ".lorica.json --quiet --out " + body +
                            " --trials 1 --shots 20000 --pose rest --pose toe_touch@1.5 --pose belly_twist@0.75");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(rowsOf(body + "/summary.csv", "front,armor,dynamic,rest,tactical_vest_skinned,armor,").size(), 1U);
  }
}

TEST_F(RealData, EveryOtherModelImportsAndEveryClipExports) {
  LORICA_NEEDS_REAL_DATA("cesium-man/cesium_man.gltf");
  const std::pair<std::string, std::vector<std::string>> models[] = {
      {"cesium-man/cesium_man.gltf", {"rest", "clip_0@0.5"}},
      {"makehuman-male/body_cmu.glb", {"walk@1", "jump@1", "jumps_full@5", "jumping_jacks@1"}},
      {"makehuman-male/body.glb",
       {"toe_touch@1.5", "belly_twist@0.75", "lateral_twist@0.75", "walk@1", "jump@1", "jumping_jacks@1"}},
      {"visible-human-male/body.glb",
       {"toe_touch@2", "belly_twist@1", "lateral_twist@3", "squat@1.75", "arm_raise@1.5", "walk@0.5"}},
      {"makehuman-male/body_rest.obj", {"rest"}},
      {"makehuman-male/clothes/worksuit.glb", {"rest"}},
      {"makehuman-male/clothes/shoes.obj", {"rest"}},
      {"makehuman-male/armor/tactical_vest.obj", {"rest"}},
      {"flight-helmet/FlightHelmet.gltf", {"rest"}}};
  for (const auto& [model, poses] : models) {
    const Outcome imported = run("import " + quoted(model) + " --out m.lorica.json");
    ASSERT_EQ(imported.code, 0) << model << ": " << imported.err;
    for (const std::string& pose : poses) {
      const Outcome exported = run("export m.lorica.json --pose " + pose + " --format glb --out m.glb");
      EXPECT_EQ(exported.code, 0) << model << ' ' << pose << ": " << exported.err;
    }
  }
}

}  // namespace
}  // namespace lorica::test
