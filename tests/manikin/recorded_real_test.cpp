#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/human/retarget.h"
#include "lorica/io/motion.h"
#include "real_data.h"

// Captured motions on a rig whose file has the same walk, brought there by others: trunk and arms by the ways their
// bones point, legs by where the ankles go.

namespace lorica::human {
namespace {

namespace fs = std::filesystem;

using geometry::Vec3d;

const char* const kWalk = "makehuman-male/motions/12_01_walk_pybvh.bvh";

struct Rig {
  Skeleton skeleton;
  RoleMap roles;
  explicit Rig(Skeleton own) : skeleton(std::move(own)), roles(findRoles(skeleton)) {}
  Vec3d way(const Clip& clip, double seconds, Role from, Role to, Side side) const {
    const auto carry = carryTransforms(skeleton, sample(clip, skeleton, seconds));
    const auto at = [&](Role role) {
      const JointIndex joint = roles.joint(role, side).value();
      return Vec3d(carry[joint.value] * skeleton.restPosition(joint));
    };
    return (at(to) - at(from)).normalized();
  }
};

double medianDegrees(std::vector<double> angles) {
  std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2), angles.end());
  return angles[angles.size() / 2] * 180.0 / std::numbers::pi;
}

TEST(RecordedWalk, IsTheOneThatOthersBroughtToTheSameRig) {
  LORICA_NEEDS_REAL_DATA(kWalk);
  LORICA_NEEDS_REAL_DATA("makehuman-male/body_cmu.glb");
  const io::Motion motion = io::importMotion(test::realData() / kWalk);
  const io::Model model = io::importModel(test::realData() / "makehuman-male/body_cmu.glb");
  const Rig shown(motion.skeleton);
  const Rig doer(*model.skeleton);
  const auto walk =
      std::find_if(model.clips.begin(), model.clips.end(), [](const Clip& clip) { return clip.name == "walk"; });
  ASSERT_NE(walk, model.clips.end());
  const Retargeted done = retarget(motion.clip, {shown.skeleton, shown.roles}, {doer.skeleton, doer.roles});
  // Theirs begins with the frame behind the calibration, and goes 4.24 m.
  const double first = motion.clip.channels.front().times.front();
  EXPECT_NEAR(done.travelled, 4.24, 0.15);
  for (const Side side : {Side::left, Side::right}) {
    for (const auto& [from, to] : {std::pair(Role::shoulder, Role::elbow), std::pair(Role::elbow, Role::wrist),
                                   std::pair(Role::hip, Role::knee), std::pair(Role::knee, Role::ankle)}) {
      std::vector<double> apart;
      for (double seconds = 0.0; seconds < walk->duration(); seconds += 0.1) {
        const Vec3d theirs = doer.way(*walk, seconds, from, to, side);
        const Vec3d ours = doer.way(done.clip, first + seconds, from, to, side);
        apart.push_back(std::acos(std::clamp(theirs.dot(ours), -1.0, 1.0)));
      }
      const bool arm = from == Role::shoulder || from == Role::elbow;
      EXPECT_LT(medianDegrees(apart), arm ? 1.0 : 5.0) << roleName(from, side);
    }
  }
}

TEST(RecordedMotions, OfThreeProgramsRunOnTheSameRig) {
  LORICA_NEEDS_REAL_DATA(kWalk);
  const io::Model model = io::importModel(test::realData() / "makehuman-male/body.glb");
  const Rig doer(*model.skeleton);
  for (const auto& entry : fs::directory_iterator(test::realData() / "makehuman-male/motions")) {
    const io::Motion motion = io::importMotion(entry.path());
    const Rig shown(motion.skeleton);
    const Retargeted done = retarget(motion.clip, {shown.skeleton, shown.roles}, {doer.skeleton, doer.roles});
    EXPECT_EQ(done.clip.duration(), motion.clip.duration()) << entry.path();
    // One of them is known to start turned to its right, behind a first frame that faces ahead.
    EXPECT_NEAR(done.turned, entry.path().filename() == "10_01.bvh" ? 38.0 : 0.0, 8.0) << entry.path();
    for (const Side side : {Side::left, Side::right}) {
      for (const double share : {0.2, 0.5, 0.8}) {
        const double seconds = share * motion.clip.duration();
        const Vec3d there = shown.way(motion.clip, seconds, Role::elbow, Role::wrist, side);
        const Vec3d here = doer.way(done.clip, seconds, Role::elbow, Role::wrist, side);
        EXPECT_NEAR(there.y(), here.y(), 1e-3) << entry.path() << " at " << seconds;
      }
    }
  }
}

}  // namespace
}  // namespace lorica::human
