#include "lorica/io/role_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "lorica/base/error.h"
#include "lorica/base/files.h"

namespace lorica::io {
namespace {

/// pelvis, spine and on both sides arm and leg of three joints: "arm0_L" to "arm2_L", "leg0_L" to "leg2_L".
human::Skeleton skeleton() {
  std::vector<human::Joint> joints{{"pelvis", std::nullopt, {}}, {"spine", human::JointIndex{0}, {}}};
  for (const char* side : {"_L", "_R"}) {
    for (const char* limb : {"arm", "leg"}) {
      std::size_t parent = limb[0] == 'a' ? 1 : 0;
      for (int i = 0; i < 3; ++i) {
        joints.push_back({limb + std::to_string(i) + side, human::JointIndex{parent}, {}});
        parent = joints.size() - 1;
      }
    }
  }
  return human::Skeleton(joints);
}

const std::string kGood = R"({
  "pelvis": "pelvis", "lumbar": ["spine"],
  "shoulder_left": "arm0_L", "elbow_left": "arm1_L", "wrist_left": "arm2_L",
  "hip_left": "leg0_L", "knee_left": "leg1_L", "ankle_left": "leg2_L",
  "shoulder_right": "arm0_R", "elbow_right": "arm1_R", "wrist_right": "arm2_R",
  "hip_right": "leg0_R", "knee_right": "leg1_R", "ankle_right": "leg2_R"
})";

class RoleFile : public testing::Test {
 protected:
  RoleFile()
      : path_(
            std::filesystem::path(testing::TempDir()) /
            (std::string("lorica_roles_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".json")) {}
  ~RoleFile() override { std::filesystem::remove(path_); }

  human::RoleMap read(const std::string& text) {
    base::writeFileAtomically(path_, text);
    return readRoleFile(path_, skeleton());
  }
  /// "place: text" of the error, "none" without one.
  std::string errorOf(const std::string& text) {
    try {
      read(text);
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.file(), path_.string());
      return error.place() + ": " + error.text();
    }
    return "none";
  }
  static std::string with(const std::string& from, const std::string& to) {
    std::string text = kGood;
    return text.replace(text.find(from), from.size(), to);
  }

 private:
  std::filesystem::path path_;
};

TEST_F(RoleFile, GivesEveryRoleItsJoint) {
  const human::RoleMap roles = read(kGood);
  EXPECT_EQ(roles.joint(human::Role::wrist, human::Side::right), skeleton().find("arm2_R"));
  EXPECT_EQ(roles.joint(human::Role::lumbar), skeleton().find("spine"));
  EXPECT_FALSE(roles.joint(human::Role::head));
}

TEST_F(RoleFile, NamesFilePlaceAndTroubleInOneSentence) {
  EXPECT_EQ(errorOf(with("\"arm0_L\"", "\"arm9_L\"")), "/shoulder_left: the skeleton has no joint \"arm9_L\"");
  EXPECT_EQ(errorOf(with("\"arm0_L\"", "7")), "/shoulder_left: expected a joint's name or a list of names");
  EXPECT_EQ(errorOf(with("[\"spine\"]", "[]")),
            "/lumbar: expected at least one joint; leave the role out where there is none");
  EXPECT_EQ(errorOf(with("\"leg1_L\"", "\"leg0_L\"")), "/knee_left: joint \"leg0_L\" already plays hip_left");
  EXPECT_EQ(errorOf(with("\"pelvis\": \"pelvis\", ", "")),
            "/pelvis: this role is necessary, but no joint is given for it");
  EXPECT_EQ(errorOf(with("\"ankle_left\"", "\"knee_left\"")), "/knee_left: this role is named twice");
  EXPECT_EQ(errorOf(with("\"pelvis\":", "\"tail\":")).substr(0, 26), "/tail: this is no role; kn");
  EXPECT_EQ(errorOf("[]"), "/: expected an object of roles and joint names");
}

TEST_F(RoleFile, NamesTheLineThatIsNoJson) {
  EXPECT_EQ(errorOf("{\n  \"pelvis\": pelvis\n}"),
            "line 2, column 13: this is no JSON; expected an object of roles and joint names");
  EXPECT_EQ(errorOf(""), "line 1, column 1: this is no JSON; expected an object of roles and joint names");
}

TEST_F(RoleFile, ThatIsMissingIsSaid) {
  EXPECT_THROW(readRoleFile("/nowhere/roles.json", skeleton()), base::InputError);
}

}  // namespace
}  // namespace lorica::io
