#include "lorica/human/skinning.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "lorica/geometry/primitives.h"
#include "lorica/human/rotation_centres.h"

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

/// Both ways of blending: with the centres of a mesh, and with none.
std::vector<std::vector<Vec3f>> bothCentres(const geometry::TriangleMesh& mesh, const SkinWeights& weights) {
  return {{}, rotationCentres(mesh, weights, {})};
}

TEST(Skinning, AtRestReturnsEveryVertexBitForBit) {
  const auto mesh = geometry::ellipsoid({0.3, 1e-7, -2}, {0.3, 0.9, 0.2}, 4);
  const Skeleton skeleton = twoJoints();
  for (const auto& centres : bothCentres(mesh, blendWeights(mesh.positions))) {
    Positions posed(mesh.positions.size());
    skin(mesh.positions, blendWeights(mesh.positions), centres, skinningDeltas(skeleton, restPose(skeleton)), posed,
         {});
    EXPECT_TRUE(sameBits(posed, mesh.positions));
  }
}

TEST(Skinning, RigidMotionOfTheRootMovesTheSkinRigidly) {
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 4);
  const Skeleton skeleton = twoJoints();
  const SkinWeights weights = blendWeights(mesh.positions);
  for (const Vec3d& degrees : {Vec3d(20, -70, 130), Vec3d(0, 180, 0), Vec3d(-179, 0, 3), Vec3d(90, 120, -150)}) {
    const Pose pose = turnedPose(skeleton, {{JointIndex{0}, degrees}}, Vec3d(0.5, -0.2, 1.5));
    const geometry::Affine3d motion = carryTransforms(skeleton, pose)[0];
    for (const auto& centres : bothCentres(mesh, weights)) {
      Positions posed(mesh.positions.size());
      skin(mesh.positions, weights, centres, skinningDeltas(skeleton, pose), posed, {});
      for (std::size_t v = 0; v < posed.size(); ++v) {
        const Vec3d expected = motion * mesh.positions[v].cast<double>();
        ASSERT_LT((posed[v].cast<double>() - expected).norm(), 1e-6);
      }
    }
  }
}

TEST(Skinning, BlendsTheJointsLinearlyWithoutCentres) {
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

TEST(Skinning, TurnsAboutTheCentreByTheBlendedQuaternionsAndMovesTheCentreLinearly) {
  const Skeleton skeleton = twoJoints();
  const Pose pose = turnedPose(skeleton, {{JointIndex{1}, Vec3d(30, -50, 60)}}, Vec3d(0.1, 0, 0.2));
  const auto carry = carryTransforms(skeleton, pose);
  const Positions rest{Vec3f(0.2F, 1.0F, 0.1F)};
  const std::vector<Vec3f> centres{Vec3f(0.05F, 1.2F, -0.1F)};
  const std::vector<Influence> influences{{0, 0.25}, {1, 0.75}};
  Positions posed(1);
  skin(rest, normaliseWeights(influences, 2).weights, centres, skinningDeltas(skeleton, pose), posed, {});
  // The root only moves, so its quaternion is the identity.
  geometry::Quatd turn(0.75 * geometry::Quatd(carry[1].linear()).coeffs() + Eigen::Vector4d(0, 0, 0, 0.25));
  turn.normalize();
  const Vec3d centre = centres[0].cast<double>();
  const Vec3d expected =
      turn * (rest[0].cast<double>() - centre) + 0.25 * (carry[0] * centre) + 0.75 * (carry[1] * centre);
  EXPECT_LT((posed[0].cast<double>() - expected).norm(), 1e-6);
}

TEST(Skinning, MovesWhatOneJointHoldsWithThatJointWhateverItsCentre) {
  const Skeleton skeleton = twoJoints();
  const Pose pose = turnedPose(skeleton, {{JointIndex{1}, Vec3d(80, -50, 160)}}, Vec3d(0.1, 0, 0.2));
  const Positions rest{Vec3f(0.2F, 1.0F, 0.1F), Vec3f(-0.3F, 0.4F, 0.0F)};
  const std::vector<Vec3f> centres(2, Vec3f(5, 5, 5));
  const std::vector<Influence> influences{{1, 1.0}, {0, 1.0}};
  Positions posed(2);
  Positions linear(2);
  const SkinWeights weights = normaliseWeights(influences, 1).weights;
  skin(rest, weights, centres, skinningDeltas(skeleton, pose), posed, {});
  skin(rest, weights, skinningDeltas(skeleton, pose), linear, {});
  EXPECT_TRUE(sameBits(posed, linear));
  const auto carry = carryTransforms(skeleton, pose);
  EXPECT_LT((posed[0].cast<double>() - carry[1] * rest[0].cast<double>()).norm(), 1e-6);
  EXPECT_LT((posed[1].cast<double>() - carry[0] * rest[1].cast<double>()).norm(), 1e-6);
}

TEST(Skinning, KeepsTheBitsOfVerticesWhoseJointsDoNotMove) {
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 4);
  const Skeleton skeleton = twoJoints();
  std::vector<Influence> influences;
  for (const Vec3f& p : mesh.positions) {
    influences.push_back({0, 1.0});
    influences.push_back({1, std::max(0.0, static_cast<double>(p.y()))});
  }
  const SkinWeights weights = normaliseWeights(influences, 2).weights;
  const Pose pose = turnedPose(skeleton, {{JointIndex{1}, Vec3d(40, 10, 60)}}, Vec3d::Zero());
  Positions posed(mesh.positions.size());
  skin(mesh.positions, weights, rotationCentres(mesh, weights, {}), skinningDeltas(skeleton, pose), posed, {});
  std::size_t still = 0;
  for (std::size_t v = 0; v < posed.size(); ++v) {
    if (!weights.isShared(v) && weights.strongest(v) == JointIndex{0}) {
      ASSERT_EQ(posed[v], mesh.positions[v]);
      ++still;
    }
  }
  EXPECT_GT(still, 0U);
}

