#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lorica/geometry/primitives.h"
#include "lorica/geometry/winding.h"
#include "lorica/raycast/caster.h"
#include "oracle.h"

namespace lorica::raycast {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;
using test::castByOracle;

/// A built scene over meshes that live as long as it.
struct Range {
  explicit Range(std::vector<const TriangleMesh*> targets, SceneUse use = SceneUse::manyRays)
      : meshes(std::move(targets)), scene(use) {
    for (const TriangleMesh* mesh : meshes) {
      scene.add(mesh->positions, makeTopology(*mesh));
    }
    scene.build();
  }
  std::vector<const TriangleMesh*> meshes;
  Scene scene;
};

double uniform(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
}

Vec3d direction(std::mt19937_64& engine) {
  for (;;) {
    const Vec3d v(uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1));
    if (v.squaredNorm() < 1.0 && v.squaredNorm() > 1e-4) {
      return v.normalized();
    }
  }
}

struct Comparison {
  std::size_t compared = 0;
  std::size_t wrong = 0;
  std::size_t apart = 0;  ///< rays near an edge on which the lists differ, counted apart
};

/// Casts random rays from a sphere around the meshes at points near them and compares whole hit lists.
Comparison compare(Range& range, const Vec3d& centre, double radius, std::size_t rays, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  Caster caster(range.scene);
  Comparison result;
  for (std::size_t i = 0; i < rays; ++i) {
    const Vec3d from = centre + 3.0 * radius * direction(engine);
    const Vec3d to = centre + radius * uniform(engine, 0.0, 1.0) * direction(engine);
    const Ray ray{from.cast<float>(), (to - from).cast<float>()};
    const auto found = caster.cast(ray);
    const auto expected = castByOracle(ray, range.meshes);
    bool same = found.size() == expected.hits.size();
    for (std::size_t h = 0; same && h < found.size(); ++h) {
      same = found[h].mesh == expected.hits[h].mesh && found[h].triangle == expected.hits[h].triangle &&
             found[h].entering == expected.hits[h].entering &&
             std::abs(found[h].t - expected.hits[h].t) <= 1e-9 * (1.0 + expected.hits[h].t);
    }
    if (!same && expected.nearContour) {
      ++result.apart;
    } else {
      ++result.compared;
      result.wrong += same ? 0 : 1;
    }
  }
  return result;
}

TriangleMesh randomSoup(std::mt19937_64& engine, std::size_t triangles, double size) {
  TriangleMesh mesh;
  for (std::size_t t = 0; t < triangles; ++t) {
    const Vec3d at = 0.5 * direction(engine) * uniform(engine, 0, 1);
    for (int k = 0; k < 3; ++k) {
      mesh.positions.emplace_back((at + size * direction(engine)).cast<float>());
    }
    const auto base = static_cast<std::uint32_t>(3 * t);
    mesh.triangles.push_back({base, base + 1, base + 2});
  }
  return mesh;
}

TEST(AllHits, EqualTheOracleOnClosedMeshes) {
  const TriangleMesh body = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 4);
  const TriangleMesh inner = geometry::ellipsoid({0.02, 0.1, 0}, {0.1, 0.2, 0.08}, 3);
  const TriangleMesh crossing = geometry::ellipsoid({0.1, 0.2, 0.02}, {0.12, 0.15, 0.08}, 3);
  Range range({&body, &inner, &crossing});
  const Comparison result = compare(range, {0, 0, 0}, 0.9, 3000, 11);
  EXPECT_EQ(result.wrong, 0U);
  EXPECT_LT(result.apart, 10U);
}

TEST(AllHits, EqualTheOracleOnOpenTriangleSoup) {
  std::mt19937_64 engine(5);
  const TriangleMesh soup = randomSoup(engine, 2000, 0.2);
  for (const SceneUse use : {SceneUse::manyRays, SceneUse::manyFrames}) {
    Range range({&soup}, use);
    const Comparison result = compare(range, {0, 0, 0}, 0.5, 3000, 12);
    EXPECT_EQ(result.wrong, 0U);
    EXPECT_LT(result.apart, 30U);
  }
}

