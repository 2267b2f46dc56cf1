#include "lorica/shotline/partition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "far_sources.h"
#include "lorica/base/units.h"
#include "lorica/geometry/primitives.h"
#include "lorica/shotline/shot_generator.h"

namespace lorica::shotline {
namespace {

using base::radians;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;
using raycast::Ray;

/// Meshes in a scene, and the passages of a ray through them.
class Things {
 public:
  explicit Things(std::vector<TriangleMesh> meshes) : meshes_(std::move(meshes)), scene_(raycast::SceneUse::manyRays) {
    for (const TriangleMesh& mesh : meshes_) {
      scene_.add(mesh.positions, raycast::makeTopology(mesh));
    }
    scene_.build();
    caster_.emplace(scene_);
  }
  std::vector<Passage> along(const Ray& ray) { return passagesOf(ray, caster_->cast(ray), scene_); }

 private:
  std::vector<TriangleMesh> meshes_;
  raycast::Scene scene_;
  std::optional<raycast::Caster> caster_;
};

/// Upright, of many sides, around the y axis.
TriangleMesh cylinder(double radius, double height, std::uint32_t sides) {
  TriangleMesh mesh;
  for (std::uint32_t s = 0; s < sides; ++s) {
    const double angle = 2 * std::numbers::pi * s / sides;
    for (const double y : {-height / 2, height / 2}) {
      mesh.positions.push_back(Vec3d(radius * std::sin(angle), y, radius * std::cos(angle)).cast<float>());
    }
  }
  mesh.positions.push_back(Vec3f(0, static_cast<float>(-height / 2), 0));
  mesh.positions.push_back(Vec3f(0, static_cast<float>(height / 2), 0));
  for (std::uint32_t s = 0; s < sides; ++s) {
    const std::uint32_t low = 2 * s;
    const std::uint32_t next = 2 * ((s + 1) % sides);
    mesh.triangles.push_back({low, next, low + 1});
    mesh.triangles.push_back({next, next + 1, low + 1});
    mesh.triangles.push_back({2 * sides, next, low});
    mesh.triangles.push_back({2 * sides + 1, low + 1, next + 1});
  }
  return mesh;
}

TriangleMesh insideOut(TriangleMesh mesh) {
  for (geometry::Triangle& triangle : mesh.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const geometry::Triangle& t : b.triangles) {
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return a;
}

/// Distance of a ray's line from the origin.
double missDistance(const Ray& ray) {
  const Vec3d d = ray.direction.cast<double>().normalized();
  return ray.origin.cast<double>().cross(d).norm();
}

const std::vector<Source>& everySampler() {
  static const std::vector<Source> sources = [] {
    PointSource point;
    point.position = {1, 1, 4};
    point.halfAngle = 0.25;
    PointSource window = point;
    window.sampler = Sampler::rectangle;
    window.width = 1.5;
    window.height = 1.5;
    PointSource disk = point;
    disk.sampler = Sampler::disk;
    return std::vector<Source>{{"cone", point},
                               {"window", window, Sequence::sobol},
                               {"disk", disk, Sequence::sobol},
                               beamFrom(radians(40), radians(15), 1.0),
                               beamFrom(radians(40), radians(15), 1.0, Sequence::grid, 40),
                               bandOf({0, fullTurn}, {radians(-15), radians(15)}, 1.0, Sequence::sobol),
                               everyDirection(1.0)};
  }();
  return sources;
}

template <class Check>
void forShotsOfEverySampler(const Check& check) {
  for (const Source& source : everySampler()) {
    const ShotGenerator shots(source, 3, 0);
    for (std::uint64_t i = 0; i < 1000; ++i) {
      check(shots.shot(i));
    }
  }
}

TEST(Passages, ThroughASphereHaveItsChordsAndObliquities) {
  constexpr double r = 0.7;
  Things sphere({geometry::ellipsoid({0, 0, 0}, {r, r, r}, 6)});
  int met = 0;
  forShotsOfEverySampler([&](const Ray& ray) {
    const double b = missDistance(ray);
    const auto passages = sphere.along(ray);
    if (b > r) {
      EXPECT_TRUE(passages.empty());
    } else if (b < 0.95 * r) {
      ASSERT_EQ(passages.size(), 1U);
      // The mesh's facets lie up to 1e-4 below the sphere and turn by up to 0.02.
      EXPECT_NEAR(passages[0].thickness(), 2 * std::sqrt(r * r - b * b), 2e-3);
      EXPECT_NEAR(passages[0].obliquityIn, std::asin(b / r), 0.04);
      EXPECT_NEAR(passages[0].obliquityOut, std::asin(b / r), 0.04);
      EXPECT_NEAR(passages[0].normalThickness(), passages[0].thickness() * std::cos(passages[0].obliquityIn), 1e-12);
      ++met;
    }
  });
  EXPECT_GT(met, 2000);
}

TEST(Passages, ThroughABoxHaveTheLengthOfTheSlabs) {
  const Vec3d half(0.3, 0.5, 0.1);
  Things box({geometry::box(-half, half)});
  int met = 0;
  forShotsOfEverySampler([&](const Ray& ray) {
    const Vec3d o = ray.origin.cast<double>();
    const Vec3d d = ray.direction.cast<double>();
    double in = 0;
    double out = 1e9;
    int face = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const double near = (-std::copysign(half[axis], d[axis]) - o[axis]) / d[axis];
      const double far = (std::copysign(half[axis], d[axis]) - o[axis]) / d[axis];
      face = near > in ? axis : face;
      in = std::max(in, near);
      out = std::min(out, far);
    }
    const auto passages = box.along(ray);
    if (out - in < 1e-5) {
      EXPECT_TRUE(passages.empty() || passages[0].thickness() < 1e-4);
      return;
    }
    ASSERT_EQ(passages.size(), 1U);
    EXPECT_NEAR(passages[0].enter, in * d.norm(), 1e-6);
    EXPECT_NEAR(passages[0].thickness(), (out - in) * d.norm(), 2e-6);
    EXPECT_NEAR(std::cos(passages[0].obliquityIn), std::abs(d[face]) / d.norm(), 1e-6);
    ++met;
  });
  EXPECT_GT(met, 500);
}

TEST(Passages, ThroughACylinderHaveItsChords) {
  constexpr double r = 0.4;
  Things upright({cylinder(r, 4.0, 720)});
  int met = 0;
  forShotsOfEverySampler([&](const Ray& ray) {
    const Vec3d d = ray.direction.cast<double>().normalized();
    const Vec3d o = ray.origin.cast<double>();
    const double level = std::hypot(d.x(), d.z());
    const double b = std::abs(o.x() * d.z() - o.z() * d.x()) / level;
    const double middle = o.y() - d.y() * (o.x() * d.x() + o.z() * d.z()) / (level * level);
    if (b > 0.9 * r || std::abs(middle) + std::abs(d.y() / level) * r > 1.9) {
      return;
    }
    const auto passages = upright.along(ray);
    ASSERT_EQ(passages.size(), 1U);
    EXPECT_NEAR(passages[0].thickness(), 2 * std::sqrt(r * r - b * b) / level, 1e-3);
    EXPECT_NEAR(std::cos(passages[0].obliquityIn), std::sqrt(1 - b * b / (r * r)) * level, 0.01);
    ++met;
  });
  EXPECT_GT(met, 1000);
}

TEST(Passages, ThroughAShellAreTwoWithAGap) {
  constexpr double outer = 0.7;
  constexpr double inner = 0.6;
  Things shell({together(geometry::ellipsoid({0, 0, 0}, {outer, outer, outer}, 6),
                         insideOut(geometry::ellipsoid({0, 0, 0}, {inner, inner, inner}, 6)))});
  int met = 0;
  forShotsOfEverySampler([&](const Ray& ray) {
    const double b = missDistance(ray);
    if (b > 0.9 * inner) {
      return;
    }
    const auto passages = shell.along(ray);
    ASSERT_EQ(passages.size(), 2U);
    const double wall = std::sqrt(outer * outer - b * b) - std::sqrt(inner * inner - b * b);
    EXPECT_NEAR(passages[0].thickness(), wall, 2e-3);
    EXPECT_NEAR(passages[1].thickness(), wall, 2e-3);
    const auto segments = partition(passages, OverlapPolicy::allClaim);
    ASSERT_EQ(segments.size(), 3U);
    EXPECT_TRUE(segments[1].owners.empty());
    EXPECT_NEAR(segments[1].to - segments[1].from, 2 * std::sqrt(inner * inner - b * b), 2e-3);
    ++met;
  });
  EXPECT_GT(met, 1000);
}

TEST(Passages, BeginAtTheOriginOfAShotThatStartsInside) {
  Things things({geometry::box({-1, -1, -1}, {1, 1, 1}), geometry::box({-2, -2, -2}, {2, 2, 2})});
  const auto passages = things.along({{0, 0, 0}, {0, 0, 2}});
  ASSERT_EQ(passages.size(), 2U);
  EXPECT_TRUE(passages[0].startsInside && passages[1].startsInside);
  EXPECT_DOUBLE_EQ(passages[0].thickness(), 1.0);
  EXPECT_DOUBLE_EQ(passages[1].thickness(), 2.0) << "metres, whatever the length of the direction";
}

TEST(Passages, OfOverlappingPartsOfOneMeshAreOne) {
  Things capsule({together(geometry::box({-1, -1, 0}, {1, 1, 2}), geometry::box({-1, -1, 1}, {1, 1, 4}))});
  const auto passages = capsule.along({{0.3F, 0.2F, 9}, {0, 0, -1}});
  ASSERT_EQ(passages.size(), 1U);
  EXPECT_DOUBLE_EQ(passages[0].thickness(), 4.0);
}

TEST(Passages, KeepWhatIsInsideOut) {
  Things turned({insideOut(geometry::box({-1, -1, 0}, {1, 1, 2}))});
  const auto passages = turned.along({{0.3F, 0.2F, 9}, {0, 0, -1}});
  ASSERT_EQ(passages.size(), 1U);
  EXPECT_DOUBLE_EQ(passages[0].thickness(), 2.0);
  EXPECT_FALSE(passages[0].startsInside);
}

TEST(Passages, OfAnOpenMeshAreCrossingsWithoutThickness) {
  TriangleMesh sheet;
  sheet.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}};
  Things open({sheet});
  const auto passages = open.along({{0, 0, 3}, {0, 0, -1}});
  ASSERT_EQ(passages.size(), 1U);
  EXPECT_FALSE(passages[0].closed);
  EXPECT_EQ(passages[0].thickness(), 0.0);
  EXPECT_EQ(passages[0].enter, 3.0);
  EXPECT_TRUE(partition(passages, OverlapPolicy::allClaim).empty());
}

