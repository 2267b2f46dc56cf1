#include "lorica/shotline/trace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lorica/geometry/primitives.h"
#include "lorica/shotline/partition.h"
#include "lorica/stats/intervals.h"

namespace lorica::shotline {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;

PointSource frontOf(double halfAngle) {
  PointSource point;
  point.position = {0, 0, 8};
  point.halfAngle = halfAngle;
  return point;
}

/// A sphere for skin in two regions (left and right), two armor systems, two organs in two models.
class Target : public testing::Test {
 protected:
  Target() : scene_(raycast::SceneUse::manyRays) {
    meshes_.push_back(geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 5));            // skin
    meshes_.push_back(geometry::box({-2, -2, 1.5}, {2, 0, 1.6}));               // piece 0 of system 1: lower half
    meshes_.push_back(geometry::box({-2, -2, 1.7}, {2, 2, 1.8}));               // piece 1 of system 2: everything
    meshes_.push_back(geometry::box({-2, -2, 1.2}, {0, 2, 1.3}));               // piece 2 of system 2: behind it
    meshes_.push_back(geometry::ellipsoid({0, 0, 0.5}, {0.3, 0.3, 0.3}, 4));    // model 0: organ 0 in front
    meshes_.push_back(geometry::ellipsoid({0, 0, -0.5}, {0.5, 0.5, 0.3}, 4));   // model 0: organ 1 behind it
    meshes_.push_back(geometry::ellipsoid({0, 0.4, 0.5}, {0.3, 0.3, 0.3}, 4));  // model 1: organ 0 has moved up
    meshes_.push_back(meshes_[5]);
    for (const TriangleMesh& mesh : meshes_) {
      scene_.add(mesh.positions, raycast::makeTopology(mesh));
    }
    scene_.build();
    for (std::size_t t = 0; t < meshes_[0].triangles.size(); ++t) {
      const double x = meshes_[0].corner(t, 0).x() + meshes_[0].corner(t, 1).x() + meshes_[0].corner(t, 2).x();
      regions_.push_back(x > 0 ? 0 : 1);
    }
    layout_.regionOfTriangle = regions_;
    layout_.regions = 2;
    layout_.systems = 3;
    layout_.pieceSystem = {1, 2, 2};
    layout_.organs = 2;
    layout_.models = 2;
    source_ = {"front", frontOf(0.16)};
  }

  TraceResult shoot(std::uint64_t shots, base::Threads threads = {}) const {
    return trace(scene_, layout_, ShotGenerator(source_, 3, 0), shots, threads);
  }

  std::vector<TriangleMesh> meshes_;
  raycast::Scene scene_;
  std::vector<std::uint16_t> regions_;
  TargetLayout layout_;
  Source source_;
};

TEST_F(Target, ASpheresHitShareLiesAroundItsSolidAngle) {
  const Tally tally = shoot(200000).tally;
  const double share = solidAngle(std::asin(1.0 / 8.0)) / solidAngle(0.16);
  const stats::Interval interval = stats::wilson(tally.body(0).any, tally.shots(), 0.9999);
  EXPECT_GT(share, interval.low - 1e-3) << "the mesh is a little smaller than the sphere";
  EXPECT_LT(share, interval.high + 1e-3);
}

TEST(SphereShare, LiesInsideItsIntervalAsOftenAsTheIntervalPromises) {
  const TriangleMesh sphere = geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 6);
  raycast::Scene scene(raycast::SceneUse::manyRays);
  scene.add(sphere.positions, raycast::makeTopology(sphere));
  scene.build();
  const std::vector<std::uint16_t> regions(sphere.triangles.size(), 0);
  TargetLayout layout;
  layout.regionOfTriangle = regions;
  layout.regions = 1;
  const Source source{"front", frontOf(0.16)};
  const double share = solidAngle(std::asin(1.0 / 8.0)) / solidAngle(0.16);
  int outside = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Tally tally = trace(scene, layout, ShotGenerator(source, seed, 0), 20000, {}).tally;
    const stats::Interval interval = stats::wilson(tally.body(0).any, tally.shots());
    outside += share < interval.low || share > interval.high ? 1 : 0;
  }
  // One in twenty is expected; more than four happen by chance once in four hundred times.
  EXPECT_LE(outside, 4);
}

TEST_F(Target, HitAndMissMakeAllShots) {
  const Tally tally = shoot(50000).tally;
  EXPECT_EQ(tally.body(0).any + tally.miss().any, 50000U);
}

TEST_F(Target, TheUnarmoredBaselineProtectsNothing) {
  const Tally tally = shoot(50000).tally;
  EXPECT_EQ(tally.body(0).shielded, 0U);
  EXPECT_EQ(tally.body(0).first, tally.body(0).any);
  EXPECT_EQ(tally.organ(0, 0, 0).shielded, 0U);
  EXPECT_EQ(tally.anyArmor(0).any, 0U);
}

