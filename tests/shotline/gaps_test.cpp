#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "far_sources.h"
#include "lorica/geometry/primitives.h"
#include "lorica/geometry/weld.h"
#include "lorica/shotline/gap_counter.h"
#include "lorica/shotline/open_patches.h"
#include "lorica/shotline/trace.h"

namespace lorica::shotline {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;

/// From x0 to x1 and from y0 to y1 of the face ahead (+z).
struct Hole {
  double x0, x1, y0, y1;
};

/// A square of a cube's surface, cut along lines of two axes; those that `open` are left out.
template <class Open>
void addFace(TriangleMesh& mesh, double half, int axis, bool upper, const std::vector<double>& lines,
             const std::vector<double>& others, const Open& open) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const double u : lines) {
    for (const double v : others) {
      Vec3d point;
      point[axis] = upper ? half : -half;
      point[(axis + 1) % 3] = u;
      point[(axis + 2) % 3] = v;
      mesh.positions.push_back(point.cast<float>());
    }
  }
  const auto rows = static_cast<std::uint32_t>(others.size());
  for (std::uint32_t i = 0; i + 1 < lines.size(); ++i) {
    for (std::uint32_t j = 0; j + 1 < rows; ++j) {
      if (open(0.5 * (lines[i] + lines[i + 1]), 0.5 * (others[j] + others[j + 1]))) {
        continue;
      }
      const std::uint32_t a = first + i * rows + j;
      const std::uint32_t b = upper ? a + rows : a + 1;
      const std::uint32_t d = upper ? a + 1 : a + rows;
      mesh.triangles.push_back({a, b, a + rows + 1});
      mesh.triangles.push_back({a, a + rows + 1, d});
    }
  }
}

std::vector<double> evenly(double half, int cells) {
  std::vector<double> lines;
  for (int i = 0; i <= cells; ++i) {
    lines.push_back(2.0 * half * i / cells - half);
  }
  return lines;
}

/// A cube around the origin with faces of cells x cells squares, closed.
TriangleMesh cube(double half, int cells) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      addFace(mesh, half, axis, upper, evenly(half, cells), evenly(half, cells), [](double, double) { return false; });
    }
  }
  return geometry::weld(mesh).mesh;
}

/// The same as a shell with holes in the face ahead.
TriangleMesh shellWith(double half, const std::vector<Hole>& holes) {
  TriangleMesh mesh;
  const std::vector<double> whole{-half, half};
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      if (axis != 2 || !upper) {
        addFace(mesh, half, axis, upper, whole, whole, [](double, double) { return false; });
      }
    }
  }
  std::vector<double> x = whole;
  std::vector<double> y = whole;
  for (const Hole& hole : holes) {
    x.insert(x.end(), {hole.x0, hole.x1});
    y.insert(y.end(), {hole.y0, hole.y1});
  }
  std::sort(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  addFace(mesh, half, 2, true, x, y, [&](double u, double v) {
    return std::any_of(holes.begin(), holes.end(),
                       [&](const Hole& h) { return u > h.x0 && u < h.x1 && v > h.y0 && v < h.y1; });
  });
  return mesh;
}

/// A skin, one shell around it as armor, and a ball as an organ; systems: none and the shell.
class Shelled {
 public:
  Shelled(TriangleMesh skin, TriangleMesh shell) : scene_(raycast::SceneUse::manyRays) {
    meshes_ = {std::move(skin), std::move(shell), geometry::ellipsoid({0, 0, 0}, {0.1, 0.1, 0.1}, 3)};
    for (const TriangleMesh& mesh : meshes_) {
      scene_.add(mesh.positions, raycast::makeTopology(mesh));
    }
    scene_.build();
    regions_.assign(meshes_[0].triangles.size(), 0);
    layout_.regionOfTriangle = regions_;
    layout_.regions = 1;
    layout_.systems = 2;
    layout_.pieceSystem = {1};
    layout_.organs = 1;
    layout_.models = 1;
  }

