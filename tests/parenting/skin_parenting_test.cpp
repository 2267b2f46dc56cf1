#include "lorica/parenting/skin_parenting.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>

#include "lorica/geometry/primitives.h"
#include "lorica/parenting/interior_sites.h"

namespace lorica::parenting {
namespace {

using geometry::Mat3d;
using geometry::Positions;
using geometry::RigidTransform;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;

struct Skin {
  explicit Skin(TriangleMesh m) : mesh(std::move(m)), scene(raycast::SceneUse::manyRays) {
    index = scene.add(mesh.positions, raycast::makeTopology(mesh));
    scene.build();
  }
  TriangleMesh mesh;
  raycast::Scene scene;
  raycast::MeshIndex index;
};

Positions moved(const Positions& points, const std::function<Vec3d(const Vec3d&)>& map) {
  Positions result;
  for (const Vec3f& p : points) {
    result.emplace_back(map(p.cast<double>()).cast<float>());
  }
  return result;
}

/// Eq 1-3: cevians from each anchor through p meet the opposite sides; p is where lines from the anchors to those
/// points of the moved triangle meet again.
Vec3d cevianPoint(const Vec3d& p, const std::array<Vec3d, 3>& c, const std::array<Vec3d, 3>& moved) {
  const auto share = [&](std::size_t i) {
    // Where the line from corner i through p meets the side from a to b, as a share of that side.
    const Vec3d& a = c[(i + 1) % 3];
    const Vec3d& b = c[(i + 2) % 3];
    const Vec3d d = p - c[i];
    const Vec3d n = (b - a).cross(d);
    return (c[i] - a).cross(d).dot(n) / n.squaredNorm();
  };
  const auto foot = [&](std::size_t i) -> Vec3d {
    const Vec3d& a = moved[(i + 1) % 3];
    return a + share(i) * (moved[(i + 2) % 3] - a);
  };
  // Two of the three concurrent cevians are enough.
  const Vec3d d0 = foot(0) - moved[0];
  const Vec3d d1 = foot(1) - moved[1];
  const Vec3d n = d0.cross(d1);
  const double s = (moved[1] - moved[0]).cross(d1).dot(n) / n.squaredNorm();
  return moved[0] + s * d0;
}

RC_GTEST_PROP(SkinParenting, BarycentricWeightsEqualTheCevianFormOfEquations1To3, ()) {
  const auto coordinate = [] { return static_cast<double>(*rc::gen::inRange(-1000, 1000)) / 500.0; };
  const auto point = [&] { return Vec3d(coordinate(), coordinate(), coordinate()); };
  const std::array<Vec3d, 3> rest{point(), point(), point()};
  const std::array<Vec3d, 3> posed{point(), point(), point()};
  const double area = (rest[1] - rest[0]).cross(rest[2] - rest[0]).norm();
  const double posedArea = (posed[1] - posed[0]).cross(posed[2] - posed[0]).norm();
  RC_PRE(area > 0.05 && posedArea > 0.05);
  const double u = static_cast<double>(*rc::gen::inRange(1, 100)) / 101.0;
  const double v = (1.0 - u) * static_cast<double>(*rc::gen::inRange(1, 100)) / 101.0;
  const Vec3d p = (1 - u - v) * rest[0] + u * rest[1] + v * rest[2];
  const Vec3d w = barycentricWeights(p, rest[0], rest[1], rest[2]);
  const Vec3d direct = w[0] * posed[0] + w[1] * posed[1] + w[2] * posed[2];
  RC_ASSERT((direct - cevianPoint(p, rest, posed)).norm() < 1e-7);
}

TEST(SkinParenting, HitPointAnchorsReproduceThePointAtRest) {
  const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 4));
  raycast::Caster caster(skin.scene);
  const Vec3d point(0.05, 0.2, -0.03);
  const SiteBinding bound = bindToSkin(point, caster, skin.scene, skin.index);
  ASSERT_TRUE(bound.site) << bound.trouble;
  Vec3d again = Vec3d::Zero();
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(bound.site->weights[k], 0.0) << "rays 120 degrees apart enclose the point";
    again += bound.site->weights[k] * bound.site->restAnchors[static_cast<std::size_t>(k)];
  }
  EXPECT_LT((again - point).norm(), 1e-6);
  EXPECT_TRUE(carry(*bound.site, skin.mesh.triangles, skin.mesh.positions)->isIdentity());
}

TEST(SkinParenting, CentroidAnchorsOfTheThesisKeepWhatIsLeftOverAsAResidual) {
  const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 3));
  raycast::Caster caster(skin.scene);
  const Vec3d point(0.05, 0.2, -0.03);
  const SiteBinding bound = bindToSkin(point, caster, skin.scene, skin.index, ParentingOptions::thesis());
  ASSERT_TRUE(bound.site);
  for (const SkinAnchor& anchor : bound.site->anchors) {
    EXPECT_NEAR(anchor.barycentric.minCoeff(), 1.0 / 3.0, 1e-12);
  }
  EXPECT_GT(bound.site->residual.norm(), 1e-6) << "face centroids are not in one plane with the point";
  EXPECT_TRUE(carry(*bound.site, skin.mesh.triangles, skin.mesh.positions)->isIdentity());
}

