#include "lorica/human/skeleton.h"

#include <gtest/gtest.h>

#include "lorica/base/error.h"

namespace lorica::human {
namespace {

using geometry::Affine3d;
using geometry::Quatd;
using geometry::Vec3d;

/// An upright chain: pelvis, spine, and an arm that points to the left, its frames turned at rest.
Skeleton chain() {
  Joint pelvis{"pelvis", std::nullopt, {}};
  pelvis.rest.translation = {0, 1, 0};
  Joint spine{"spine", JointIndex{0}, {}};
  spine.rest.translation = {0, 0.3, 0};
  spine.rest.rotation = Quatd(Eigen::AngleAxisd(0.4, Vec3d::UnitX()));
  Joint arm{"arm", JointIndex{1}, {}};
  arm.rest.translation = {0.2, 0.1, 0.05};
  arm.rest.rotation = Quatd(Eigen::AngleAxisd(-0.9, Vec3d(1, 2, 3).normalized()));
  return Skeleton({pelvis, spine, arm});
}

TEST(Skeleton, RefusesAChildBeforeItsParent) {
  EXPECT_THROW(Skeleton({{"a", JointIndex{1}, {}}, {"b", std::nullopt, {}}}), base::CallerError);
}

TEST(Skeleton, FindsJointsByName) {
  EXPECT_EQ(chain().find("arm"), JointIndex{2});
  EXPECT_FALSE(chain().find("leg"));
}

TEST(RestPose, CarriesEveryJointByTheExactIdentity) {
  const Skeleton skeleton = chain();
  for (const Affine3d& carry : carryTransforms(skeleton, restPose(skeleton))) {
    EXPECT_EQ(carry.matrix(), Affine3d::Identity().matrix());
  }
}

TEST(TurnedPose, TurnsAboutTheSceneAxesThroughTheJointWhateverItsRestFrame) {
  const Skeleton skeleton = chain();
  const Vec3d axes[] = {Vec3d::UnitX(), Vec3d::UnitY(), Vec3d::UnitZ()};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d degrees = Vec3d::Zero();
    degrees[axis] = 90;
    const auto carry = carryTransforms(skeleton, turnedPose(skeleton, {{JointIndex{2}, degrees}}, Vec3d::Zero()));
    EXPECT_EQ(carry[1].matrix(), Affine3d::Identity().matrix()) << "joints above do not move";
    const Vec3d pivot = skeleton.restPosition(JointIndex{2});
    const Vec3d probe(0.4, 1.2, -0.3);
    const Vec3d expected = pivot + Eigen::AngleAxisd(M_PI / 2, axes[axis]) * (probe - pivot);
    EXPECT_LT((carry[2] * probe - expected).norm(), 1e-12);
  }
}

TEST(TurnedPose, AppliesXThenYThenZ) {
  const Skeleton skeleton = chain();
  const auto carry =
      carryTransforms(skeleton, turnedPose(skeleton, {{JointIndex{0}, Vec3d(90, 90, 0)}}, Vec3d::Zero()));
  // y up turns to z forward about x, then to x left about y.
  EXPECT_LT((carry[0].linear() * Vec3d::UnitY() - Vec3d::UnitX()).norm(), 1e-12);
}

TEST(TurnedPose, RootOffsetMovesEverything) {
  const Skeleton skeleton = chain();
  const Vec3d offset(0.1, -0.2, 0.3);
  for (const Affine3d& carry : carryTransforms(skeleton, turnedPose(skeleton, {}, offset))) {
    EXPECT_LT((carry * Vec3d(1, 2, 3) - Vec3d(1, 2, 3) - offset).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace lorica::human
