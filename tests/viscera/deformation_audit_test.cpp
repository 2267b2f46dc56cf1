#include "lorica/viscera/deformation_audit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"
#include "lorica/geometry/weld.h"

namespace lorica::viscera {
namespace {

using geometry::box;
using geometry::ellipsoid;
using geometry::Positions;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;
using Map = std::function<Vec3d(const Vec3d&)>;

Positions moved(const TriangleMesh& mesh, const Map& map) {
  Positions result;
  for (const Vec3f& p : mesh.positions) {
    result.emplace_back(map(p.cast<double>()).cast<float>());
  }
  return result;
}

Map shifted(const Vec3d& by) {
  return [by](const Vec3d& p) -> Vec3d { return p + by; };
}
Vec3d still(const Vec3d& p) {
  return p;
}

/// A skin and organs at rest, and the audit of them.
class Bodies {
 public:
  Bodies(TriangleMesh skin, std::vector<TriangleMesh> organs, const AuditOptions& options = {})
      : skin_(std::move(skin)), organs_(std::move(organs)), audit_(audited(skin_, "skin"), all(), options, {}) {}

  /// One map for the skin, one for each organ.
  PoseAudit posed(const Map& skin, const std::vector<Map>& organs, base::Threads threads = {}) const {
    std::vector<Positions> places;
    std::vector<const Positions*> pointers;
    for (std::size_t o = 0; o < organs_.size(); ++o) {
      places.push_back(moved(organs_[o], organs[o]));
    }
    for (const Positions& p : places) {
      pointers.push_back(&p);
    }
    return audit_.measure(moved(skin_, skin), pointers, threads);
  }
  const DeformationAudit& audit() const { return audit_; }
  const TriangleMesh& organ(std::size_t o) const { return organs_[o]; }

 private:
  static AuditedMesh audited(const TriangleMesh& mesh, std::string name) {
    return {std::move(name), &mesh, raycast::makeTopology(mesh)};
  }
  std::vector<AuditedMesh> all() const {
    std::vector<AuditedMesh> list;
    for (const TriangleMesh& organ : organs_) {
      list.push_back(audited(organ, "organ " + std::to_string(list.size())));
    }
    return list;
  }

  TriangleMesh skin_;
  std::vector<TriangleMesh> organs_;
  DeformationAudit audit_;
};

TriangleMesh cube(double half, const Vec3d& centre = Vec3d::Zero()) {
  return box(centre - Vec3d::Constant(half), centre + Vec3d::Constant(half));
}

/// A box whose faces have n x n squares each.
TriangleMesh gridBox(const Vec3d& low, const Vec3d& high, int n) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool top : {false, true}) {
      const auto start = static_cast<std::uint32_t>(mesh.positions.size());
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
          Vec3d p = top ? high : low;
          const int u = (axis + 1) % 3;
          const int v = (axis + 2) % 3;
          p[u] = low[u] + (high[u] - low[u]) * i / n;
          p[v] = low[v] + (high[v] - low[v]) * j / n;
          mesh.positions.push_back(p.cast<float>());
        }
      }
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const auto at = [&](int di, int dj) {
            return start + static_cast<std::uint32_t>((j + dj) * (n + 1) + i + di);
          };
          if (top) {
            mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
          } else {
            mesh.triangles.push_back({at(0, 0), at(1, 1), at(1, 0)});
            mesh.triangles.push_back({at(0, 0), at(0, 1), at(1, 1)});
          }
        }
      }
    }
  }
  return geometry::weld(mesh).mesh;
}

double lens(double r, double s, double d) {
  return std::numbers::pi * (r + s - d) * (r + s - d) * (d * d + 2 * d * (r + s) - 3 * (r - s) * (r - s)) / (12 * d);
}

