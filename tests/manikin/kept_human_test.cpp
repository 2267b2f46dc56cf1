#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "lorica/base/files.h"
#include "same_human.h"

namespace lorica::manikin {
namespace {

using test::expectSame;

const Human& someone() {
  static const Human human = makeHuman({human::Sex::female, 1.66, 61.0}, {});
  return human;
}

TEST(KeptHuman, IsMadeAnewWhenWhatWasKeptIsDamaged) {
  std::string pattern = std::filesystem::temp_directory_path() / "lorica-human-XXXXXX";
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const std::filesystem::path folder = pattern;
  ASSERT_EQ(setenv("LORICA_CACHE", folder.c_str(), 1), 0);
  EXPECT_FALSE(humanIfKept(someone().body.person).has_value());
  const Human first = keptHuman(someone().body.person, {});
  expectSame(first, someone());
  std::filesystem::path file;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    file = entry.path();
  }
  ASSERT_FALSE(file.empty());
  const std::optional<Human> again = humanIfKept(someone().body.person);
  ASSERT_TRUE(again.has_value());
  expectSame(*again, someone());
  const std::string kept = base::readFile(file);
  base::writeFileAtomically(file, kept.substr(0, 1000));
  expectSame(keptHuman(someone().body.person, {}), someone());
  EXPECT_EQ(base::readFile(file), kept);
  // A folder that is a file keeps nothing and hinders nothing.
  ASSERT_EQ(setenv("LORICA_CACHE", file.c_str(), 1), 0);
  expectSame(keptHuman(someone().body.person, {}), someone());
  unsetenv("LORICA_CACHE");
  std::filesystem::remove_all(folder);
}

TEST(MedianMan, InTheProgramIsTheOneThatIsMade) {
  expectSame(keptHuman({}, {}), makeHuman({}, {3}));
}

}  // namespace
}  // namespace lorica::manikin
