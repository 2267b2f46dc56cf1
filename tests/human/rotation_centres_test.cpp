#include "lorica/human/rotation_centres.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "lorica/geometry/primitives.h"
#include "skin_quality.h"

namespace lorica::human {
namespace {

using geometry::Positions;
using geometry::Vec3d;
using geometry::Vec3f;

constexpr double radius = 0.05;
constexpr double halfLength = 0.25;
constexpr double blendLength = 0.16;

/// A closed limb along y about the origin, and two bones that meet there; the weights change over `blendLength`.
struct Limb {
  geometry::TriangleMesh mesh;
  Skeleton skeleton;
  SkinWeights weights;
};

geometry::TriangleMesh cylinder() {
  constexpr std::uint32_t rings = 101;
  constexpr std::uint32_t sides = 48;
  geometry::TriangleMesh mesh;
  for (std::uint32_t r = 0; r < rings; ++r) {
    const double y = halfLength * (2.0 * r / (rings - 1) - 1.0);
    for (std::uint32_t s = 0; s < sides; ++s) {
      const double angle = 2.0 * std::numbers::pi * s / sides;
      mesh.positions.push_back(Vec3d(radius * std::sin(angle), y, radius * std::cos(angle)).cast<float>());
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t s = 0; s < sides; ++s) {
      const std::uint32_t a = r * sides + s;
      const std::uint32_t b = r * sides + (s + 1) % sides;
      mesh.triangles.push_back({a, b, b + sides});
      mesh.triangles.push_back({a, b + sides, a + sides});
    }
  }
  const auto bottom = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(0.0F, static_cast<float>(-halfLength), 0.0F);
  mesh.positions.emplace_back(0.0F, static_cast<float>(halfLength), 0.0F);
  for (std::uint32_t s = 0; s < sides; ++s) {
    const std::uint32_t last = (rings - 1) * sides;
    mesh.triangles.push_back({bottom, (s + 1) % sides, s});
    mesh.triangles.push_back({bottom + 1, last + s, last + (s + 1) % sides});
  }
  return mesh;
}

Limb limb() {
  Limb limb;
  limb.mesh = cylinder();
  Joint upper{"upper", std::nullopt, {}};
  upper.rest.translation = {0.0, -halfLength, 0.0};
  Joint lower{"lower", JointIndex{0}, {}};
  lower.rest.translation = {0.0, halfLength, 0.0};
  limb.skeleton = Skeleton({upper, lower});
  std::vector<Influence> influences;
  for (const Vec3f& p : limb.mesh.positions) {
    const double t = std::clamp(static_cast<double>(p.y()) / blendLength + 0.5, 0.0, 1.0);
    const double w = t * t * (3.0 - 2.0 * t);
    influences.push_back({0, 1.0 - w});
    influences.push_back({1, w});
  }
  limb.weights = normaliseWeights(influences, 2).weights;
  return limb;
}

struct Posed {
  Positions positions;
  test::SkinQuality quality;
};

Posed pose(const Limb& limb, Skinning skinning, const Vec3d& degrees) {
  const SkinningDeltas deltas =
      skinningDeltas(limb.skeleton, turnedPose(limb.skeleton, {{JointIndex{1}, degrees}}, Vec3d::Zero()));
  Posed posed{Positions(limb.mesh.positions.size()), {}};
  if (skinning == Skinning::linear) {
    skin(limb.mesh.positions, limb.weights, deltas, posed.positions, {1});
  } else {
    skin(limb.mesh.positions, limb.weights, rotationCentres(limb.mesh, limb.weights, {1}), deltas, posed.positions,
         {1});
  }
  posed.quality = test::skinQuality(limb.mesh, limb.weights, deltas, posed.positions);
  return posed;
}

/// Least distance of the skin from the limb's axis within the blend.
double waist(const Positions& positions) {
  double least = radius;
  for (const Vec3f& p : positions) {
    if (std::abs(static_cast<double>(p.y())) < 0.5 * blendLength) {
      least = std::min(least, std::hypot(static_cast<double>(p.x()), static_cast<double>(p.z())));
    }
  }
  return least;
}

TEST(RotationCentres, OfALimbLieOnItsAxisAtTheJoint) {
  const Limb bent = limb();
  const auto centres = rotationCentres(bent.mesh, bent.weights, {});
  for (std::size_t v = 0; v < centres.size(); ++v) {
    if (bent.weights.isShared(v)) {
      ASSERT_LT(centres[v].norm(), 0.02 * radius) << v;
    } else {
      ASSERT_EQ(centres[v], bent.mesh.positions[v]) << v;
    }
  }
}

TEST(RotationCentres, MoveAndGrowWithTheMesh) {
  Limb bent = limb();
  for (Vec3f& p : bent.mesh.positions) {
    p.x() += 0.02F * p.y();  // without symmetry, so that smoothing has something to do
  }
  const auto centres = rotationCentres(bent.mesh, bent.weights, {});
  for (Vec3f& p : bent.mesh.positions) {
    p = 4.0F * p + Vec3f(1.0F, -2.0F, 0.5F);
  }
  const auto grown = rotationCentres(bent.mesh, bent.weights, {});
  for (std::size_t v = 0; v < centres.size(); ++v) {
    ASSERT_LT((grown[v] - (4.0F * centres[v] + Vec3f(1.0F, -2.0F, 0.5F))).norm(), 2e-6F);
  }
}

TEST(RotationCentres, DoNotDependOnTheNumberOfThreads) {
  const auto mesh = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 5);
  std::vector<Influence> influences;
  for (const Vec3f& p : mesh.positions) {
    influences.push_back({0, std::max(0.0, static_cast<double>(p.x()))});
    influences.push_back({1, std::max(0.0, static_cast<double>(p.y()))});
    influences.push_back({2, 0.3});
  }
  const SkinWeights weights = normaliseWeights(influences, 3).weights;
  const auto one = rotationCentres(mesh, weights, {1});
  const auto five = rotationCentres(mesh, weights, {5});
  EXPECT_EQ(std::memcmp(one.data(), five.data(), one.size() * sizeof(Vec3f)), 0);
}

TEST(RotationCentres, ChangeSlowlyWhereAnotherJointSetsIn) {
  // Joint 2 holds half of the ball from one vertex to the next; the centres must not jump with it.
  const auto ball = geometry::ellipsoid({0, 0, 0}, {0.4, 0.4, 0.4}, 6);
  std::vector<Influence> influences;
  for (const Vec3f& p : ball.positions) {
    influences.push_back({0, 0.5});
    influences.push_back({1, 0.5});
    influences.push_back({2, p.y() > 0.0F ? 0.5 : 0.0});
  }
  const auto centres = rotationCentres(ball, normaliseWeights(influences, 3).weights, {});
  geometry::Box3d range;
  for (const Vec3f& centre : centres) {
    range.extend(centre.cast<double>());
  }
  double jump = 0.0;
  for (const auto& corner : ball.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      jump = std::max(jump, static_cast<double>((centres[corner[k]] - centres[corner[(k + 1) % 3]]).norm()));
    }
  }
  EXPECT_GT(range.diagonal().norm(), 0.1);
  EXPECT_LT(jump, 0.15 * range.diagonal().norm());
}