TEST(DeformationAudit, TwoSpheresOverlapByTheirLens) {
  const Bodies bodies(
      cube(1.0), {ellipsoid({-0.2, 0, 0}, Vec3d::Constant(0.06), 5), ellipsoid({0.2, 0, 0}, Vec3d::Constant(0.04), 5)});
  const PoseAudit posed = bodies.posed(still, {shifted({0.2, 0, 0}), shifted({-0.13, 0, 0})});
  const double expected = lens(0.06, 0.04, 0.07);
  ASSERT_EQ(posed.contacts.size(), 1U);
  const Estimate overlap = *posed.contacts[0].overlap;
  EXPECT_LT(overlap.error, 0.01 * expected);
  EXPECT_NEAR(overlap.value, expected, 4 * overlap.error + 0.005 * expected) << "the facets cut a little off";
  EXPECT_EQ(posed.organs[0].overlap->value, overlap.value);
  EXPECT_EQ(posed.organs[1].overlap->value, overlap.value);
  EXPECT_EQ(*posed.contacts[0].overlapBeyondRest, overlap.value) << "apart at rest";
}

TEST(DeformationAudit, OverlapBeyondRestLeavesOutWhatOverlapsAtRest) {
  const Bodies bodies(cube(1.0), {cube(0.05), cube(0.05, {0.08, 0, 0})});
  const double atRest = 0.02 * 0.1 * 0.1;
  EXPECT_NEAR(bodies.audit().rest().contacts[0].overlap->value, atRest, 0.03 * atRest);
  EXPECT_EQ(*bodies.audit().rest().contacts[0].overlapBeyondRest, 0.0);
  const PoseAudit deeper = bodies.posed(still, {shifted({0.03, 0, 0}), still});
  EXPECT_NEAR(*deeper.contacts[0].overlapBeyondRest, 0.03 * 0.1 * 0.1, 0.03 * 0.05 * 0.1 * 0.1);
  const PoseAudit apart = bodies.posed(still, {shifted({-0.01, 0, 0}), still});
  EXPECT_EQ(*apart.contacts[0].overlapBeyondRest, 0.0);
}

TEST(DeformationAudit, AnOrganInsideAnotherOverlapsByItsWholeVolume) {
  const Bodies bodies(cube(1.0), {cube(0.02, {0.5, 0, 0}), cube(0.1)});
  const PoseAudit posed = bodies.posed(still, {shifted({-0.5, 0.01, 0.02}), still});
  const double volume = 0.04 * 0.04 * 0.04;
  EXPECT_NEAR(posed.contacts[0].overlap->value, volume, 4 * posed.contacts[0].overlap->error + 1e-3 * volume);
}

TEST(DeformationAudit, ASphereWhoseHalfLeavesTheSkinIsHalfOutsideAndAsDeepAsItsRadius) {
  const double r = 0.05;
  const Bodies bodies(cube(0.3), {ellipsoid({0, 0, 0}, Vec3d::Constant(r), 5)});
  const PoseAudit posed = bodies.posed(still, {shifted({0.3, 0.02, -0.01})});
  const OrganAudit& organ = posed.organs[0];
  EXPECT_NEAR(organ.outsideShare->value, 0.5, 4 * organ.outsideShare->error + 2e-3);
  EXPECT_LT(organ.outsideShare->error, 0.01);
  EXPECT_NEAR(*organ.protrusion, r, 1e-4);
  EXPECT_NEAR(*organ.outsideSurface, 0.5, 0.01);
  EXPECT_NEAR(*organ.volumeChange, 0.0, 1e-5);
  const PoseAudit inside = bodies.posed(still, {shifted({0.2, 0, 0})});
  EXPECT_EQ(inside.organs[0].outsideShare->value, 0.0);
  EXPECT_EQ(*inside.organs[0].protrusion, 0.0);
}

TEST(DeformationAudit, AnOrganLargerThanTheBodyIsOutsideByWhatTheBodyDoesNotHold) {
  const Bodies bodies(cube(0.1), {cube(0.2)});
  const OrganAudit& organ = bodies.audit().rest().organs[0];
  EXPECT_NEAR(organ.outsideShare->value, 1.0 - 1.0 / 8.0, 0.01);
  EXPECT_NEAR(*organ.protrusion, 0.1 * std::sqrt(3.0), 1e-6);
}

TEST(DeformationAudit, WhereASkinPassesThroughItselfItsInsideIsStillInside) {
  // Two boxes of one skin reach into each other: between them the winding is 2, and parity would call it outside.
  TriangleMesh skin = box({-0.3, -0.2, -0.2}, {0.1, 0.2, 0.2});
  geometry::append(skin, box({-0.1, -0.2, -0.2}, {0.3, 0.2, 0.2}));
  const Bodies bodies(std::move(skin), {cube(0.05)});
  EXPECT_EQ(bodies.audit().rest().organs[0].outsideShare->value, 0.0);
  EXPECT_EQ(*bodies.audit().rest().organs[0].protrusion, 0.0);
}

