// The rules of the house, held against the project's own files.

#include <gtest/gtest.h>

#include <algorithm>

#include "house_rules.h"

namespace lorica::house {
namespace {

const std::filesystem::path& project() {
  static const std::filesystem::path path = LORICA_SOURCE_DIR;
  return path;
}

const std::vector<SourceFile>& files() {
  static const std::vector<SourceFile> all = projectFiles(project());
  return all;
}

void expectNone(const Findings& findings) {
  EXPECT_TRUE(findings.empty()) << lines(findings);
}

TEST(House, ReadsTheProject) {
  EXPECT_GT(files().size(), 20U);
  const auto has = [](const std::string& path) {
    return std::any_of(files().begin(), files().end(), [&](const SourceFile& f) { return f.path == path; });
  };
  EXPECT_TRUE(has("core/base/include/lorica/base/error.h"));
  EXPECT_TRUE(has("tests/house/house_rules.cpp"));
  EXPECT_TRUE(has("CMakeLists.txt"));
}

TEST(House, ModulesIncludeOnlyWhatTheyMayUse) {
  expectNone(checkModuleIncludes(files()));
}

TEST(House, ModulesOfTheWindowIncludeOnlyWhatStandsBeforeThem) {
  expectNone(checkWidgetIncludes(files()));
}

TEST(House, ModulesLinkOnlyWhatTheyMayUse) {
  expectNone(checkModuleLinks(files()));
}

TEST(House, ModulesAreListedInTheOrderInWhichDataWalksDown) {
  expectNone(checkModuleOrder(files()));
}

TEST(House, ThirdPartiesStayInTheirRooms) {
  expectNone(checkThirdParties(files()));
}

TEST(House, PublicHeadersOfCoreShowNoThirdPartyButEigen) {
  expectNone(checkPublicIncludes(files()));
}

TEST(House, HeadersBeginWithPragmaOnce) {
  expectNone(checkPragmaOnce(files()));
}

TEST(House, CoreNeitherPrintsNorEndsTheProgram) {
  expectNone(checkCoreIsSilent(files()));
}

TEST(House, CoreTakesNoRandomnessFromTheStandardLibrary) {
  expectNone(checkRandomness(files()));
}

TEST(House, NothingIsMarkedAsUnfinished) {
  expectNone(checkUnfinished(files()));
}

TEST(House, NothingNamesAFolderOfOneMachineOrAPackageMirror) {
  expectNone(checkMachinePlaces(files()));
}

TEST(House, TheTopLevelHoldsOnlyTheHouse) {
  expectNone(checkTopLevel(topLevelEntries(project())));
}

}  // namespace
}  // namespace lorica::house
