#include "lorica/manikin/human.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "lorica/base/error.h"
#include "lorica/base/files.h"

namespace lorica::manikin {
namespace {

const Human& someone() {
  static const Human human = makeHuman({human::Sex::female, 1.66, 61.0}, {});
  return human;
}

void expectSame(const Human& a, const Human& b) {
  EXPECT_EQ(a.body.person, b.body.person);
  EXPECT_TRUE(a.body.skin.positions == b.body.skin.positions);
  EXPECT_TRUE(a.body.skin.triangles == b.body.skin.triangles);
  EXPECT_TRUE(a.body.weights.weights == b.body.weights.weights);
  ASSERT_EQ(a.body.skeleton.size(), b.body.skeleton.size());
  ASSERT_EQ(a.organs.size(), b.organs.size());
  for (std::size_t o = 0; o < a.organs.size(); ++o) {
    EXPECT_EQ(a.organs[o].name, b.organs[o].name);
    EXPECT_TRUE(a.organs[o].mesh.positions == b.organs[o].mesh.positions) << a.organs[o].name;
  }
  ASSERT_EQ(a.systems.size(), b.systems.size());
  for (std::size_t s = 0; s < a.systems.size(); ++s) {
    ASSERT_EQ(a.systems[s].pieces.size(), b.systems[s].pieces.size());
    for (std::size_t p = 0; p < a.systems[s].pieces.size(); ++p) {
      EXPECT_TRUE(a.systems[s].pieces[p].mesh.positions == b.systems[s].pieces[p].mesh.positions);
      EXPECT_EQ(a.systems[s].pieces[p].protecting, b.systems[s].pieces[p].protecting);
      EXPECT_EQ(a.systems[s].pieces[p].carriedAt, b.systems[s].pieces[p].carriedAt);
    }
  }
  ASSERT_EQ(a.clips.size(), b.clips.size());
  EXPECT_EQ(humanBytes(a), humanBytes(b));
}

TEST(Human, IsKeptAndReadBackTheSame) {
  const std::string bytes = humanBytes(someone());
  expectSame(readHuman(bytes, "kept"), someone());
}

TEST(Human, ThatIsDamagedIsRefused) {
  const std::string bytes = humanBytes(someone());
  EXPECT_THROW((void)readHuman("", "kept"), base::InputError);
  EXPECT_THROW((void)readHuman("LORICAHU", "kept"), base::InputError);
  for (const std::size_t cut : {std::size_t{9}, std::size_t{19}, std::size_t{25}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_THROW((void)readHuman(std::string_view(bytes).substr(0, cut), "kept"), base::InputError) << cut;
  }
  for (const std::size_t place : {std::size_t{0}, std::size_t{8}, std::size_t{14}, std::size_t{40}, bytes.size() / 3}) {
    std::string bent = bytes;
    bent[place] = static_cast<char>(bent[place] ^ 0x41);
    EXPECT_THROW((void)readHuman(bent, "kept"), base::InputError) << place;
  }
  EXPECT_THROW((void)readHuman(bytes + "x", "kept"), base::InputError);
}

TEST(Human, IsThereAtOnceWhenItIsTheMedianMan) {
  const std::optional<Human> human = humanIfKept({});
  ASSERT_TRUE(human.has_value());
  EXPECT_EQ(human->body.person, human::Person());
}

TEST(Human, IsMadeAnewWhenWhatWasKeptIsDamaged) {
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

}  // namespace
}  // namespace lorica::manikin