TEST(DeformationAudit, BoxesPulledApartHaveAGapOfTheirDistance) {
  const TriangleMesh low = gridBox({-0.05, -0.1, -0.05}, {0.05, 0, 0.05}, 10);
  const TriangleMesh high = gridBox({-0.05, 0.001, -0.05}, {0.05, 0.1, 0.05}, 10);
  const Bodies bodies(cube(1.0), {low, high});
  const PoseAudit posed = bodies.posed(still, {still, shifted({0, 0.007, 0})});
  ASSERT_TRUE(posed.contacts[0].gap);
  EXPECT_NEAR(posed.contacts[0].gap->mean, 0.007, 1e-6);
  EXPECT_NEAR(posed.contacts[0].gap->largest, 0.007, 1e-6);
  EXPECT_NEAR(posed.contacts[0].gap->area, 2 * 0.1 * 0.1 + 4 * 0.1 * (0.005 + 0.00495), 1e-6)
      << "both faces, and half a row of squares at their rims";
  EXPECT_NEAR(posed.organs[0].gap->mean, 0.007, 1e-6);
  EXPECT_EQ(posed.contacts[0].overlap->value, 0.0);
}

TEST(DeformationAudit, ABoxTippedAboutAnEdgeOpensAWedge) {
  const TriangleMesh low = gridBox({0, -0.1, -0.05}, {0.1, 0, 0.05}, 20);
  const TriangleMesh high = gridBox({0, 0, -0.05}, {0.1, 0.1, 0.05}, 20);
  const Bodies bodies(cube(1.0), {low, high}, {.contactDistance = 1e-4});
  const double angle = 0.1;
  const PoseAudit posed = bodies.posed(
      still, {still, [&](const Vec3d& p) -> Vec3d { return Eigen::AngleAxisd(angle, Vec3d::UnitZ()) * p; }});
  EXPECT_NEAR(posed.contacts[0].gap->largest, 0.1 * std::sin(angle), 2e-4);
  EXPECT_NEAR(posed.contacts[0].gap->mean, 0.05 * std::sin(angle), 3e-4);
}

TEST(DeformationAudit, OrgansThatSlideAlongEachOtherOpenNoGap) {
  // A ball in a socket.
  TriangleMesh shell = ellipsoid({0, 0, 0}, Vec3d::Constant(0.1), 4);
  TriangleMesh hollow = ellipsoid({0, 0, 0}, Vec3d::Constant(0.0605), 5);
  for (geometry::Triangle& t : hollow.triangles) {
    std::swap(t[1], t[2]);
  }
  geometry::append(shell, hollow);
  const Bodies bodies(cube(1.0), {ellipsoid({0, 0, 0}, Vec3d::Constant(0.06), 5), shell});
  const PoseAudit posed = bodies.posed(
      still, {[](const Vec3d& p) -> Vec3d { return Eigen::AngleAxisd(1.3, Vec3d(1, 2, 3).normalized()) * p; }, still});
  EXPECT_GT(posed.contacts[0].gap->area, 0.08);
  EXPECT_LT(posed.contacts[0].gap->largest, 1e-4) << "points moved by up to 70 mm";
  EXPECT_EQ(posed.contacts[0].overlap->value, 0.0) << "the hollow belongs to nobody";
}

TEST(DeformationAudit, AnOrganPressedIntoAnotherOpensNoGap) {
  const Bodies bodies(cube(1.0), {gridBox({-0.05, -0.1, -0.05}, {0.05, 0, 0.05}, 10),
                                  gridBox({-0.1, 0.001, -0.1}, {0.1, 0.1, 0.1}, 10)});
  const PoseAudit posed = bodies.posed(still, {shifted({0, 0.02, 0}), still});
  EXPECT_EQ(posed.organs[0].gap->largest, 0.0) << "20 mm deep in the other";
  EXPECT_NEAR(posed.contacts[0].overlap->value, 0.019 * 0.1 * 0.1, 0.03 * 0.019 * 0.1 * 0.1);
}