  /// Counts of the body and of the organ.
  std::vector<GapCounts> shoot(const Source& source, std::uint64_t shots, base::Threads threads = {}) const {
    GapCounter counter(scene_, layout_, watched);
    observeShots(scene_, ShotGenerator(source, 3, 0), {0, shots}, threads, {}, counter);
    return counter.counts();
  }
  std::vector<OpenPatch> patches(const GapCounts& counts, std::size_t system, const PatchRule& rule = {}) const {
    return openPatches(scene_.topology(raycast::MeshIndex{0}), meshes_[0].positions, counts.skin.hits,
                       counts.skin.openUnder(system), rule);
  }
  /// Skin through which the organ is reached without armor, m2.
  struct Window {
    double clipped = 0.0;  ///< triangles at the rim by their part
    double whole = 0.0;
  };
  Window organWindow(const Source& source, std::uint64_t shots) const {
    const auto shot = entries(source, shots);
    const GapCounts& counts = shot.second[1];
    const auto area = [&](std::span<const std::uint64_t> of) {
      double sum = 0.0;
      for (const OpenPatch& patch : openPatches(scene_.topology(raycast::MeshIndex{0}), meshes_[0].positions,
                                                counts.skin.hits, counts.skin.openUnder(0), {}, of)) {
        sum += patch.area;
      }
      return sum;
    };
    return {area(shot.first), area({})};
  }
  std::pair<std::vector<std::uint64_t>, std::vector<GapCounts>> entries(const Source& source,
                                                                        std::uint64_t shots) const {
    GapCounter counter(scene_, layout_, watched);
    observeShots(scene_, ShotGenerator(source, 3, 0), {0, shots}, {}, {}, counter);
    return {counter.entries(), counter.counts()};
  }
  Tally tally(const Source& source, std::uint64_t shots) const {
    return trace(scene_, layout_, ShotGenerator(source, 3, 0), shots, {}).tally;
  }

 private:
  inline static const std::vector<WatchedStructure> watched{{}, {0, 0}};
  std::vector<TriangleMesh> meshes_;
  raycast::Scene scene_;
  std::vector<std::uint16_t> regions_;
  TargetLayout layout_;
};

constexpr double half = 0.2;
/// 80 x 60 mm, its edges between those of the skin's triangles.
const Hole hole{-0.064, 0.016, 0.03, 0.09};
constexpr double holeArea = 0.0048;
const Vec3d holeCentre(-0.024, 0.06, half);

/// The skin's triangles are 10 mm wide, the shell lies 2 mm before it.
Shelled cubeWithHoles(const std::vector<Hole>& holes) {
  return {cube(half, 40), shellWith(0.202, holes)};
}
/// A rim of triangles 10 mm wide: a hundredth of a metre times the hole's circumference.
double rimOf(const Hole& h) {
  return 0.01 * 2.0 * (h.x1 - h.x0 + h.y1 - h.y0);
}

PointSource pointAhead(Sampler sampler) {
  PointSource point;
  point.position = {0.1, 0.2, 4};
  point.sampler = sampler;
  point.halfAngle = 0.09;
  point.width = 0.75;
  point.height = 0.75;
  return point;
}

struct Shooting {
  Source source;
  std::uint64_t shots;
  bool oneWay = true;  ///< all shots come from nearly the same direction
};

std::vector<Shooting> everyKindOfSource() {
  auto list = std::make_shared<std::vector<raycast::Ray>>();
  const ShotGenerator listed(beamFrom(0.1, 0.05, 0.36), 9, 0);
  for (std::uint64_t shot = 0; shot < 150000; ++shot) {
    list->push_back(listed.shot(shot));
  }
  return {{{"cone", pointAhead(Sampler::cone)}, 150000},
          {{"disk", pointAhead(Sampler::disk)}, 150000},
          {{"rectangle", pointAhead(Sampler::rectangle), Sequence::sobol}, 150000},
          {beamFrom(0.0, 0.0, 0.36), 150000},
          {beamFrom(0.2, -0.1, 0.36, Sequence::sobol), 150000},
          {beamFrom(0.0, 0.1, 0.36, Sequence::grid, 400), 160000},
          {{"list", ShotList{list}}, 150000},
          {bandOf({-0.5, 0.5}, {-0.25, 0.25}, 0.36), 200000, false},
          {everyDirection(0.36, Sequence::sobol), 800000, false}};
}