TEST_F(Target, AWallInFrontProtectsEverythingAndHalfAWallHalf) {
  const Tally tally = shoot(100000).tally;
  EXPECT_EQ(tally.body(2).shielded, tally.body(2).any);
  EXPECT_EQ(tally.organ(0, 0, 2).shielded, tally.organ(0, 0, 2).any);
  const double half = static_cast<double>(tally.body(1).shielded) / static_cast<double>(tally.body(1).any);
  EXPECT_NEAR(half, 0.5, 5 * 0.5 / std::sqrt(static_cast<double>(tally.body(1).any)));
}

TEST_F(Target, AnyIsFirstPlusProtectedForTheSkinAndArmorMetBeforeItForPieces) {
  const Tally tally = shoot(50000).tally;
  for (std::size_t system = 0; system < 3; ++system) {
    EXPECT_EQ(tally.body(system).first + tally.body(system).shielded, tally.body(system).any);
  }
  EXPECT_EQ(tally.piece(1).first, tally.piece(1).any) << "nothing lies before the outer wall";
  EXPECT_EQ(tally.piece(1).shielded, 0U);
  EXPECT_EQ(tally.piece(2).shielded, tally.piece(2).any) << "the inner piece is wholly behind the outer";
}

TEST_F(Target, TheOrganInFrontIsHitFirst) {
  const Tally tally = shoot(100000).tally;
  const Count front = tally.organ(0, 0, 0);
  const Count back = tally.organ(1, 0, 0);
  EXPECT_EQ(front.first, front.any);
  EXPECT_LT(back.first, back.any);
  EXPECT_EQ(front.first + back.first, tally.anyOrgan(0, 0).any);
  EXPECT_GT(tally.organ(1, 1, 0).first, back.first) << "the organ that moved up uncovers the one behind it";
}

TEST_F(Target, EveryModelIsMetByTheSameShots) {
  const Tally tally = shoot(30000).tally;
  EXPECT_EQ(tally.organ(1, 0, 0).any, tally.organ(1, 1, 0).any) << "the same mesh in both models";
}

TEST_F(Target, FirstHitsOfTheRegionsAddUpToThoseOfTheBody) {
  const Tally tally = shoot(50000).tally;
  for (std::size_t system = 0; system < 3; ++system) {
    EXPECT_EQ(tally.region(0, system).first + tally.region(1, system).first, tally.body(system).first);
  }
}

TEST_F(Target, CountsDoNotDependOnTheNumberOfThreads) {
  const TraceResult one = shoot(60000, {1});
  const TraceResult two = shoot(60000, {2});
  const TraceResult five = shoot(60000, {5});
  EXPECT_EQ(one.tally, two.tally);
  EXPECT_EQ(one.tally, five.tally);
  EXPECT_EQ(one.counts, five.counts);
}

TEST_F(Target, ARunCutInPartsAddsUpToTheWhole) {
  constexpr std::uint64_t shots = 50000;
  const TraceResult whole = shoot(shots);
  for (const std::uint64_t parts : {1, 3, 7}) {
    TraceResult sum;
    for (std::uint64_t p = 0; p < parts; ++p) {
      const ShotRange range{p * shots / parts, (p + 1) * shots / parts - p * shots / parts};
      const TraceResult part = trace(scene_, layout_, ShotGenerator(source_, 3, 0), range, {});
      sum.tally.add(part.tally);
      sum.counts.add(part.counts);
    }
    EXPECT_EQ(sum.tally, whole.tally) << parts;
    EXPECT_EQ(sum.counts, whole.counts) << parts;
  }
}

TEST_F(Target, ARunOfSeveralBlocksAddsUpToItsParts) {
  constexpr std::uint64_t shots = CoherentBlock::mostShots + 12345;
  const TraceResult whole = shoot(shots);
  TraceResult sum;
  for (const ShotRange& range : {ShotRange{0, 300000}, ShotRange{300000, shots - 300000}}) {
    const TraceResult part = trace(scene_, layout_, ShotGenerator(source_, 3, 0), range, {2});
    sum.tally.add(part.tally);
    sum.counts.add(part.counts);
  }
  EXPECT_EQ(whole.tally.shots(), shots);
  EXPECT_EQ(sum.tally, whole.tally);
  EXPECT_EQ(sum.counts, whole.counts);
}

/// Observer that takes down which shots it was shown, and whether each came with its own ray.
struct Attendance {
  const ShotGenerator* shots;
  std::vector<std::uint64_t> seen;
  std::uint64_t strangers = 0;
  Attendance fresh() const { return {shots, {}, 0}; }
  void see(std::uint64_t shot, const raycast::Ray& ray, std::span<const raycast::Hit> /*hits*/) {
    seen.push_back(shot);
    const raycast::Ray own = shots->shot(shot);
    strangers += own.origin != ray.origin || own.direction != ray.direction ? 1 : 0;
  }
  void add(const Attendance& other) {
    seen.insert(seen.end(), other.seen.begin(), other.seen.end());
    strangers += other.strangers;
  }
};

