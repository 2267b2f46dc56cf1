#include <gtest/gtest.h>

#include <cmath>

#include "lorica/base/error.h"
#include "lorica/io/import.h"
#include "lorica/io/role_file.h"
#include "real_data.h"
#include "rigs.h"

namespace lorica::manikin {
namespace {

using human::Role;
using human::Side;
using test::Actor;
using test::Vec3d;

constexpr std::array<Side, 2> kSides{Side::left, Side::right};

/// What every rig must do, lengths as shares of its stature.
void expectTasks(const Actor& who) {
  const double size = who.stature();
  const double floor = who.floor();
  const Vec3d left = who.frames().facing() * Vec3d::UnitX();
  const Vec3d forward = who.frames().facing() * Vec3d::UnitZ();
  for (const human::Clip& clip : who.clips()) {
    for (const human::Channel& channel : clip.channels) {
      for (const auto& value : channel.values) {
        ASSERT_TRUE(value.allFinite()) << clip.name;
      }
    }
    if (clip.name != "walk") {
      const auto start = who.positions(who.pose(clip.name, 0.0));
      for (std::size_t j = 0; j < start.size(); ++j) {
        EXPECT_LT((start[j] - who.skeleton().restPosition(human::JointIndex{j})).norm(), 1e-4 * size) << clip.name;
      }
    }
  }
  for (const Side side : kSides) {
    const double out = side == Side::left ? 1.0 : -1.0;
    const auto height = [&](const char* clip, Role role) { return (who.at(clip, 0.5, role, side).y() - floor) / size; };
    EXPECT_LT((who.at("squat", 0.5, Role::ankle, side) - who.atRest(Role::ankle, side)).norm(), 2e-3 * size);
    EXPECT_NEAR(who.angles("squat", 0.5, Role::knee, side).flexion, 110.0, 3.0);
    EXPECT_NEAR(height("squat", Role::hip), height("squat", Role::knee), 0.02);
    EXPECT_NEAR((who.fingertip("toe_touch", 0.5, side, size).y() - floor) / size, 0.012, 0.02);
    EXPECT_GT(height("arm_raise", Role::wrist), 1.0);
    EXPECT_NEAR(height("sit", Role::hip), height("sit", Role::knee), 0.03);
    EXPECT_LT(height("prone_aim", Role::shoulder), 0.17);
    EXPECT_NEAR(height("prone_aim", Role::knee), 0.031, 0.012);
    EXPECT_LT(height("prone_aim", Role::elbow), 0.06);
    EXPECT_GT(out * left.dot(who.at("arm_raise", 0.5, Role::wrist, side) - who.atRest(Role::pelvis)), 0.0);
  }
  EXPECT_NEAR((who.at("kneel_aim", 0.5, Role::knee, Side::right).y() - floor) / size, 0.031, 0.008);
  EXPECT_GT(forward.dot(who.at("kneel_aim", 0.5, Role::wrist, Side::left) -
                        who.at("kneel_aim", 0.5, Role::shoulder, Side::left)),
            0.15 * size);
  const double speed = walkingSpeed(who.skeleton(), who.roles());
  EXPECT_GT(speed, 0.5 * size);
  EXPECT_LT(speed, 0.95 * size);
  // The trunk turns to the left first, as far as the spine does.
  EXPECT_NEAR(who.sum("belly_twist", 0.25, Role::lumbar).axial + who.sum("belly_twist", 0.25, Role::thoracic).axial,
              32.1, 0.5);
}

Actor fromFile(const std::string& file) {
  const io::Model model = io::importModel(test::realData() / file);
  return Actor(model.skeleton.value());
}

TEST(RealRigs, TheVisibleHumanDoesTheTasks) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/body.glb");
  expectTasks(fromFile("visible-human-male/body.glb"));
}

TEST(RealRigs, MakeHumansFullRigDoesTheTasks) {
  LORICA_NEEDS_REAL_DATA("makehuman-male/body.glb");
  expectTasks(fromFile("makehuman-male/body.glb"));
}

TEST(RealRigs, MakeHumansMotionCaptureRigDoesTheTasks) {
  LORICA_NEEDS_REAL_DATA("makehuman-male/body_cmu.glb");
  expectTasks(fromFile("makehuman-male/body_cmu.glb"));
}

TEST(RealRigs, TwoRigsOfOneBodyReachTheSamePostures) {
  LORICA_NEEDS_REAL_DATA("makehuman-male/body_cmu.glb");
  const Actor full = fromFile("makehuman-male/body.glb");
  const Actor small = fromFile("makehuman-male/body_cmu.glb");
  for (const char* clip : {"squat", "kneel_aim", "sit", "toe_touch"}) {
    for (const Side side : kSides) {
      for (const Role role : {Role::knee, Role::ankle}) {
        EXPECT_LT((full.at(clip, 0.5, role, side) - small.at(clip, 0.5, role, side)).norm(), 0.01) << clip;
      }
    }
  }
}

TEST(RealRigs, UnnamedJointsWorkWithAMappingFile) {
  LORICA_NEEDS_REAL_DATA("cesium-man/cesium_man.gltf");
  const io::Model model = io::importModel(test::realData() / "cesium-man/cesium_man.gltf");
  EXPECT_THROW(human::findRoles(model.skeleton.value()), base::InputError);
  const auto roles = io::readRoleFile(std::filesystem::path(LORICA_SOURCE_DIR) / "tests/manikin/cesium_man_roles.json",
                                      model.skeleton.value());
  const Actor man(model.skeleton.value(), roles);
  // It stands a quarter turn from +z.
  EXPECT_NEAR((man.frames().facing() * Vec3d::UnitZ()).x(), 1.0, 1e-9);
  expectTasks(man);
}

}  // namespace
}  // namespace lorica::manikin