/// What the area of a patch may be wrong by. Shots of one direction see the hole as it is, cut off by 2 mm of air at a
/// slant; of many directions, triangles at the rim of which less than a tenth of the shots pass do not count.
double bound(const Hole& h, const Shooting& shooting) {
  return shooting.oneWay ? 0.03 * (h.x1 - h.x0) * (h.y1 - h.y0) : PatchRule().openShare * rimOf(h);
}

TEST(Gaps, AHoleIsFoundWithItsAreaAndItsPlaceFromEveryKindOfSource) {
  const Shelled body = cubeWithHoles({hole});
  for (const Shooting& shooting : everyKindOfSource()) {
    const std::string& name = shooting.source.name;
    const auto patches = body.patches(body.shoot(shooting.source, shooting.shots)[0], 1);
    ASSERT_EQ(patches.size(), 1U) << name;
    EXPECT_NEAR(patches[0].area, holeArea, bound(hole, shooting)) << name;
    EXPECT_GE(patches[0].extent, patches[0].area) << name;
    EXPECT_LT(patches[0].extent, holeArea + rimOf(hole)) << name;
    EXPECT_LT((patches[0].centre - holeCentre).norm(), 0.002) << name;
  }
}

TEST(Gaps, TheAreaComesNearerWithMoreShotsAndIsFoundWithFew) {
  const Shelled body = cubeWithHoles({hole});
  for (const auto& [shots, share] :
       std::vector<std::pair<std::uint64_t, double>>{{5000, 0.25}, {50000, 0.06}, {500000, 0.02}}) {
    const auto patches = body.patches(body.shoot(beamFrom(0.0, 0.0, 0.3), shots)[0], 1);
    ASSERT_EQ(patches.size(), 1U) << shots;
    EXPECT_NEAR(patches[0].area, holeArea, share * holeArea) << shots;
  }
}

TEST(Gaps, TwoHolesAreTwoPatchesAndACoveredBodyHasNone) {
  const Hole other{0.06, 0.1, -0.1, -0.06};
  const Shelled body = cubeWithHoles({hole, other});
  const Shelled covered = cubeWithHoles({});
  for (const Shooting& shooting : everyKindOfSource()) {
    const std::string& name = shooting.source.name;
    const auto patches = body.patches(body.shoot(shooting.source, shooting.shots)[0], 1);
    ASSERT_EQ(patches.size(), 2U) << name;
    EXPECT_GT(patches[0].area, patches[1].area);
    EXPECT_NEAR(patches[1].area, 0.0016, std::max(bound(other, shooting), 0.05 * 0.0016)) << name;
    EXPECT_LT((patches[1].centre - Vec3d(0.08, -0.08, half)).norm(), 0.002) << name;
    const auto counts = covered.shoot(shooting.source, 40000);
    EXPECT_TRUE(covered.patches(counts[0], 1).empty()) << name;
    EXPECT_TRUE(covered.patches(counts[1], 1).empty()) << name;
  }
}

TEST(Gaps, WithoutArmorWhatTheShotsReachIsOnePatch) {
  const Shelled body = cubeWithHoles({hole});
  const auto ahead = body.patches(body.shoot(beamFrom(0.0, 0.0, 0.3), 150000)[0], 0);
  ASSERT_EQ(ahead.size(), 1U);
  EXPECT_NEAR(ahead[0].area, 0.16, 0.001) << "the face ahead";
  EXPECT_NEAR(ahead[0].extent, 0.16, 0.001) << "the faces beside it are not reached and do not count";
  EXPECT_EQ(ahead[0].hits, ahead[0].open);
  const auto around = body.patches(body.shoot(everyDirection(0.36), 300000)[0], 0);
  ASSERT_EQ(around.size(), 1U);
  // Some nine shots to a triangle: of 19,200 two or three have none, where nine were to be expected.
  EXPECT_NEAR(around[0].area, 6 * 0.16, 10 * 0.5e-4) << "all of it";
}