TEST(TwistedLimb, KeepsItsGirthAndVolumeWhereLinearBlendingCollapses) {
  const Limb twisted = limb();
  for (const double degrees : {90.0, 150.0, 179.0}) {
    const Posed ours = pose(twisted, Skinning::rotationCentres, {0, degrees, 0});
    EXPECT_GT(waist(ours.positions), 0.99 * radius) << degrees;
    EXPECT_LT(std::abs(ours.quality.volumeChange), 0.02) << degrees;
    EXPECT_EQ(ours.quality.flippedShare, 0.0) << degrees;
    // Half way through, linear blending leaves the cosine of half the angle.
    const Posed linear = pose(twisted, Skinning::linear, {0, degrees, 0});
    EXPECT_NEAR(waist(linear.positions), radius * std::cos(degrees * std::numbers::pi / 360.0), 0.01 * radius);
  }
}

TEST(TwistedLimb, TakesTheShortWayUpToHalfATurnWhateverTheBodyAroundItDoes) {
  // The parent's own turn brings the child's quaternion to the other side, which must not change the blend.
  const Limb twisted = limb();
  const auto centres = rotationCentres(twisted.mesh, twisted.weights, {});
  for (const double whole : {0.0, 100.0, 170.0, 250.0}) {
    const Pose turned = turnedPose(
        twisted.skeleton, {{JointIndex{0}, Vec3d(0, whole, 0)}, {JointIndex{1}, Vec3d(0, 170, 0)}}, Vec3d::Zero());
    Positions posed(twisted.mesh.positions.size());
    skin(twisted.mesh.positions, twisted.weights, centres, skinningDeltas(twisted.skeleton, turned), posed, {1});
    const Positions alone = pose(twisted, Skinning::rotationCentres, {0, 170, 0}).positions;
    const Eigen::AngleAxisf back(static_cast<float>(-whole * std::numbers::pi / 180.0), Vec3f::UnitY());
    for (std::size_t v = 0; v < posed.size(); ++v) {
      ASSERT_LT((back * posed[v] - alone[v]).norm(), 1e-6F) << whole;
    }
  }
}

TEST(BentLimb, KeepsItsVolumeBetterThanLinearBlending) {
  const Limb bent = limb();
  for (const double degrees : {45.0, 90.0, 120.0, 140.0}) {
    const double ours = pose(bent, Skinning::rotationCentres, {degrees, 0, 0}).quality.volumeChange;
    const double linear = pose(bent, Skinning::linear, {degrees, 0, 0}).quality.volumeChange;
    EXPECT_LT(linear, -0.005) << degrees;
    EXPECT_LT(std::abs(ours), 0.5 * std::abs(linear)) << degrees;
  }
}

TEST(BentLimb, DoesNotBulge) {
  // No place of the skin comes further from the joint than it was at rest.
  const Limb bent = limb();
  const Posed posed = pose(bent, Skinning::rotationCentres, {140, 0, 0});
  for (std::size_t v = 0; v < posed.positions.size(); ++v) {
    ASSERT_LT(posed.positions[v].norm(), bent.mesh.positions[v].norm() + 1e-3F);
  }
}

}  // namespace
}  // namespace lorica::human
