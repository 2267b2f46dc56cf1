#include "lorica/human/clip.h"

#include <gtest/gtest.h>

namespace lorica::human {
namespace {

using Eigen::Vector4d;
using geometry::Quatd;
using geometry::Vec3d;

Skeleton single() {
  Joint joint{"root", std::nullopt, {}};
  joint.rest.translation = {1, 2, 3};
  return Skeleton({joint});
}

Clip clipOf(Channel channel) {
  Clip clip;
  clip.channels.push_back(std::move(channel));
  return clip;
}

TEST(Clip, HoldsItsFirstAndLastKeyOutside) {
  const Clip clip = clipOf({JointIndex{0},
                            ChannelPath::translation,
                            Interpolation::linear,
                            {1, 3},
                            {Vector4d(0, 0, 0, 0), Vector4d(4, 0, 0, 0)}});
  EXPECT_EQ(clip.duration(), 3.0);
  EXPECT_EQ(sample(clip, single(), 0.0).local[0].translation, Vec3d(0, 0, 0));
  EXPECT_EQ(sample(clip, single(), 2.0).local[0].translation, Vec3d(2, 0, 0));
  EXPECT_EQ(sample(clip, single(), 9.0).local[0].translation, Vec3d(4, 0, 0));
}

TEST(Clip, StepHoldsUntilTheNextKey) {
  const Clip clip = clipOf(
      {JointIndex{0}, ChannelPath::scale, Interpolation::step, {0, 1}, {Vector4d(1, 1, 1, 0), Vector4d(2, 2, 2, 0)}});
  EXPECT_EQ(sample(clip, single(), 0.999).local[0].scale, Vec3d(1, 1, 1));
  EXPECT_EQ(sample(clip, single(), 1.0).local[0].scale, Vec3d(2, 2, 2));
}

TEST(Clip, LinearRotationGoesTheShortWayAtEvenSpeed) {
  const Quatd end(Eigen::AngleAxisd(1.0, Vec3d::UnitZ()));
  // The same turn with the opposite sign of its quaternion.
  const Clip clip = clipOf(
      {JointIndex{0}, ChannelPath::rotation, Interpolation::linear, {0, 1}, {Vector4d(0, 0, 0, 1), -end.coeffs()}});
  const Quatd quarter = sample(clip, single(), 0.25).local[0].rotation;
  EXPECT_NEAR(quarter.angularDistance(Quatd(Eigen::AngleAxisd(0.25, Vec3d::UnitZ()))), 0.0, 1e-9);
}

TEST(Clip, CubicSplineFollowsAParabolaGivenItsTangents) {
  // x(t) = t^2 on [0, 2]: value and slope at the keys determine the cubic, which is the parabola itself.
  const Clip clip = clipOf({JointIndex{0},
                            ChannelPath::translation,
                            Interpolation::cubicSpline,
                            {0, 2},
                            {Vector4d::Zero(), Vector4d::Zero(), Vector4d::Zero(), Vector4d(4, 0, 0, 0),
                             Vector4d(4, 0, 0, 0), Vector4d::Zero()}});
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    EXPECT_NEAR(sample(clip, single(), t).local[0].translation.x(), t * t, 1e-12);
  }
}

TEST(Clip, LeavesJointsAndPropertiesWithoutAChannelAtRest) {
  const Clip clip = clipOf({JointIndex{0}, ChannelPath::scale, Interpolation::linear, {0}, {Vector4d(1, 1, 1, 0)}});
  EXPECT_EQ(sample(clip, single(), 0.0).local[0], single().joints()[0].rest);
}

}  // namespace
}  // namespace lorica::human