TEST(AllHits, EqualTheOracleAKilometreFromTheOrigin) {
  const Vec3d far(1000, -1000, 500);
  TriangleMesh body = geometry::ellipsoid(far, {0.3, 0.9, 0.2}, 3);
  Range range({&body});
  const Comparison result = compare(range, far, 0.9, 3000, 13);
  EXPECT_EQ(result.wrong, 0U);
  EXPECT_LT(result.apart, 100U) << "at a kilometre the distances of the vertices are themselves steps of 0.06 mm";
}

TEST(AllHits, AreTheSameAfterARefit) {
  TriangleMesh body = geometry::ellipsoid({0, 0, 0}, {0.3, 0.9, 0.2}, 4);
  Range range({&body}, SceneUse::manyFrames);
  for (Vec3f& p : body.positions) {
    p = Vec3f(p.x() + 0.3F * p.y() * p.y(), p.y(), p.z() * (1.0F + p.y()));
  }
  range.scene.refit();
  EXPECT_EQ(compare(range, {0, 0, 0}, 0.9, 2000, 14).wrong, 0U);
}

TEST(AllHits, ThreeThousandLayersAreAllFound) {
  TriangleMesh layers;
  for (int i = 0; i < 3000; ++i) {
    const double z = 0.001 * i;
    const auto base = static_cast<std::uint32_t>(layers.positions.size());
    for (const auto& [x, y] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
      layers.positions.emplace_back(Vec3d(x, y, z).cast<float>());
    }
    layers.triangles.push_back({base, base + 1, base + 2});
    layers.triangles.push_back({base, base + 2, base + 3});
  }
  Range range({&layers});
  Caster caster(range.scene);
  const auto hits = caster.cast({Vec3f(0.3F, 0.2F, 5.0F), Vec3f(0, 0, -1)});
  ASSERT_EQ(hits.size(), 3000U);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_NEAR(hits[i].t, 5.0 - 0.001 * static_cast<double>(2999 - i), 1e-6);
  }
}

TEST(AllHits, ARayThroughEdgesAndVerticesCrossesAClosedMeshEvenly) {
  // Vertices, edge middles and face diagonals of a box, and of a sphere whose vertices are hit exactly.
  const TriangleMesh cube = geometry::box({-1, -1, -1}, {1, 1, 1});
  Range range({&cube});
  Caster caster(range.scene);
  std::size_t through = 0;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      const Ray ray{Vec3f(static_cast<float>(x) / 4, static_cast<float>(y) / 4, 5), Vec3f(0, 0, -1)};
      const auto hits = caster.cast(ray);
      ASSERT_TRUE(hits.empty() || hits.size() == 2) << x << ' ' << y;
      if (std::abs(x) < 4 && std::abs(y) < 4) {
        ASSERT_EQ(hits.size(), 2U) << x << ' ' << y;
        EXPECT_TRUE(hits[0].entering);
        EXPECT_FALSE(hits[1].entering);
        EXPECT_EQ(hits[0].t, 4.0);
        EXPECT_EQ(hits[1].t, 6.0);
        ++through;
      }
    }
  }
  EXPECT_EQ(through, 49U);
  EXPECT_EQ(caster.counts().unresolved, 0U);
}

TEST(AllHits, ARayAtEveryVertexOfASphereEntersAndLeavesOnce) {
  const TriangleMesh sphere = geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 4);
  Range range({&sphere});
  Caster caster(range.scene);
  for (const Vec3f& vertex : sphere.positions) {
    const Vec3f from(0.1F, 0.2F, 4.0F);
    const auto hits = caster.cast({from, vertex - from});
    if (vertex.z() > 0.5F) {  // well in front of the outline the ray sees
      ASSERT_EQ(hits.size(), 2U);
    }
    int sum = 0;
    for (const Hit& hit : hits) {
      sum += hit.sign();
    }
    ASSERT_EQ(sum, 0);
  }
  EXPECT_EQ(caster.counts().unresolved, 0U);
}