TEST(DeformationAudit, ATwistedCylinderKeepsItsVolumeAndItsSphereInside) {
  const TriangleMesh skin = gridBox({-0.15, -0.5, -0.15}, {0.15, 0.5, 0.15}, 24);
  const Bodies bodies(skin, {ellipsoid({0.05, 0, 0.02}, Vec3d::Constant(0.08), 5)});
  const Map twist = [](const Vec3d& p) -> Vec3d { return Eigen::AngleAxisd(2.0 * p.y(), Vec3d::UnitY()) * p; };
  const PoseAudit together = bodies.posed(twist, {twist});
  EXPECT_NEAR(*together.organs[0].volumeChange, 0.0, 1e-3) << "a twist moves slices as they are";
  EXPECT_EQ(together.organs[0].outsideShare->value, 0.0);
  // A rigid sphere is left behind by a bend.
  const Map bend = [](const Vec3d& p) -> Vec3d {
    const double angle = 1.2 * p.y();
    return {p.x(), (1.0 - p.z()) * std::sin(angle), 1.0 - (1.0 - p.z()) * std::cos(angle)};
  };
  const PoseAudit bent = bodies.posed(bend, {bend});
  EXPECT_EQ(bent.organs[0].outsideShare->value, 0.0);
  // Volume of a bent slice goes with its distance from the axis of the bend: by 1.2 (1 - z) at the centroid.
  EXPECT_NEAR(*bent.organs[0].volumeChange, 1.2 * (1.0 - 0.02) - 1.0, 2e-3);
}

TEST(DeformationAudit, VolumeAndStretchOfAnAffineMapAreItsDeterminantAndItsLargestEdge) {
  const Bodies bodies(cube(1.0), {cube(0.05)});
  const PoseAudit posed =
      bodies.posed(still, {[](const Vec3d& p) -> Vec3d { return p.cwiseProduct(Vec3d(1.25, 0.9, 1.1)); }});
  EXPECT_NEAR(*posed.organs[0].volumeChange, 1.25 * 0.9 * 1.1 - 1.0, 1e-6);
  EXPECT_NEAR(posed.organs[0].largestStretch, 1.25, 1e-6);
  const PoseAudit sheared = bodies.posed(still, {[](const Vec3d& p) -> Vec3d { return p + Vec3d(0.7 * p.y(), 0, 0); }});
  EXPECT_NEAR(*sheared.organs[0].volumeChange, 0.0, 1e-6);
  const PoseAudit insideOut =
      bodies.posed(still, {[](const Vec3d& p) -> Vec3d { return p.cwiseProduct(Vec3d(-1, 1, 1)); }});
  EXPECT_NEAR(*insideOut.organs[0].volumeChange, -2.0, 1e-6) << "an organ turned inside out has a negative volume";
}

TEST(DeformationAudit, OpenPatchesAreJudgedByTheirSurfaceAndSaySo) {
  TriangleMesh patch = gridBox({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}, 4);
  patch.triangles.resize(patch.triangles.size() - 32);
  const Bodies bodies(cube(0.2), {patch, cube(0.05, {0.1005, 0, 0})});
  const PoseAudit posed = bodies.posed(still, {shifted({0.17, 0, 0}), shifted({0, 0.05, 0})});
  const OrganAudit& organ = posed.organs[0];
  EXPECT_EQ(organ.basis, AuditBasis::surface);
  EXPECT_FALSE(organ.volumeChange || organ.outsideShare || organ.overlap || organ.overlapBeyondRest);
  EXPECT_NEAR(*organ.protrusion, 0.02, 1e-6);
  EXPECT_GT(*organ.outsideSurface, 0.1);
  ASSERT_FALSE(bodies.audit().issues().empty());
  EXPECT_EQ(bodies.audit().issues()[0].place, "organ 0");
  EXPECT_NE(bodies.audit().issues()[0].text.find("does not close"), std::string::npos);
  ASSERT_EQ(posed.contacts.size(), 1U);
  EXPECT_TRUE(posed.contacts[0].gap);
  EXPECT_FALSE(posed.contacts[0].overlap);
}