TEST(Gaps, OnARoundBodyTheHoleIsTheCapBehindIt) {
  // A beam through a round opening of radius a in a ball-shaped shell lights the cap of height R - sqrt(R^2 - a^2).
  constexpr double radius = 0.25;
  constexpr double opening = 0.08;
  const TriangleMesh ball = geometry::ellipsoid({0, 0, 0}, {radius, radius, radius}, 5);
  TriangleMesh shell = geometry::ellipsoid({0, 0, 0}, {0.26, 0.26, 0.26}, 6);
  std::erase_if(shell.triangles, [&](const geometry::Triangle& t) {
    const Vec3d middle = (shell.positions[t[0]] + shell.positions[t[1]] + shell.positions[t[2]]).cast<double>() / 3.0;
    return middle.z() > 0 && std::hypot(middle.x(), middle.y()) < opening;
  });
  const Shelled body(ball, shell);
  const double cap = 2 * std::numbers::pi * radius * (radius - std::sqrt(radius * radius - opening * opening));
  const auto patches = body.patches(body.shoot(beamFrom(0.0, 0.0, 0.26), 300000)[0], 1);
  ASSERT_EQ(patches.size(), 1U);
  EXPECT_NEAR(patches[0].area, cap, 0.015 * cap);
  EXPECT_NEAR(patches[0].centre.x(), 0.0, 0.001);
  EXPECT_NEAR(patches[0].centre.y(), 0.0, 0.001);
}

TEST(Gaps, OfAnOrganAreWhereShotsThatReachItEnterTheSkin) {
  // The hole shows 40 x 40 mm of a ball of 100 mm radius behind it: only those shots count, wherever else it is open.
  const Shelled body = cubeWithHoles({{0.05, 0.15, -0.02, 0.02}});
  const auto counts = body.shoot(beamFrom(0.0, 0.0, 0.3), 400000);
  const auto patches = body.patches(counts[1], 1);
  ASSERT_EQ(patches.size(), 1U);
  double area = 0.0;  // of the part of the opening within 0.1 of the axis
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const double y = -0.02 + 0.04 * (i + 0.5) / steps;
    area += 0.04 / steps * (std::sqrt(0.01 - y * y) - 0.05);
  }
  EXPECT_NEAR(patches[0].area, area, 0.05 * area);
  EXPECT_EQ(counts[1].offSkin, 0U);
}

TEST(Gaps, AnOrganIsSeenThroughTheSkinBeforeItNotThroughWholeTriangles) {
  // Without armor, a ball of 100 mm radius is seen from afar through a disk of the face, whatever its triangles.
  for (const int cells : {8, 20, 40}) {
    const Shelled body(cube(half, cells), shellWith(0.202, {hole}));
    const Shelled::Window window = body.organWindow(beamFrom(0.0, 0.0, 0.3), 400000);
    const double disk = std::numbers::pi * 0.01;
    EXPECT_NEAR(window.clipped, disk, 0.015 * disk) << cells;
    EXPECT_GT(window.whole, window.clipped) << "whole triangles at the rim are too much";
    if (cells == 8) {
      EXPECT_GT(window.whole, 1.15 * disk) << "triangles of 50 mm";
    }
  }
}

TEST(Gaps, ANearSourceSeesTheOrgansShadowOnTheSkin) {
  // From a point at height h above the face, a ball of radius r at depth d is seen through a circle of the plane of
  // the face with the radius h tan(asin(r / (h + d))).
  const Shelled body(cube(half, 20), shellWith(0.202, {hole}));
  PointSource point;
  point.position = {0, 0, 1.2};
  point.sampler = Sampler::cone;
  point.halfAngle = 0.25;
  const double height = 1.0;
  const double radius = height * std::tan(std::asin(0.1 / (height + half)));
  const double disk = std::numbers::pi * radius * radius;
  EXPECT_NEAR(body.organWindow({"near", point}, 400000).clipped, disk, 0.015 * disk);
}

