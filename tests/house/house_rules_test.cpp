// The checks themselves, on small made-up sources: each finds its trespass and leaves the lawful neighbour alone.

#include "house_rules.h"

#include <gtest/gtest.h>

#include <fstream>

namespace lorica::house {
namespace {

/// "path:line" of every finding.
std::vector<std::string> places(const Findings& findings) {
  std::vector<std::string> all;
  for (const Finding& finding : findings) {
    all.push_back(finding.path + ":" + std::to_string(finding.line));
  }
  return all;
}

using Files = std::vector<SourceFile>;
using Places = std::vector<std::string>;

TEST(ModuleRules, UseOnlyModulesThatStandBeforeThem) {
  std::set<std::string> seen;
  for (const ModuleRule& rule : moduleRules()) {
    for (const std::string& used : rule.mayUse) {
      EXPECT_TRUE(seen.contains(used)) << rule.name << " uses " << used;
    }
    seen.insert(rule.name);
  }
}

TEST(ModuleRules, ReachThroughOtherModules) {
  EXPECT_EQ(reachable("base"), std::set<std::string>{"base"});
  EXPECT_EQ(reachable("parenting"), (std::set<std::string>{"base", "geometry", "human", "parenting", "raycast"}));
  EXPECT_FALSE(reachable("parenting").contains("io"));
  EXPECT_EQ(reachable("analysis").size(), moduleRules().size());
}

TEST(ModuleIncludes, FindADependencyThatPointsBack) {
  const Files files{
      {"core/human/src/skin.cpp", "#include \"lorica/geometry/mesh.h\"\n#include \"lorica/io/import.h\"\n"},
      {"core/io/src/gltf.cpp", "#include \"lorica/base/error.h\"\n#include \"lorica/human/clip.h\"\n"},
      {"core/raycast/include/lorica/raycast/scene.h", "#pragma once\n#  include <lorica/stats/philox.h>\n"},
      {"app/cli/main.cpp", "#include \"lorica/analysis/run.h\"\n"}};
  EXPECT_EQ(places(checkModuleIncludes(files)),
            (Places{"core/human/src/skin.cpp:2", "core/raycast/include/lorica/raycast/scene.h:2"}));
}

TEST(WidgetIncludes, FindADependencyThatPointsBack) {
  const Files files{
      {"widgets/document/src/a.cpp", "#include \"lorica/base/error.h\"\n#include \"lorica/panels/b.h\"\n"},
      {"widgets/panels/src/b.cpp", "#include \"lorica/document/a.h\"\n#include \"lorica/panels/b.h\"\n"},
      {"core/io/src/c.cpp", "#include \"lorica/document/a.h\"\n"},
      {"app/gui/d.cpp", "#include \"lorica/dialogs/e.h\"\n"}};
  EXPECT_EQ(places(checkWidgetIncludes(files)), (Places{"widgets/document/src/a.cpp:2", "core/io/src/c.cpp:1"}));
}

TEST(ModuleLinks, FindADependencyThatPointsBack) {
  const Files files{
      {"core/armor/CMakeLists.txt", "lorica_add_module(armor\n  PUBLIC lorica::parenting lorica::viscera)\n"},
      {"core/viscera/CMakeLists.txt", "lorica_add_module(viscera PUBLIC lorica::parenting)\n"}};
  EXPECT_EQ(places(checkModuleLinks(files)), Places{"core/armor/CMakeLists.txt:2"});
}

TEST(ModuleOrder, TakesAPartOfTheListInItsOrder) {
  EXPECT_TRUE(checkModuleOrder(Files{{"core/CMakeLists.txt", "foreach(module base geometry human)\n"}}).empty());
}

TEST(ModuleOrder, FindsSwappedDoubledUnknownAndForgottenModules) {
  const auto count = [](const std::string& text, const Files& more = {}) {
    Files files{{"core/CMakeLists.txt", text}};
    files.insert(files.end(), more.begin(), more.end());
    return checkModuleOrder(files).size();
  };
  EXPECT_EQ(count("foreach(module geometry base)\n"), 1U);
  EXPECT_EQ(count("foreach(module base base)\n"), 1U);
  EXPECT_EQ(count("foreach(module base kitchen)\n"), 1U);
  EXPECT_EQ(count("foreach(module base)\n", {{"core/io/src/a.cpp", ""}, {"core/io/src/b.cpp", ""}}), 1U);
  EXPECT_EQ(count("add_subdirectory(base)\n"), 1U);
}

TEST(ThirdParties, AreFoundOutsideTheirRooms) {
  const std::string embree = "#include <embree3/rtcore.h>\n";
  const std::string tinygltf = "#include <tiny_gltf.h>\n";
  const std::string json = "#include <nlohmann/json.hpp>\n";
  const std::string vtk = "#include <vtkPolyData.h>\n";
  const std::string mpi = "#include <mpi.h>\n";
  const std::string simplifier = "#include <meshoptimizer.h>\n";
  const std::string qt = "#include <QWidget>\n#include <QtCharts/QChart>\n";
  const Files lawful{{"core/raycast/src/embree.h", embree},       {"app/cli/bench/bare.cpp", embree + tinygltf},
                     {"tests/benchmarks/bare.cpp", embree},       {"core/io/src/gltf.cpp", tinygltf + json + vtk},
                     {"core/study/src/file.cpp", json},           {"app/mpi/main.cpp", mpi},
                     {"widgets/viewport/src/skin.cpp", vtk + qt}, {"core/geometry/src/iso.cpp", vtk},
                     {"tests/widgets/models_test.cpp", qt},       {"tests/cli/run_test.cpp", json},
                     {"widgets/viewport/src/few.cpp", simplifier}};
  EXPECT_EQ(lines(checkThirdParties(lawful)), "");
  const Files unlawful{{"core/raycast/include/lorica/raycast/scene.h", embree},
                       {"core/raycast/tests/x.cpp", embree},
                       {"core/human/src/a.cpp", tinygltf},
                       {"core/analysis/src/a.cpp", json},
                       {"core/shotline/src/a.cpp", vtk},
                       {"app/cli/main.cpp", mpi},
                       {"core/base/src/a.cpp", qt},
                       {"app/mpi/b.cpp", qt},
                       {"core/geometry/src/few.cpp", simplifier}};
  EXPECT_EQ(
      places(checkThirdParties(unlawful)),
      (Places{"core/raycast/include/lorica/raycast/scene.h:1", "core/raycast/tests/x.cpp:1", "core/human/src/a.cpp:1",
              "core/analysis/src/a.cpp:1", "core/shotline/src/a.cpp:1", "app/cli/main.cpp:1", "core/base/src/a.cpp:1",
              "core/base/src/a.cpp:2", "app/mpi/b.cpp:1", "app/mpi/b.cpp:2", "core/geometry/src/few.cpp:1"}));
}

TEST(PublicIncludes, AllowTheStandardLibraryEigenAndLorica) {
  const std::string header = "core/io/include/lorica/io/import.h";
  EXPECT_EQ(lines(checkPublicIncludes(
                Files{{header, "#include <vector>\n#include <Eigen/Core>\n#include \"lorica/base/issue.h\"\n"},
                      {"core/io/src/gltf.cpp", "#include <fmt/format.h>\n#include \"gltf.h\"\n"}})),
            "");
  EXPECT_EQ(places(checkPublicIncludes(Files{
                {header, "#include <fmt/format.h>\n#include <zip.h>\n#include \"src/gltf.h\"\n#include <map>\n"}})),
            (Places{header + ":1", header + ":2", header + ":3"}));
}

TEST(PragmaOnce, IsTheFirstLineOfAHeader) {
  EXPECT_EQ(places(checkPragmaOnce(Files{{"core/a.h", "#pragma once\n"},
                                         {"core/b.h", "// b\n#pragma once\n"},
                                         {"core/c.cpp", "int c;\n"},
                                         {"tests/d.h", ""}})),
            (Places{"core/b.h:1", "tests/d.h:1"}));
}

TEST(CoreIsSilent, FindsPrintingAndEnding) {
  const Files files{{"core/base/src/a.cpp",
                     "void f() { std::cout << 1; }\n"
                     "void g() { printf(\"x\"); }\n"
                     "void h() { if (bad) exit(1); }\n"
                     "void i() {\n"
                     "  std::abort();\n"
                     "  fprintf(stderr, \"x\");\n"
                     "}\n"}};
  EXPECT_EQ(places(checkCoreIsSilent(files)),
            (Places{"core/base/src/a.cpp:1", "core/base/src/a.cpp:2", "core/base/src/a.cpp:6", "core/base/src/a.cpp:3",
                    "core/base/src/a.cpp:5"}));
}

TEST(CoreIsSilent, LeavesFormattingMembersCommentsAndTextAlone) {
  const Files files{{"core/shotline/src/a.cpp",
                     "// exit(1) would be wrong, and so would std::cout\n"
                     "double exit() const;\n"
                     "double x = shot.exit();\n"
                     "const char* text = \"printf(; exit(\";\n"
                     "/* abort(); */ std::snprintf(buffer, 8, \"x\");\n"},
                    {"app/cli/main.cpp", "int main() { std::cout << 1; exit(0); }\n"}};
  EXPECT_EQ(lines(checkCoreIsSilent(files)), "");
}

TEST(Randomness, OfTheStandardLibraryIsFoundInCoreOnly) {
  const std::string use = "std::normal_distribution<double> d;\nstd::random_device r;\nint operand(int);\n";
  EXPECT_EQ(places(checkRandomness(Files{{"core/stats/src/a.cpp", use}, {"tests/stats/a_test.cpp", use}})),
            (Places{"core/stats/src/a.cpp:1", "core/stats/src/a.cpp:2"}));
}

TEST(Unfinished, IsFoundInEveryKindOfFile) {
  const std::string mark = std::string("TO") + "DO";
  EXPECT_EQ(places(checkUnfinished(Files{{"core/a.cpp", "\n// " + mark + ": later\n"},
                                         {"packaging/a.sh",
                                          "# FIX"
                                          "ME\n"},
                                         {"app/b.cpp", "int " + mark + "S = 0;\n"}})),
            (Places{"core/a.cpp:2", "packaging/a.sh:1"}));
}

TEST(MachinePlaces, FindFoldersAndMirrors) {
  const std::string slash = "/";
  EXPECT_EQ(places(checkMachinePlaces(Files{{"tests/a.cpp", "open(\"" + slash + "work/shared/x\");\n"},
                                            {"packaging/b.sh",
                                             "echo deb http://deb.debian"
                                             ".org/debian\n"},
                                            {"resources/c.md", "see ../work/notes and http://host/home\n"},
                                            {"app/d.cpp", slash + "home/me\n"}})),
            (Places{"tests/a.cpp:1", "packaging/b.sh:1", "app/d.cpp:1"}));
}

TEST(TopLevel, HoldsTheHouseDotfilesAndWhatGitIgnores) {
  const std::vector<std::string> lawful{".ci", ".git", "CMakeLists.txt", "app", "build", "build-asan", "core", "out"};
  EXPECT_EQ(lines(checkTopLevel(lawful)), "");
  const std::vector<std::string> unlawful{"core", "docs", "notes.txt"};
  EXPECT_EQ(checkTopLevel(unlawful).size(), 2U);
}

TEST(CodeOnly, KeepsCodeAndLinesAndBlanksTheRest) {
  EXPECT_EQ(codeOnly("int a = 1;  // one\nint b;"), "int a = 1;        \nint b;");
  EXPECT_EQ(codeOnly("a /* x\ny */ b"), "a     \n     b");
  EXPECT_EQ(codeOnly(R"(f("a\"b", 'c', 1'000, 'd'))"), R"(f("    ", ' ', 1'000, ' '))");
  EXPECT_EQ(codeOnly("R\"x(a\")\" // b\n)x\" + c"), std::string("R") + std::string(12, ' ') + "\n    + c");
}

TEST(Includes, AreReadWhereTheyAreCode) {
  const std::vector<Include> found =
      includes("// #include <no>\n#include <vector>\n/*\n#include <no>\n*/\n  # include \"lorica/base/error.h\"\n");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].header, "vector");
  EXPECT_EQ(found[0].line, 2U);
  EXPECT_TRUE(found[0].angled);
  EXPECT_EQ(found[1].header, "lorica/base/error.h");
  EXPECT_EQ(found[1].line, 6U);
}

TEST(ProjectFiles, LeaveBuildFoldersAndBinaryFilesOut) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "lorica_house";
  std::filesystem::remove_all(folder);
  for (const char* name : {"core/a.cpp", "build/b.cpp", "out/c.csv", ".git/d"}) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << "text\n";
  }
  std::ofstream(folder / "core/icon.png") << std::string("\x89PNG\0", 5);
  std::ofstream(folder / "README.md") << "text\n";
  std::vector<std::string> paths;
  for (const SourceFile& file : projectFiles(folder)) {
    paths.push_back(file.path);
  }
  EXPECT_EQ(paths, (Places{"README.md", "core/a.cpp"}));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace lorica::house
