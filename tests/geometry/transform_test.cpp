#include "lorica/geometry/transform.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <limits>
#include <numbers>

#include "shapes.h"

namespace lorica::geometry {
namespace {

RigidTransform quarterTurnAboutZ(const Vec3d& translation) {
  return {Quatd(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3d::UnitZ())), translation};
}

TEST(RigidTransform, RotatesThenTranslates) {
  const RigidTransform turn = quarterTurnAboutZ(Vec3d(10, 0, 0));
  EXPECT_LT((turn * Vec3d(1, 0, 0) - Vec3d(10, 1, 0)).norm(), 1e-14);
  EXPECT_LT((turn * Vec3d(0, 1, 5) - Vec3d(9, 0, 5)).norm(), 1e-14);
}

TEST(RigidTransform, OfAProductAppliesTheRightOneFirst) {
  const RigidTransform shift{Quatd::Identity(), Vec3d(1, 0, 0)};
  const RigidTransform turn = quarterTurnAboutZ(Vec3d::Zero());
  EXPECT_LT((turn * shift * Vec3d(0, 0, 0) - Vec3d(0, 1, 0)).norm(), 1e-14);
  EXPECT_LT(((shift * turn) * Vec3d(0, 0, 0) - Vec3d(1, 0, 0)).norm(), 1e-14);
}

RC_GTEST_PROP(RigidTransform, ComposesAndInverts, ()) {
  const RigidTransform a = test::drawnMotion(10);
  const RigidTransform b = test::drawnMotion(10);
  const Vec3d p = test::drawnPoint(-10, 10);
  RC_ASSERT(((a * b) * p - a * (b * p)).norm() < 1e-12);
  RC_ASSERT((a.inverse() * (a * p) - p).norm() < 1e-12);
  RC_ASSERT(((a * a.inverse()) * p - p).norm() < 1e-12);
  RC_ASSERT(((a * b).inverse() * p - b.inverse() * (a.inverse() * p)).norm() < 1e-12);
}

RC_GTEST_PROP(RigidTransform, KeepsDistancesAndHandedness, ()) {
  const RigidTransform motion = test::drawnMotion(10);
  const Vec3d p = test::drawnPoint(-10, 10);
  const Vec3d q = test::drawnPoint(-10, 10);
  RC_ASSERT(std::abs((motion * p - motion * q).norm() - (p - q).norm()) < 1e-12);
  const Vec3d origin = motion * Vec3d(0, 0, 0);
  const Vec3d x = motion * Vec3d(1, 0, 0) - origin;
  const Vec3d y = motion * Vec3d(0, 1, 0) - origin;
  const Vec3d z = motion * Vec3d(0, 0, 1) - origin;
  RC_ASSERT((x.cross(y) - z).norm() < 1e-12);
}

TEST(RigidTransform, StaysARotationOverManyProducts) {
  const RigidTransform step{Quatd(Eigen::AngleAxisd(0.01, Vec3d(1, 2, 3).normalized())), Vec3d::Zero()};
  RigidTransform whole;
  for (int i = 0; i < 100000; ++i) {
    whole = step * whole;
  }
  EXPECT_NEAR(whole.rotation.norm(), 1.0, 1e-14);
}

TEST(RigidTransform, IsTheIdentityOnlyExactly) {
  EXPECT_TRUE(RigidTransform{}.isIdentity());
  EXPECT_FALSE((RigidTransform{Quatd::Identity(), Vec3d(0, 1e-300, 0)}.isIdentity()));
  EXPECT_FALSE((RigidTransform{Quatd(1, 1e-300, 0, 0), Vec3d::Zero()}.isIdentity()));
}

TEST(Transformed, ByTheIdentityReturnsTheSameBits) {
  using Limits = std::numeric_limits<float>;
  const Positions points = {{-0.0F, 0.0F, Limits::denorm_min()},
                            {Limits::max(), -Limits::max(), 0.1F},
                            {Limits::quiet_NaN(), Limits::infinity(), 1.0F / 3.0F}};
  const Positions same = transformed(points, RigidTransform{});
  ASSERT_EQ(same.size(), points.size());
  EXPECT_EQ(std::memcmp(same.data(), points.data(), points.size() * sizeof(Vec3f)), 0);
}

TEST(Transformed, OfNothingIsNothing) {
  EXPECT_TRUE(transformed({}, quarterTurnAboutZ(Vec3d(1, 2, 3))).empty());
}

RC_GTEST_PROP(Transformed, MovesEveryPointInDoublePrecision, ()) {
  const RigidTransform motion = test::drawnMotion(10);
  Positions points;
  for (int i = 0; i < 20; ++i) {
    points.emplace_back(test::drawnPoint(-10, 10).cast<float>());
  }
  const Positions there = transformed(points, motion);
  RC_ASSERT(there.size() == points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d expected = motion * points[i].cast<double>();
    // Half a float step of each coordinate, and no more: nothing was computed in float.
    const Vec3d allowed = expected.cwiseAbs() * 0.5 * std::numeric_limits<float>::epsilon();
    const Vec3d error = (there[i].cast<double>() - expected).cwiseAbs();
    RC_ASSERT((error.array() <= allowed.array() + 1e-13).all());
  }
}

TEST(ZUpToYUp, TurnsZIntoY) {
  EXPECT_EQ(zUpToYUp() * Vec3d(0, 0, 1), Vec3d(0, 1, 0));
  EXPECT_EQ(zUpToYUp() * Vec3d(1, 2, 3), Vec3d(1, 3, -2));
}

TEST(ZUpToYUp, IsARotation) {
  EXPECT_EQ(zUpToYUp() * zUpToYUp().transpose(), Mat3d::Identity());
  EXPECT_EQ(zUpToYUp().determinant(), 1.0);
}

}  // namespace
}  // namespace lorica::geometry