TEST(Skinning, BlendsScaledJointsLinearly) {
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 4);
  const Skeleton skeleton = twoJoints();
  const SkinWeights weights = blendWeights(mesh.positions);
  for (const Vec3d& scale : {Vec3d(1.4, 1.4, 1.4), Vec3d(0.5, 1.2, 1.0), Vec3d(-1, 1, 1), Vec3d(0, 0, 0)}) {
    Pose pose = restPose(skeleton);
    pose.local[1].scale = scale;
    const auto carry = carryTransforms(skeleton, pose);
    const SkinningDeltas deltas = skinningDeltas(skeleton, pose);
    for (const auto& centres : bothCentres(mesh, weights)) {
      Positions posed(mesh.positions.size());
      skin(mesh.positions, weights, centres, deltas, posed, {});
      for (std::size_t v = 0; v < posed.size(); ++v) {
        const bool mirrored =
            scale.x() < 0.0;  // the nearest turn of a mirror is not unique, so only the ends are known
        Vec3d expected = Vec3d::Zero();
        for (std::size_t k = 0; k < weights.influences; ++k) {
          const std::size_t at = v * weights.influences + k;
          expected +=
              static_cast<double>(weights.weights[at]) * (carry[weights.joints[at]] * mesh.positions[v].cast<double>());
        }
        ASSERT_TRUE(posed[v].allFinite());
        if (centres.empty() || !weights.isShared(v) || !mirrored) {
          ASSERT_LT((posed[v].cast<double>() - expected).norm(), 2e-6) << scale.transpose();
        }
      }
    }
  }
}

TEST(Skinning, ChangesLittleWhenAJointBeginsToScale) {
  // Rounding in a file's scale keys must not switch the method.
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 4);
  const Skeleton skeleton = twoJoints();
  const SkinWeights weights = blendWeights(mesh.positions);
  const auto centres = rotationCentres(mesh, weights, {});
  Pose pose = turnedPose(skeleton, {{JointIndex{1}, Vec3d(40, 10, 100)}}, Vec3d::Zero());
  Positions before(mesh.positions.size());
  skin(mesh.positions, weights, centres, skinningDeltas(skeleton, pose), before, {});
  pose.local[1].scale = Vec3d::Constant(1.0 + 1e-4);
  ASSERT_FALSE(skinningDeltas(skeleton, pose).stretches.empty());
  Positions after(mesh.positions.size());
  skin(mesh.positions, weights, centres, skinningDeltas(skeleton, pose), after, {});
  for (std::size_t v = 0; v < after.size(); ++v) {
    ASSERT_LT((after[v] - before[v]).norm(), 2e-4F);
  }
}

TEST(Skinning, DoesNotDependOnTheNumberOfThreads) {
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 6);
  const Skeleton skeleton = twoJoints();
  const Pose pose = turnedPose(skeleton, {{JointIndex{1}, Vec3d(40, 10, 60)}}, Vec3d::Zero());
  const auto deltas = skinningDeltas(skeleton, pose);
  const SkinWeights weights = blendWeights(mesh.positions);
  for (const auto& centres : bothCentres(mesh, weights)) {
    Positions one(mesh.positions.size());
    Positions five(mesh.positions.size());
    skin(mesh.positions, weights, centres, deltas, one, {1});
    skin(mesh.positions, weights, centres, deltas, five, {5});
    EXPECT_TRUE(sameBits(one, five));
  }
}

TEST(Skinning, GivesAVertexTheSameBitsWhereverItStandsAmongOthers) {
  // Vertices go through in blocks; a place in a block must not matter.
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 3);
  const Skeleton skeleton = twoJoints();
  const Pose pose = turnedPose(skeleton, {{JointIndex{1}, Vec3d(40, 10, 60)}}, Vec3d::Zero());
  const auto deltas = skinningDeltas(skeleton, pose);
  const SkinWeights weights = blendWeights(mesh.positions);
  const auto centres = rotationCentres(mesh, weights, {});
  Positions together(mesh.positions.size());
  skin(mesh.positions, weights, centres, deltas, together, {});
  for (std::size_t v = 0; v < together.size(); ++v) {
    SkinWeights own;
    own.influences = weights.influences;
    const auto at = static_cast<std::ptrdiff_t>(v * weights.influences);
    const auto end = at + static_cast<std::ptrdiff_t>(weights.influences);
    own.joints.assign(weights.joints.begin() + at, weights.joints.begin() + end);
    own.weights.assign(weights.weights.begin() + at, weights.weights.begin() + end);
    Positions alone(1);
    skin(std::span(&mesh.positions[v], 1), own, std::span(&centres[v], 1), deltas, alone, {});
    ASSERT_EQ(alone[0], together[v]) << v;
  }
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