TEST(Gaps, EntriesHoldEveryShotThatEntersTheSkin) {
  const Shelled body = cubeWithHoles({hole});
  for (const auto& [source, shots, oneWay] : everyKindOfSource()) {
    const auto [entries, counts] = body.entries(source, 20000);
    for (std::size_t t = 0; t < entries.size(); ++t) {
      EXPECT_EQ(entries[t], counts[0].skin.hits[t]) << "a convex body is entered once";
      EXPECT_LE(counts[1].skin.hits[t], entries[t]);
    }
  }
}

TEST(Gaps, CountsAddUpToThoseOfTheRun) {
  const Shelled body = cubeWithHoles({hole});
  for (const auto& [source, shots, oneWay] : everyKindOfSource()) {
    const auto counts = body.shoot(source, 50000);
    const Tally tally = body.tally(source, 50000);
    const auto sum = [](std::span<const std::uint64_t> values) {
      return std::accumulate(values.begin(), values.end(), std::uint64_t{0});
    };
    for (const std::size_t system : {std::size_t{0}, std::size_t{1}}) {
      EXPECT_EQ(sum(counts[0].skin.hits), tally.body(system).any);
      EXPECT_EQ(sum(counts[0].skin.openUnder(system)), tally.body(system).any - tally.body(system).shielded);
      const Count organ = tally.organ(0, 0, system);
      EXPECT_EQ(sum(counts[1].own.hits), organ.any);
      EXPECT_EQ(sum(counts[1].own.openUnder(system)), organ.any - organ.shielded);
      EXPECT_EQ(sum(counts[1].skin.hits) + counts[1].offSkin, organ.any);
    }
  }
}

TEST(Gaps, AreTheSameCountsAtAnyNumberOfThreads) {
  const Shelled body = cubeWithHoles({hole});
  const auto one = body.shoot(everyDirection(0.36), 100000, {1});
  for (const int threads : {2, 5}) {
    const auto many = body.shoot(everyDirection(0.36), 100000, {threads});
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(many[i].skin.open, one[i].skin.open);
      EXPECT_EQ(many[i].own.hits, one[i].own.hits);
      EXPECT_EQ(many[i].towards, one[i].towards);
    }
  }
}

TEST(GapDirections, SumUpAgainstTheShotsThatPass) {
  const Shelled body = cubeWithHoles({hole});
  const auto counts = body.shoot(beamFrom(0.2, -0.1, 0.36), 100000)[0];
  const auto patch = body.patches(counts, 1).at(0);
  Vec3d sum = Vec3d::Zero();
  for (const std::uint32_t t : patch.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[static_cast<int>(k)] += static_cast<double>(counts.towards[3 * (counts.skin.hits.size() + t) + k]);
    }
  }
  sum /= GapCounter::directionUnit * static_cast<double>(patch.open);
  EXPECT_LT((sum - towards(0.2, -0.1)).norm(), 1e-6);
}

TEST(OpenPatches, ThinSamplesDoNotMakeEveryTriangleAPatchOfItsOwn) {
  const TriangleMesh ball = geometry::ellipsoid({0, 0, 0}, {0.2, 0.2, 0.2}, 5);
  const auto topology = raycast::makeTopology(ball);
  std::vector<std::uint64_t> hits(ball.triangles.size(), 0);
  for (std::size_t t = 0; t < hits.size(); t += 3) {
    hits[t] = 1;
  }
  const auto patches = openPatches(*topology, ball.positions, hits, hits);
  ASSERT_EQ(patches.size(), 1U);
  EXPECT_NEAR(patches[0].area, 4 * std::numbers::pi * 0.04, 0.01);
  // One in a hundred open shots, evenly spread, is no hole; nor are nineteen shots.
  std::vector<std::uint64_t> stray(hits.size(), 0);
  for (std::size_t t = 0; t < stray.size(); t += 300) {
    stray[t] = 1;
  }
  EXPECT_TRUE(openPatches(*topology, ball.positions, hits, stray).empty());
  std::vector<std::uint64_t> few(hits.size(), 0);
  few[7] = 19;
  EXPECT_TRUE(openPatches(*topology, ball.positions, few, few).empty());
  few[7] = 20;
  EXPECT_EQ(openPatches(*topology, ball.positions, few, few).size(), 1U);
}

}  // namespace
}  // namespace lorica::shotline