TEST(DeformationAudit, AnOpenSkinLeavesBlankWhatItCannotTell) {
  TriangleMesh skin = cube(0.2);
  skin.triangles.pop_back();
  const Bodies bodies(skin, {cube(0.05)});
  const OrganAudit& organ = bodies.audit().rest().organs[0];
  EXPECT_FALSE(organ.outsideShare || organ.protrusion || organ.outsideSurface);
  EXPECT_TRUE(organ.volumeChange);
  ASSERT_EQ(bodies.audit().issues().size(), 1U);
  EXPECT_EQ(bodies.audit().issues()[0].place, "skin");
}

TEST(DeformationAudit, OneTriangleAndFlatAndCollapsedOrgansSpoilNothing) {
  TriangleMesh triangle;
  triangle.positions = {Vec3f(0, 0, 0), Vec3f(0.01F, 0, 0), Vec3f(0, 0.01F, 0)};
  triangle.triangles = {{0, 1, 2}};
  TriangleMesh flat = cube(0.05);
  for (Vec3f& p : flat.positions) {
    p.y() = 0.1F;
  }
  const Bodies bodies(cube(0.5), {triangle, flat, cube(0.05, {0.2, 0, 0}), cube(0.05, {-0.2, 0, 0})});
  ASSERT_EQ(bodies.audit().issues().size(), 2U);
  EXPECT_EQ(bodies.audit().issues()[0].place, "organ 0");
  EXPECT_EQ(bodies.audit().issues()[1].place, "organ 1");
  EXPECT_NE(bodies.audit().issues()[1].text.find("encloses no volume"), std::string::npos);
  const PoseAudit posed = bodies.posed(still, {still, still, [](const Vec3d&) { return Vec3d(0.2, 0, 0); }, still});
  EXPECT_EQ(*posed.organs[2].volumeChange, -1.0) << "collapsed to a point";
  EXPECT_EQ(posed.organs[2].outsideShare->value, 0.0);
  EXPECT_EQ(posed.organs[3], bodies.audit().rest().organs[3]);
}

TEST(DeformationAudit, PartsOfAnOrganThatDoNotCloseAreLeftOutOfItsVolume) {
  TriangleMesh organ = cube(0.05);
  TriangleMesh flap;
  flap.positions = {Vec3f(0.06F, 0, 0), Vec3f(0.07F, 0, 0), Vec3f(0.06F, 0.01F, 0)};
  flap.triangles = {{0, 1, 2}};
  geometry::append(organ, flap);
  const Bodies bodies(cube(0.5), {organ});
  EXPECT_EQ(bodies.audit().rest().organs[0].basis, AuditBasis::closedParts);
  EXPECT_NEAR(*bodies.audit().rest().organs[0].volume, 0.001, 1e-9);
  EXPECT_EQ(bodies.audit().issues()[0].severity, base::Severity::note);
}

TEST(DeformationAudit, GivesTheSameBitsAtOneTwoAndFiveThreads) {
  const Bodies bodies(cube(0.1), {ellipsoid({0, 0, 0}, {0.05, 0.06, 0.04}, 3), cube(0.04, {0.05, 0.03, 0.0}),
                                  ellipsoid({0.02, 0.02, 0.05}, {0.05, 0.03, 0.04}, 3)});
  const std::vector<Map> maps = {shifted({0.02, 0, 0}), still, shifted({0, 0.07, 0})};
  const PoseAudit one = bodies.posed(still, maps, {1});
  EXPECT_EQ(one, bodies.posed(still, maps, {2}));
  EXPECT_EQ(one, bodies.posed(still, maps, {5}));
}

TEST(DeformationAudit, CanBeCancelled) {
  const TriangleMesh skin = cube(0.5);
  const TriangleMesh organ = cube(0.1);
  base::Task task;
  task.cancel();
  EXPECT_THROW(DeformationAudit({"skin", &skin, raycast::makeTopology(skin)},
                                {{"organ", &organ, raycast::makeTopology(organ)}}, {}, {}, base::Progress(task)),
               base::Cancelled);
}

/// Overlap of two axis-aligned boxes.
double commonVolume(const geometry::Box3d& a, const geometry::Box3d& b) {
  const geometry::Box3d common = a.intersection(b);
  return common.isEmpty() ? 0.0 : common.volume();
}