TEST(AllHits, FacesThatCoincideAreAllReportedInTheCompleteOrder) {
  const TriangleMesh first = geometry::box({-1, -1, -1}, {1, 1, 0});
  const TriangleMesh second = geometry::box({-1, -1, -1}, {1, 1, 0});
  const TriangleMesh below = geometry::box({-1, -1, -2}, {1, 1, -1});
  Range range({&first, &second, &below});
  Caster caster(range.scene);
  const auto hits = caster.cast({Vec3f(0.3F, 0.1F, 4), Vec3f(0, 0, -1)});
  ASSERT_EQ(hits.size(), 6U);
  const std::vector<std::uint32_t> meshes{0, 1, 0, 1, 2, 2};
  for (std::size_t h = 0; h < 6; ++h) {
    EXPECT_EQ(hits[h].mesh, meshes[h]);
  }
}

TEST(AllHits, AFaceHeldTwiceByAnOpenMeshCountsOnce) {
  TriangleMesh cube = geometry::box({-1, -1, -1}, {1, 1, 1});
  cube.triangles.push_back({4, 5, 7});
  cube.triangles.push_back({5, 7, 4});
  Range range({&cube});
  Caster caster(range.scene);
  EXPECT_EQ(caster.cast({Vec3f(0.3F, 0.1F, 4), Vec3f(0, 0, -1)}).size(), 2U);
  EXPECT_EQ(caster.cast({Vec3f(0.3F, -0.2F, 4), Vec3f(0, 0, -1)}).size(), 2U);
}

TEST(AllHits, StayPairedWhereAClosedMeshFoldsOntoItself) {
  // A flap without thickness in front of a box: a wall out and the same wall back, and out again to close it.
  TriangleMesh mesh = geometry::box({-1, -1, -1}, {1, 1, 1});
  const std::vector<geometry::Triangle> front{{4, 5, 7}, {4, 7, 6}};
  for (const geometry::Triangle& t : front) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back(t);
  }
  Range range({&mesh});
  Caster caster(range.scene);
  int sum = 0;
  const auto hits = caster.cast({Vec3f(0.3F, 0.1F, 4), Vec3f(0, 0, -1)});
  for (const Hit& hit : hits) {
    sum += hit.sign();
  }
  EXPECT_EQ(hits.size(), 4U);
  EXPECT_EQ(sum, 0);
  EXPECT_EQ(caster.counts().unresolved, 0U);
}

TEST(AllHits, OfConcentricSpheresAreNestedPairs) {
  TriangleMesh shells;
  for (int i = 1; i <= 40; ++i) {
    geometry::append(shells, geometry::ellipsoid({0, 0, 0}, Vec3d::Constant(0.025 * i), 3));
  }
  Range range({&shells});
  Caster caster(range.scene);
  std::mt19937_64 engine(8);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d from = 3.0 * direction(engine);
    const Vec3d through = 0.015 * direction(engine);
    const auto hits = caster.cast({from.cast<float>(), (through - from).cast<float>()});
    ASSERT_EQ(hits.size(), 80U);
    for (std::size_t h = 0; h < 40; ++h) {
      ASSERT_TRUE(hits[h].entering);
      ASSERT_FALSE(hits[79 - h].entering);
      ASSERT_EQ(hits[h].component, hits[79 - h].component);
    }
  }
}