TEST(Partition, GivesAnOverlapToWhomThePolicySays) {
  Things things({geometry::box({-1, -1, 0}, {1, 1, 3}), geometry::box({-1, -1, 2}, {1, 1, 5})});
  const auto passages = things.along({{0.3F, 0.2F, 9}, {0, 0, -1}});
  ASSERT_EQ(passages.size(), 2U);
  EXPECT_EQ(passages[0].mesh, 1U) << "met first";
  const auto owned = [&](OverlapPolicy policy, std::vector<std::size_t> ranks) {
    std::array<double, 2> length{};
    for (const Segment& segment : partition(passages, policy, ranks)) {
      for (const std::size_t owner : segment.owners) {
        length.at(passages[owner].mesh) += segment.to - segment.from;
      }
    }
    return length;
  };
  EXPECT_EQ(owned(OverlapPolicy::allClaim, {}), (std::array<double, 2>{3, 3}));
  EXPECT_EQ(owned(OverlapPolicy::outermost, {}), (std::array<double, 2>{2, 3}));
  EXPECT_EQ(owned(OverlapPolicy::priority, {1, 0}), (std::array<double, 2>{3, 2}));
  EXPECT_EQ(owned(OverlapPolicy::priority, {0, 0}), (std::array<double, 2>{2, 3}));
}

}  // namespace
}  // namespace lorica::shotline
