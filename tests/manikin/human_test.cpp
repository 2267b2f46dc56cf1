#include "lorica/manikin/human.h"

#include <gtest/gtest.h>

#include "lorica/base/error.h"
#include "same_human.h"

namespace lorica::manikin {
namespace {

const Human& someone() {
  static const Human human = keptHuman({}, {});
  return human;
}

TEST(Human, IsKeptAndReadBackTheSame) {
  const std::string bytes = humanBytes(someone());
  test::expectSame(readHuman(bytes, "kept"), someone());
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

}  // namespace
}  // namespace lorica::manikin