TEST_F(Target, EveryShotOfEveryKindOfSourceIsSeenOnceWithItsOwnRay) {
  ParallelBeam beam;
  beam.azimuth = 0.4;
  DirectionBand band;
  band.azimuth = {0.0, 6.28};
  band.elevation = {-0.2, 0.2};
  // Shots that are all alike give an order nothing to hold on to.
  const std::vector<raycast::Ray> alike(9000, {Vec3f(0, 0, 8), Vec3f(0.03F, 0.02F, -1)});
  ShotList list;
  list.rays = std::make_shared<const std::vector<raycast::Ray>>(alike);
  for (const Source& source : {source_, Source{"beam", beam}, Source{"band", band}, Source{"list", list},
                               Source{"even", band, Sequence::sobol}}) {
    const ShotGenerator shots(source, 7, 2);
    for (const ShotRange& range : {ShotRange{0, 1}, ShotRange{17, 4096}, ShotRange{100, 8900}}) {
      Attendance total{&shots, {}, 0};
      const raycast::CastCounts counts = observeShots(scene_, shots, range, {3}, {}, total);
      std::sort(total.seen.begin(), total.seen.end());
      ASSERT_EQ(total.seen.size(), range.count) << source.name;
      for (std::uint64_t i = 0; i < range.count; ++i) {
        ASSERT_EQ(total.seen[i], range.first + i) << source.name;
      }
      EXPECT_EQ(total.strangers, 0U) << source.name;
      EXPECT_EQ(counts.rays, range.count) << source.name;
    }
  }
}

TEST_F(Target, NoShotsGiveNoCounts) {
  const TraceResult none = shoot(0);
  EXPECT_EQ(none.tally.shots(), 0U);
  EXPECT_EQ(none.counts, raycast::CastCounts());
}

TEST_F(Target, IsStoppedByItsToken) {
  base::Task task;
  task.cancel();
  EXPECT_THROW(trace(scene_, layout_, ShotGenerator(source_, 3, 0), 1000000, {}, base::Progress(task)),
               base::Cancelled);
}

TEST_F(Target, NestedSpheresGiveTheRatioOfTheirSolidAngles) {
  const Tally tally = shoot(400000).tally;
  // The organ behind in model 0 is an ellipsoid; the front organ is a sphere of radius 0.3 at 7.5 m.
  const double ratio = solidAngle(std::asin(0.3 / 7.5)) / solidAngle(std::asin(1.0 / 8.0));
  const double found = static_cast<double>(tally.organ(0, 0, 0).withBody) / static_cast<double>(tally.body(0).any);
  EXPECT_NEAR(found, ratio, 0.02 * ratio);
}

/// A skin behind one piece of armor, shot at from ahead.
struct Guarded {
  explicit Guarded(const TriangleMesh& armor) : scene(raycast::SceneUse::manyRays), meshes{skin(), armor} {
    for (const TriangleMesh& mesh : meshes) {
      scene.add(mesh.positions, raycast::makeTopology(mesh));
    }
    scene.build();
    layout.regionOfTriangle = regions;
    layout.regions = 1;
    layout.systems = 2;
    layout.pieceSystem = {1};
  }
  static TriangleMesh skin() { return geometry::box({-1, -1, -0.1}, {1, 1, 0.1}); }
  Tally tally() const { return trace(scene, layout, ShotGenerator({"front", frontOf(0.2)}, 3, 0), 20000, {}).tally; }

  raycast::Scene scene;
  std::vector<TriangleMesh> meshes;
  std::vector<std::uint16_t> regions = std::vector<std::uint16_t>(skin().triangles.size(), 0);
  TargetLayout layout;
};

TEST(ArmorTurnedInsideOut, ProtectsByWhateverOfItIsCrossed) {
  const TriangleMesh plate = geometry::box({-2, -2, 1.5}, {2, 2, 1.6});
  TriangleMesh inverted = plate;
  for (geometry::Triangle& triangle : inverted.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  // As cloth in a fold: from its middle on the inner face lies outside, and the shell winds the other way.
  TriangleMesh folded = plate;
  for (Vec3f& vertex : folded.positions) {
    vertex.z() = vertex.x() > 0 ? 3.1F - vertex.z() : vertex.z();
  }
  const Tally sound = Guarded(plate).tally();
  ASSERT_GT(sound.body(1).shielded, 5000U);
  EXPECT_EQ(sound.body(1).shielded, sound.body(1).any);
  for (const TriangleMesh& armor : {inverted, folded}) {
    const Guarded guarded(armor);
    EXPECT_EQ(guarded.tally().body(1), sound.body(1));
    // It has a thickness on both sides of the fold as well: a passage is where the shell winds around the shot at all.
    raycast::Caster caster(guarded.scene);
    for (const float x : {-0.8F, 0.8F}) {
      const raycast::Ray ray{{x, 0.3F, 8}, {0, 0, -1}};
      const auto passages = passagesOf(ray, caster.cast(ray), guarded.scene);
      ASSERT_EQ(passages.size(), 2U);
      EXPECT_EQ(passages[0].mesh, 1U);
      // The faces of the folded plate lie 0.1 * |x| / 2 apart.
      EXPECT_TRUE(std::abs(passages[0].thickness() - 0.1) < 1e-6 || std::abs(passages[0].thickness() - 0.04) < 1e-6);
      EXPECT_EQ(caster.counts().unresolved, 0U);
    }
  }
}

}  // namespace
}  // namespace lorica::shotline
