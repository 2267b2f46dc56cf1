#include "lorica/human/joint_roles.h"

#include <gtest/gtest.h>

#include "humanoid.h"
#include "lorica/base/error.h"

namespace lorica::human {
namespace {

using test::builtIn;
using test::humanoid;
using test::RigNames;
using test::sided;

struct Family {
  const char* name;
  RigNames names;
};

std::ostream& operator<<(std::ostream& out, const Family& family) {
  return out << family.name;
}

class RoleSpellings : public testing::TestWithParam<Family> {};

TEST_P(RoleSpellings, GiveEveryJointItsRole) {
  const RigNames& names = GetParam().names;
  const Skeleton skeleton = humanoid(names);
  const RoleMap roles = findRoles(skeleton);
  const auto nameOf = [&](Role role, Side side) {
    const auto joint = roles.joint(role, side);
    return joint ? skeleton.joint(*joint).name : std::string("none");
  };
  EXPECT_EQ(nameOf(Role::pelvis, Side::middle), names.pelvis);
  EXPECT_EQ(nameOf(Role::lumbar, Side::middle), names.spine);
  ASSERT_EQ(roles.joints(Role::thoracic).size(), 2U);
  EXPECT_EQ(skeleton.joint(roles.joints(Role::thoracic)[0]).name, names.chest);
  EXPECT_EQ(skeleton.joint(roles.joints(Role::thoracic)[1]).name, names.upperChest);
  EXPECT_EQ(nameOf(Role::neck, Side::middle), names.neck);
  EXPECT_EQ(nameOf(Role::head, Side::middle), names.head);
  for (const Side side : {Side::left, Side::right}) {
    const std::string& word = side == Side::left ? names.left : names.right;
    EXPECT_EQ(nameOf(Role::clavicle, side), sided(names.clavicle, word));
    EXPECT_EQ(nameOf(Role::shoulder, side), sided(names.shoulder, word));
    EXPECT_EQ(nameOf(Role::elbow, side), sided(names.elbow, word));
    EXPECT_EQ(nameOf(Role::wrist, side), sided(names.wrist, word));
    EXPECT_EQ(nameOf(Role::hip, side), sided(names.hip, word));
    EXPECT_EQ(nameOf(Role::knee, side), sided(names.knee, word));
    EXPECT_EQ(nameOf(Role::ankle, side), sided(names.ankle, word));
    EXPECT_EQ(nameOf(Role::toe, side), sided(names.toe, word));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rigs, RoleSpellings,
    testing::Values(
        Family{"builtin", builtIn()},
        Family{"vrm",
               {"hips", "spine", "chest", "upperChest", "neck", "head", "{}Shoulder", "{}UpperArm", "{}LowerArm",
                "{}Hand", "{}UpperLeg", "{}LowerLeg", "{}Foot", "{}Toes"}},
        Family{"vroid",
               {"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest", "J_Bip_C_Neck", "J_Bip_C_Head",
                "J_Bip_{}_Shoulder", "J_Bip_{}_UpperArm", "J_Bip_{}_LowerArm", "J_Bip_{}_Hand", "J_Bip_{}_UpperLeg",
                "J_Bip_{}_LowerLeg", "J_Bip_{}_Foot", "J_Bip_{}_ToeBase", "L", "R"}},
        Family{"mixamo",
               {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2", "mixamorig:Neck",
                "mixamorig:Head", "mixamorig:{}Shoulder", "mixamorig:{}Arm", "mixamorig:{}ForeArm", "mixamorig:{}Hand",
                "mixamorig:{}UpLeg", "mixamorig:{}Leg", "mixamorig:{}Foot", "mixamorig:{}ToeBase", "Left", "Right"}},
        Family{"makehuman",
               {"root", "spine04", "spine02", "spine01", "neck01", "head", "clavicle.{}", "upperarm01.{}",
                "lowerarm01.{}", "wrist.{}", "upperleg01.{}", "lowerleg01.{}", "foot.{}", "toe1-1.{}", "L", "R"}},
        Family{"rigify",
               {"DEF-spine", "DEF-spine.001", "DEF-spine.002", "DEF-spine.003", "DEF-spine.004", "DEF-spine.006",
                "DEF-shoulder.{}", "DEF-upper_arm.{}", "DEF-forearm.{}", "DEF-hand.{}", "DEF-thigh.{}", "DEF-shin.{}",
                "DEF-foot.{}", "DEF-toe.{}", "L", "R"}},
        Family{"unity",
               {"Hips", "Spine", "Chest", "UpperChest", "Neck", "Head", "Shoulder.{}", "UpperArm.{}", "LowerArm.{}",
                "Hand.{}", "UpperLeg.{}", "LowerLeg.{}", "Foot.{}", "Toes.{}", "L", "R"}},
        Family{"unreal",
               {"pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head", "clavicle_{}", "upperarm_{}",
                "lowerarm_{}", "hand_{}", "thigh_{}", "calf_{}", "foot_{}", "ball_{}", "l", "r"}},
        Family{"biped",
               {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Spine2", "Bip01 Neck", "Bip01 Head",
                "Bip01 {} Clavicle", "Bip01 {} UpperArm", "Bip01 {} Forearm", "Bip01 {} Hand", "Bip01 {} Thigh",
                "Bip01 {} Calf", "Bip01 {} Foot", "Bip01 {} Toe0", "L", "R"}},
        Family{"cmu",
               {"Hips", "LowerBack", "Spine", "Spine1", "Neck", "Head", "{}Shoulder", "{}Arm", "{}ForeArm", "{}Hand",
                "{}UpLeg", "{}Leg", "{}Foot", "{}ToeBase", "Left", "Right"}},
        Family{"bvh",
               {"Hips", "Chest", "Chest2", "Chest3", "Neck", "Head", "{}Collar", "{}Shoulder", "{}Elbow", "{}Wrist",
                "{}Hip", "{}Knee", "{}Ankle", "{}Toe", "Left", "Right"}}),
    [](const auto& family) { return family.param.name; });

TEST(FindRoles, NamesEveryMissingRoleAndTheWayOut) {
  RigNames names = builtIn();
  names.wrist = "a_{}";
  names.knee = "b_{}";
  try {
    findRoles(humanoid(names));
    FAIL();
  } catch (const base::InputError& error) {
    const std::string text = error.text();
    for (const char* expected : {"wrist_left", "wrist_right", "knee_left", "knee_right", "joint_roles"}) {
      EXPECT_NE(text.find(expected), std::string::npos) << text;
    }
    EXPECT_EQ(text.find("elbow"), std::string::npos) << text;
  }
}

TEST(FindRoles, IsContentWithoutWhatIsNotNecessary) {
  RigNames names = builtIn();
  names.clavicle = "a_{}";
  names.toe = "b_{}";
  names.neck = "c";
  names.head = "d";
  const RoleMap roles = findRoles(humanoid(names));
  EXPECT_TRUE(roles.joints(Role::clavicle, Side::left).empty());
  EXPECT_TRUE(roles.joints(Role::toe, Side::right).empty());
  EXPECT_FALSE(roles.joint(Role::head));
}

std::vector<RoleEntry> mapping() {
  std::vector<RoleEntry> entries{{"pelvis", {"pelvis_root"}},
                                 {"lumbar", {"spine_L3L4"}},
                                 {"thoracic", {"spine_T2T3", "spine_T10T11"}},
                                 {"head", {"head_C0C1"}}};
  for (const auto& [side, letter] : {std::pair{"left", "L"}, {"right", "R"}}) {
    for (const auto& [role, joint] : {std::pair{"shoulder", "glenohumeral"},
                                      {"elbow", "elbow"},
                                      {"wrist", "wrist"},
                                      {"hip", "hip"},
                                      {"knee", "knee"},
                                      {"ankle", "ankle"}}) {
      entries.push_back({std::string(role) + "_" + side, {std::string(joint) + "_" + letter}});
    }
  }
  return entries;
}

/// The error of a mapping: "place: text".
std::string errorOf(const std::vector<RoleEntry>& entries) {
  try {
    rolesFromNames(humanoid(builtIn()), entries);
  } catch (const base::InputError& error) {
    return error.place() + ": " + error.text();
  }
  return "none";
}

TEST(RolesFromNames, PutsTheJointsOfARoleInTheSkeletonsOrder) {
  const Skeleton skeleton = humanoid(builtIn());
  const RoleMap roles = rolesFromNames(skeleton, mapping());
  ASSERT_EQ(roles.joints(Role::thoracic).size(), 2U);
  EXPECT_EQ(skeleton.joint(roles.joints(Role::thoracic)[0]).name, "spine_T10T11");
  EXPECT_EQ(skeleton.joint(*roles.joint(Role::knee, Side::right)).name, "knee_R");
  EXPECT_FALSE(roles.joint(Role::neck));
}

TEST(RolesFromNames, SaysWhatIsWrongInOneSentence) {
  std::vector<RoleEntry> entries = mapping();
  entries.push_back({"tail", {"toe_MTP_L"}});
  EXPECT_EQ(errorOf(entries).find("tail: this is no role; known are pelvis"), 0U) << errorOf(entries);

  entries = mapping();
  entries[0].joints = {"pelvis_boot"};
  EXPECT_EQ(errorOf(entries), "pelvis: the skeleton has no joint \"pelvis_boot\"");

  entries = mapping();
  entries.push_back({"neck", {"head_C0C1"}});
  EXPECT_EQ(errorOf(entries), "neck: joint \"head_C0C1\" already plays head");

  entries = mapping();
  entries.push_back({"head", {"spine_C7T1"}});
  EXPECT_EQ(errorOf(entries), "head: this role is named twice");

  entries = mapping();
  entries.pop_back();
  EXPECT_EQ(errorOf(entries), "ankle_right: this role is necessary, but no joint is given for it");

  entries = mapping();
  entries.erase(entries.begin() + 1, entries.begin() + 3);
  EXPECT_EQ(errorOf(entries), "lumbar: this role is necessary, but no joint is given for it");

  entries = mapping();
  std::swap(entries[5].joints, entries[6].joints);
  EXPECT_EQ(errorOf(entries), "wrist_left: joint \"elbow_L\" does not hang below \"wrist_L\", the joint of elbow_left");
}

TEST(RoleNames, AreSidedWhereTheBodyIs) {
  EXPECT_EQ(roleName(Role::pelvis, Side::middle), "pelvis");
  EXPECT_EQ(roleName(Role::forearmTwist, Side::left), "forearm_twist_left");
  EXPECT_EQ(roleName(Role::toe, Side::right), "toe_right");
  EXPECT_FALSE(isSided(Role::head));
  EXPECT_TRUE(isSided(Role::clavicle));
}

}  // namespace
}  // namespace lorica::human
