#include "lorica/human/skinning.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "lorica/geometry/primitives.h"

namespace lorica::human {
namespace {

using geometry::Positions;
using geometry::Vec3d;
using geometry::Vec3f;

Skeleton twoJoints() {
  Joint root{"root", std::nullopt, {}};
  root.rest.translation = {0.1, 0.9, 0.0};
  Joint tip{"tip", JointIndex{0}, {}};
  tip.rest.translation = {0.0, 0.5, 0.02};
  tip.rest.rotation = geometry::Quatd(Eigen::AngleAxisd(0.3, Vec3d::UnitZ()));
  return Skeleton({root, tip});
}

SkinWeights blendWeights(const Positions& positions) {
  std::vector<Influence> influences;
  for (const Vec3f& p : positions) {
    const double w = std::clamp(static_cast<double>(p.y()) / 2.0 + 0.5, 0.0, 1.0);
    influences.push_back({0, 1.0 - w});
    influences.push_back({1, w});
  }
  return normaliseWeights(influences, 2).weights;
}

bool sameBits(const Positions& a, const Positions& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3f)) == 0;
}

TEST(Skinning, AtRestReturnsEveryVertexBitForBit) {
  const auto mesh = geometry::ellipsoid({0.3, 1e-7, -2}, {0.3, 0.9, 0.2}, 4);
  const Skeleton skeleton = twoJoints();
  Positions posed(mesh.positions.size());
  skin(mesh.positions, blendWeights(mesh.positions), skinningDeltas(skeleton, restPose(skeleton)), posed, {});
  EXPECT_TRUE(sameBits(posed, mesh.positions));
}

TEST(Skinning, RigidMotionOfTheRootMovesTheSkinRigidly) {
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 4);
  const Skeleton skeleton = twoJoints();
  const Pose pose = turnedPose(skeleton, {{JointIndex{0}, Vec3d(20, -70, 130)}}, Vec3d(0.5, -0.2, 1.5));
  Positions posed(mesh.positions.size());
  skin(mesh.positions, blendWeights(mesh.positions), skinningDeltas(skeleton, pose), posed, {});
  const geometry::Affine3d motion = carryTransforms(skeleton, pose)[0];
  for (std::size_t v = 0; v < posed.size(); ++v) {
    const Vec3d expected = motion * mesh.positions[v].cast<double>();
    ASSERT_LT((posed[v].cast<double>() - expected).norm(), 1e-6);
  }
}

TEST(Skinning, BlendsTheJointsLinearly) {
  const Skeleton skeleton = twoJoints();
  const Pose pose = turnedPose(skeleton, {{JointIndex{1}, Vec3d(0, 0, 60)}}, Vec3d::Zero());
  const auto carry = carryTransforms(skeleton, pose);
  const Positions rest{Vec3f(0.2F, 1.0F, 0.1F)};
  const std::vector<Influence> influences{{0, 0.25}, {1, 0.75}};
  Positions posed(1);
  skin(rest, normaliseWeights(influences, 2).weights, skinningDeltas(skeleton, pose), posed, {});
  const Vec3d p = rest[0].cast<double>();
  EXPECT_LT((posed[0].cast<double>() - (0.25 * (carry[0] * p) + 0.75 * (carry[1] * p))).norm(), 1e-6);
}

TEST(Skinning, DoesNotDependOnTheNumberOfThreads) {
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 6);
  const Skeleton skeleton = twoJoints();
  const Pose pose = turnedPose(skeleton, {{JointIndex{1}, Vec3d(40, 10, 60)}}, Vec3d::Zero());
  const auto deltas = skinningDeltas(skeleton, pose);
  const SkinWeights weights = blendWeights(mesh.positions);
  Positions one(mesh.positions.size());
  Positions five(mesh.positions.size());
  skin(mesh.positions, weights, deltas, one, {1});
  skin(mesh.positions, weights, deltas, five, {5});
  EXPECT_TRUE(sameBits(one, five));
}

TEST(NormaliseWeights, MergesOrdersTruncatesAndSumsToOne) {
  // One vertex with five influences, joint 7 twice, one zero.
  const std::vector<Influence> influences{{7, 0.1}, {3, 0.4}, {7, 0.4}, {9, 0.05}, {1, 0.0}};
  const NormalisedWeights result = normaliseWeights(influences, 5, 2);
  ASSERT_EQ(result.weights.influences, 2U);
  EXPECT_EQ(result.weights.joints, (std::vector<std::uint32_t>{7, 3}));
  EXPECT_FLOAT_EQ(result.weights.weights[0], 0.5F / 0.9F);
  EXPECT_FLOAT_EQ(result.weights.weights[1], 0.4F / 0.9F);
  EXPECT_EQ(result.truncatedVertices, 1U);
  EXPECT_EQ(result.unnormalisedVertices, 1U);
}

TEST(NormaliseWeights, CountsVerticesWithoutWeight) {
  const std::vector<Influence> influences{{1, 1.0}, {2, 0.0}, {2, 0.0}};
  const NormalisedWeights result = normaliseWeights(influences, 1);
  EXPECT_EQ(result.unweightedVertices, 2U);
  EXPECT_EQ(result.firstUnweighted, 1U);
}

}  // namespace
}  // namespace lorica::human