TEST(SkinParenting, FramesTurnRightFor90DegreesAboutEachAxis) {
  const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 4));
  raycast::Caster caster(skin.scene);
  for (const ParentingOptions& options : {ParentingOptions{}, ParentingOptions::thesis()}) {
    const SiteBinding bound = bindToSkin({0.05, 0.2, -0.03}, caster, skin.scene, skin.index, options);
    ASSERT_TRUE(bound.site);
    for (int k = 0; k < 3; ++k) {
      const Vec3d axis = Vec3d::Unit(k);
      const Mat3d turn = Eigen::AngleAxisd(M_PI / 2, axis).toRotationMatrix();
      const Positions posed = moved(skin.mesh.positions, [&](const Vec3d& p) -> Vec3d { return turn * p; });
      const auto carried = carry(*bound.site, skin.mesh.triangles, posed);
      ASSERT_TRUE(carried);
      EXPECT_LT((carried->rotation.toRotationMatrix() - turn).norm(), 1e-5);
      EXPECT_LT((*carried * bound.site->rest - turn * bound.site->rest).norm(), 1e-6);
    }
  }
}

RC_GTEST_PROP(SkinParenting, RigidMotionOfTheSkinMovesTheSiteRigidly, ()) {
  static const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 3));
  raycast::Caster caster(skin.scene);
  const auto number = [](int low, int high) { return static_cast<double>(*rc::gen::inRange(low, high)) / 1000.0; };
  const Vec3d point(number(-60, 60), number(-200, 200), number(-50, 50));
  const Vec3d axis = Vec3d(number(-999, 999), number(-999, 999), number(1, 999)).normalized();
  const Eigen::AngleAxisd turn(number(-3100, 3100), axis);
  const Vec3d shift(number(-2000, 2000), number(-2000, 2000), number(-2000, 2000));
  const SiteBinding bound = bindToSkin(point, caster, skin.scene, skin.index);
  RC_ASSERT(bound.site.has_value());
  const Positions posed = moved(skin.mesh.positions, [&](const Vec3d& p) -> Vec3d { return turn * p + shift; });
  const auto carried = carry(*bound.site, skin.mesh.triangles, posed);
  RC_ASSERT(carried.has_value());
  const Vec3d probe = point + Vec3d(0.05, -0.03, 0.02);
  RC_ASSERT((*carried * probe - (turn * probe + shift)).norm() < 1e-5);
}

TEST(SkinParenting, APointOutsideTheSkinIsRefusedWithTheReason) {
  const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 3));
  raycast::Caster caster(skin.scene);
  const SiteBinding bound = bindToSkin({0.3, 0, 0}, caster, skin.scene, skin.index);
  EXPECT_FALSE(bound.site);
  EXPECT_NE(bound.trouble.find("not inside"), std::string::npos);
}

TEST(SkinParenting, CollapsedAnchorsCarryNothing) {
  const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 3));
  raycast::Caster caster(skin.scene);
  const SiteBinding bound = bindToSkin({0.0, 0.1, 0.0}, caster, skin.scene, skin.index);
  ASSERT_TRUE(bound.site);
  const Positions line = moved(skin.mesh.positions, [](const Vec3d& p) { return Vec3d(p.x(), 0, 0); });
  EXPECT_FALSE(carry(*bound.site, skin.mesh.triangles, line));
}

TEST(InteriorSites, FillTheSkinEvenlyAndLieInsideIt) {
  const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 5));
  const InteriorSites placed = placeInteriorSites(skin.scene, skin.index, 0.04, {}, {});
  const double volume = 4.0 / 3.0 * M_PI * 0.2 * 0.5 * 0.15;
  EXPECT_NEAR(static_cast<double>(placed.sites.size()) * 0.04 * 0.04 * 0.04, volume, 0.05 * volume);
  EXPECT_EQ(placed.unbound, 0U);
  for (const SkinSite& site : placed.sites) {
    EXPECT_LT(site.rest.cwiseQuotient(Vec3d(0.2, 0.5, 0.15)).norm(), 1.0);
  }
}

TEST(InteriorSites, AreTheSameAtAnyNumberOfThreads) {
  const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 4));
  const InteriorSites one = placeInteriorSites(skin.scene, skin.index, 0.05, {}, {1});
  const InteriorSites five = placeInteriorSites(skin.scene, skin.index, 0.05, {}, {5});
  ASSERT_EQ(one.sites.size(), five.sites.size());
  for (std::size_t i = 0; i < one.sites.size(); ++i) {
    EXPECT_EQ(one.sites[i].rest, five.sites[i].rest);
    EXPECT_EQ(one.sites[i].weights, five.sites[i].weights);
  }
}

TEST(CarrySites, ASiteWithCollapsedAnchorsMovesAsTheNearestSoundOne) {
  const Skin skin(geometry::ellipsoid({0, 0, 0}, {0.2, 0.5, 0.15}, 4));
  const InteriorSites placed = placeInteriorSites(skin.scene, skin.index, 0.05, {}, {});
  // The upper part of the skin shrinks to a line; the lower part moves sideways.
  const Positions posed = moved(skin.mesh.positions, [](const Vec3d& p) {
    return p.y() > 0.2 ? Vec3d(0.1, p.y(), 0) : Vec3d(p + Vec3d(0.1, 0, 0));
  });
  const SiteMotion motion = carrySites(placed.sites, skin.mesh.triangles, posed, {});
  ASSERT_FALSE(motion.collapsed.empty());
  for (const std::uint32_t site : motion.collapsed) {
    EXPECT_TRUE(motion.carry[site].translation.allFinite());
    EXPECT_LT(motion.carry[site].translation.norm(), 1.0);
  }
}

}  // namespace
}  // namespace lorica::parenting