TEST(AllHits, StayPairedWhereASkinPassesThroughItself) {
  // A tube bent so far that its ends run through each other.
  TriangleMesh tube = geometry::ellipsoid({0, 0, 0}, {0.1, 1.0, 0.1}, 5);
  for (Vec3f& p : tube.positions) {
    const float angle = 3.6F * p.y();
    const float radius = 0.3F + p.x();
    p = Vec3f(radius * std::cos(angle), radius * std::sin(angle), p.z());
  }
  Range range({&tube});
  Caster caster(range.scene);
  std::mt19937_64 engine(21);
  std::size_t twofold = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d from = 2.0 * direction(engine);
    const Vec3d to = 0.4 * direction(engine);
    int winding = 0;
    int most = 0;
    for (const Hit& hit : caster.cast({from.cast<float>(), (to - from).cast<float>()})) {
      winding += hit.sign();
      most = std::max(most, winding);
      ASSERT_GE(winding, 0);
    }
    ASSERT_EQ(winding, 0);
    twofold += most >= 2 ? 1 : 0;
  }
  EXPECT_GT(twofold, 100U) << "the tube should pass through itself";
  EXPECT_EQ(caster.counts().unresolved, 0U);
}

TEST(AllHits, FromInsideAMeshLeaveOnceMoreThanTheyEnter) {
  const TriangleMesh sphere = geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 3);
  Range range({&sphere});
  Caster caster(range.scene);
  std::mt19937_64 engine(3);
  for (int i = 0; i < 500; ++i) {
    const auto hits = caster.cast({Vec3f(0.1F, 0.2F, -0.3F), direction(engine).cast<float>()});
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_FALSE(hits[0].entering);
  }
  EXPECT_EQ(caster.counts().unresolved, 0U);
  EXPECT_EQ(caster.counts().retraced, 0U);
}

TEST(AllHits, NoRayAtASphereSlipsThroughInTwentySeeds) {
  const TriangleMesh sphere = geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 5);
  Range range({&sphere});
  Caster caster(range.scene);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 engine(seed);
    for (int i = 0; i < 20000; ++i) {
      // Aimed inside the inscribed sphere of the mesh: every one must enter and leave.
      const Vec3d from = 5.0 * direction(engine);
      const Vec3d to = 0.7 * direction(engine);
      ASSERT_EQ(caster.cast({from.cast<float>(), (to - from).cast<float>()}).size(), 2U);
    }
  }
}

TEST(AllHits, RaysNearAnOpenEdgeAreCountedApart) {
  TriangleMesh sheet;
  sheet.positions = {Vec3f(-1, -1, 0), Vec3f(1, -1, 0), Vec3f(0, 1, 0)};
  sheet.triangles = {{0, 1, 2}};
  Range range({&sheet});
  Caster caster(range.scene);
  caster.cast({Vec3f(0.1F, -1.0F + 1e-6F, 5), Vec3f(0, 0, -1)});
  EXPECT_EQ(caster.counts().nearOpenEdge, 1U);
  caster.cast({Vec3f(0.1F, -0.9F, 5), Vec3f(0, 0, -1)});
  EXPECT_EQ(caster.counts().nearOpenEdge, 1U);
}

TEST(WindingNumber, EqualsTheSolidAngleInsideOutsideAndWhereTheMeshOverlapsItself) {
  TriangleMesh mesh = geometry::ellipsoid({0, 0, 0}, {1, 0.5, 0.5}, 3);
  geometry::append(mesh, geometry::ellipsoid({0.8, 0, 0}, {1, 0.5, 0.5}, 3));
  Range range({&mesh});
  Caster caster(range.scene);
  std::mt19937_64 engine(9);
  for (int i = 0; i < 400; ++i) {
    const Vec3d point(uniform(engine, -1.2, 2.0), uniform(engine, -0.6, 0.6), uniform(engine, -0.6, 0.6));
    const Vec3d asFloat = point.cast<float>().cast<double>();
    EXPECT_EQ(windingNumber(caster, MeshIndex{0}, asFloat), std::lround(geometry::windingNumber(mesh, asFloat)));
  }
}

}  // namespace
}  // namespace lorica::raycast