/// A box with sides of 20 to 120 mm near the origin, from nine numbers that look random.
geometry::Box3d someBox(std::uint64_t seed) {
  const auto number = [&](std::uint64_t k) {
    std::uint64_t z = (seed * 16 + k + 1) * 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<double>(z >> 40U) / 16777216.0;
  };
  const Vec3d centre = 0.05 * Vec3d(number(0), number(1), number(2));
  const Vec3d half = Vec3d::Constant(0.01) + 0.05 * Vec3d(number(3), number(4), number(5));
  return {centre - half, centre + half};
}

TEST(DeformationAudit, StatesItsErrorHonestly) {
  // Boxes of which everything is known, turned so that they do not run along the columns.
  const Eigen::AngleAxisd turn(0.7, Vec3d(1, 2, -1).normalized());
  const auto turned = [&](const geometry::Box3d& b) {
    TriangleMesh mesh = box(b.min(), b.max());
    mesh.positions = moved(mesh, [&](const Vec3d& p) -> Vec3d { return turn * p; });
    return mesh;
  };
  double squares = 0.0;
  int count = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const geometry::Box3d a = someBox(3 * i);
    const geometry::Box3d b = someBox(3 * i + 1);
    const geometry::Box3d skin = someBox(3 * i + 2);
    const Bodies bodies(turned(skin), {turned(a), turned(b)}, {.columns = 1024});
    const PoseAudit& rest = bodies.audit().rest();
    const Estimate outside = *rest.organs[0].outsideShare;
    const double trueShare = 1.0 - commonVolume(a, skin) / a.volume();
    EXPECT_NEAR(outside.value, trueShare, 6 * outside.error + 1e-4);
    const Estimate overlap = rest.contacts.empty() ? Estimate{} : *rest.contacts[0].overlap;
    EXPECT_NEAR(overlap.value, commonVolume(a, b), 6 * overlap.error + 1e-9);
    for (const auto& [estimate, truth] : {std::pair(outside, trueShare), std::pair(overlap, commonVolume(a, b))}) {
      if (estimate.error > 0.0) {
        const double z = (estimate.value - truth) / estimate.error;
        squares += z * z;
        ++count;
      }
    }
  }
  ASSERT_GT(count, 60);
  // Of a mean of eight, t has a variance of 7/5.
  EXPECT_NEAR(std::sqrt(squares / count), std::sqrt(1.4), 0.4);
}

RC_GTEST_PROP(DeformationAudit, AMoveOfEverythingTogetherChangesNothing, ()) {
  static const Bodies bodies(cube(0.12), {ellipsoid({0, 0, 0}, {0.05, 0.06, 0.04}, 3), cube(0.04, {0.0915, 0.0, 0.0})},
                             {.columns = 1024});
  const auto number = [](int low, int high) { return static_cast<double>(*rc::gen::inRange(low, high)) / 1000.0; };
  const Eigen::AngleAxisd turn(number(-3100, 3100),
                               Vec3d(number(-999, 999), number(-999, 999), number(1, 999)).normalized());
  const Vec3d shift(number(-2000, 2000), number(-2000, 2000), number(-2000, 2000));
  const Map motion = [&](const Vec3d& p) -> Vec3d { return turn * p + shift; };
  const PoseAudit posed = bodies.posed(motion, {motion, motion});
  for (std::size_t o = 0; o < 2; ++o) {
    const OrganAudit& before = bodies.audit().rest().organs[o];
    const OrganAudit& now = posed.organs[o];
    RC_ASSERT(std::abs(*now.volumeChange) < 1e-4);
    RC_ASSERT(std::abs(now.outsideShare->value - before.outsideShare->value) <
              8 * std::hypot(now.outsideShare->error, before.outsideShare->error) + 1e-3);
    RC_ASSERT(std::abs(*now.protrusion - *before.protrusion) < 1e-6);
    RC_ASSERT(now.gap.has_value() == before.gap.has_value());
    RC_ASSERT(!now.gap || now.gap->largest < 1e-6);
    RC_ASSERT(std::abs(now.largestStretch - 1.0) < 1e-4);
  }
}

}  // namespace
}  // namespace lorica::viscera
