#include "lorica/geometry/intersections.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "shapes.h"

namespace lorica::geometry {
namespace {

using std::numbers::pi;

using Corners = std::array<Vec3f, 3>;
using Pairs = std::vector<TrianglePair>;

constexpr base::Threads kTwo{2};

Corners cornersOf(const TriangleMesh& mesh, std::size_t t) {
  const Triangle& corner = mesh.triangles[t];
  return {mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]};
}

TriangleMesh ball(const Vec3d& centre, double radius) {
  return ellipsoid(centre, Vec3d::Constant(radius), 3);
}

TEST(Meeting, OfTrianglesIsToldAlsoWhereTheyOnlyTouch) {
  const Corners flat{Vec3f(0, 0, 0), Vec3f(4, 0, 0), Vec3f(0, 4, 0)};
  const auto against = [&](const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const Corners other{a, b, c};
    EXPECT_EQ(meeting(flat, other), meeting(other, flat));
    return meeting(flat, other);
  };
  EXPECT_EQ(against({1, 1, -1}, {1, 1, 1}, {3, 3, 1}), Meeting::crossing);
  EXPECT_EQ(against({1, 1, 0}, {1, 1, 1}, {3, 3, 1}), Meeting::touching) << "a vertex on the face";
  EXPECT_EQ(against({2, 2, 0}, {1, 1, 1}, {3, 3, 1}), Meeting::touching) << "a vertex on an edge";
  EXPECT_EQ(against({2, -1, -1}, {2, -1, 1}, {2, 0, 0}), Meeting::touching) << "a vertex on an edge from the side";
  EXPECT_EQ(against({1, 1, 0}, {2, 1, 0}, {1, 2, 0}), Meeting::touching) << "inside, in one plane";
  EXPECT_EQ(against({-1, -1, 0}, {9, -1, 0}, {-1, 9, 0}), Meeting::touching) << "around it, in one plane";
  EXPECT_EQ(against({4, 0, 0}, {5, 0, 0}, {4, 5, 0}), Meeting::touching) << "corner to corner, in one plane";
  EXPECT_EQ(against({-1, 1, 0}, {5, 1, 1}, {-1, 1, 1}), Meeting::none) << "over it";
  EXPECT_EQ(against({3, 3, -1}, {3, 3, 1}, {5, 5, 0}), Meeting::none) << "beside it";
  EXPECT_EQ(against({3, 3, 0}, {4, 3, 0}, {3, 4, 0}), Meeting::none) << "beside it, in one plane";
  EXPECT_EQ(against({1, 1, 1}, {2, 1, 1}, {1, 2, 1}), Meeting::none) << "parallel";
  EXPECT_EQ(against({1, 1, -1}, {1, 1, 0}, {1, 1, 1}), Meeting::none) << "a triangle without area";
}

TEST(Meeting, TellsTheLastBitOfAFloat) {
  const float above = std::nextafter(0.1F, 1.0F);
  const float below = std::nextafter(0.1F, 0.0F);
  const Corners flat{Vec3f(0, 0.1F, 0), Vec3f(1, 0.1F, 0), Vec3f(0, 0.1F, 1)};
  const auto standing = [](float lowest) {
    return Corners{Vec3f(0.25F, lowest, 0.25F), Vec3f(0.25F, 1, 0.25F), Vec3f(0.3F, 1, 0.25F)};
  };
  EXPECT_EQ(meeting(flat, standing(above)), Meeting::none);
  EXPECT_EQ(meeting(flat, standing(0.1F)), Meeting::touching);
  EXPECT_EQ(meeting(flat, standing(below)), Meeting::crossing);
}

TEST(Intersections, OfTwoBallsBeginWhereTheyMeet) {
  const TriangleMesh still = ball(Vec3d::Zero(), 1.0);
  EXPECT_TRUE(intersections(still, ball({2.001, 0.0, 0.0}, 1.0), kTwo).empty());
  EXPECT_TRUE(intersections(still, ball({0.0, 0.0, 0.0}, 0.9), kTwo).empty()) << "one inside the other";
  const TriangleMesh other = ball({1.2, 0.1, 0.0}, 1.0);
  const Pairs pairs = intersections(still, other, kTwo);
  ASSERT_FALSE(pairs.empty());
  // The surfaces meet on a circle in the middle plane, of radius sqrt(1 - (1.2042 / 2)^2) = 0.798: nowhere else.
  const Vec3d axis = Vec3d(1.2, 0.1, 0.0).normalized();
  for (const TrianglePair& pair : pairs) {
    const Vec3d centre =
        (still.corner(pair.first, 0) + still.corner(pair.first, 1) + still.corner(pair.first, 2)) / 3.0;
    EXPECT_NEAR(centre.dot(axis), 0.602, 0.15);
    EXPECT_NEAR((centre - centre.dot(axis) * axis).norm(), 0.798, 0.15);
  }
}

TEST(Intersections, OfBoxesFaceToFaceAreTouchOnly) {
  const TriangleMesh low = box(Vec3d::Zero(), Vec3d::Ones());
  const TriangleMesh high = box({0.25, 1.0, 0.25}, {0.75, 2.0, 0.75});
  EXPECT_FALSE(intersections(low, high, kTwo).empty());
  EXPECT_TRUE(intersections(low, high, kTwo, {false, 0.01}).empty());
  const TriangleMesh sunk = box({0.25, 0.9, 0.25}, {0.75, 2.0, 0.75});
  EXPECT_FALSE(intersections(low, sunk, kTwo, {false, 0.01}).empty());
}

/// A tube along an arc of a circle in the xy plane, open at its ends.
TriangleMesh bentTube(double radius, double thickness, double degrees) {
  constexpr std::uint32_t rings = 90;
  constexpr std::uint32_t spokes = 24;
  TriangleMesh tube;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    const double along = degrees * pi / 180.0 * i / rings;
    for (std::uint32_t j = 0; j < spokes; ++j) {
      const double around = 2.0 * pi * j / spokes;
      const double reach = radius + thickness * std::cos(around);
      tube.positions.emplace_back(
          Vec3d(reach * std::cos(along), reach * std::sin(along), thickness * std::sin(around)).cast<float>());
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t j = 0; j < spokes; ++j) {
      const std::uint32_t a = i * spokes + j;
      const std::uint32_t b = i * spokes + (j + 1) % spokes;
      tube.triangles.push_back({a, b + spokes, b});
      tube.triangles.push_back({a, a + spokes, b + spokes});
    }
  }
  return tube;
}

TEST(SelfIntersections, OfATubeBeginWhenItsEndsMeet) {
  EXPECT_TRUE(selfIntersections(bentTube(1.0, 0.3, 300.0), kTwo).empty());
  EXPECT_TRUE(selfIntersections(bentTube(1.0, 0.3, 350.0), kTwo).empty());
  // Beyond a full turn its end lies in its beginning.
  EXPECT_FALSE(selfIntersections(bentTube(1.0, 0.3, 380.0), kTwo).empty());
  // Bent more tightly than it is thick, it folds through its own axis.
  EXPECT_FALSE(selfIntersections(bentTube(0.25, 0.3, 200.0), kTwo, {false, 0.01}).empty());
}

TEST(SelfIntersections, OfSoundShapesAreNone) {
  EXPECT_TRUE(selfIntersections(ball({0.1, 0.2, 0.3}, 0.7), kTwo).empty());
  EXPECT_TRUE(selfIntersections(box(Vec3d::Zero(), {1.0, 2.0, 3.0}), kTwo).empty());
  EXPECT_TRUE(selfIntersections(TriangleMesh{}, kTwo).empty());
}

TEST(SelfIntersections, FindWhatFoldsAtACommonVertexOrEdge) {
  TriangleMesh mesh;
  mesh.positions = {Vec3f(0, 0, 0), Vec3f(2, 0, 0), Vec3f(0, 2, 0), Vec3f(1, 1, -1), Vec3f(1, 1, 1), Vec3f(-1, -1, 0)};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(selfIntersections(mesh, kTwo), (Pairs{{0, 1}})) << "through each other at a vertex";
  mesh.triangles = {{0, 1, 2}, {0, 4, 5}};
  EXPECT_TRUE(selfIntersections(mesh, kTwo).empty()) << "only the vertex is common";
  mesh.triangles = {{0, 1, 2}, {0, 2, 5}};
  EXPECT_TRUE(selfIntersections(mesh, kTwo).empty()) << "side by side in one plane";
  mesh.positions[5] = Vec3f(1, 0.5F, 0);
  EXPECT_EQ(selfIntersections(mesh, kTwo), (Pairs{{0, 1}})) << "folded flat";
  mesh.positions[5] = Vec3f(1, 0.5F, 0.005F);
  EXPECT_EQ(selfIntersections(mesh, kTwo), (Pairs{{0, 1}})) << "folded to less than half a degree";
  EXPECT_TRUE(selfIntersections(mesh, kTwo, {true, 0.0}).empty());
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(selfIntersections(mesh, kTwo), (Pairs{{0, 1}})) << "back to back";
}

Pairs everyPair(const TriangleMesh& a, const TriangleMesh& b, Meeting least) {
  Pairs pairs;
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      if (meeting(cornersOf(a, i), cornersOf(b, j)) >= least) {
        pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      }
    }
  }
  return pairs;
}

RC_GTEST_PROP(Intersections, AreThoseThatEveryPairTriedGives, ()) {
  const TriangleMesh a = test::moved(test::drawnSolid(Vec3d::Zero(), 0.1, 1.0), test::drawnMotion(0.5));
  const TriangleMesh b = test::drawnSolid(Vec3d::Zero(), 0.1, 1.0);
  RC_ASSERT(intersections(a, b, kTwo) == everyPair(a, b, Meeting::touching));
  RC_ASSERT(intersections(a, b, kTwo, {false, 0.01}) == everyPair(a, b, Meeting::crossing));
  RC_ASSERT(intersections(a, b, {1}) == intersections(a, b, {3}));
}

TEST(Intersections, OfLargeMeshesAreTheSameWithAnyNumberOfThreads) {
  const TriangleMesh a = ellipsoid(Vec3d::Zero(), {0.3, 0.9, 0.2}, 5);
  const TriangleMesh b = ellipsoid({0.001, 0.002, 0.0}, {0.3, 0.9, 0.2}, 5);
  TriangleMesh both = a;
  append(both, b);
  const Pairs pairs = intersections(a, b, {1});
  EXPECT_GT(pairs.size(), 500U);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  for (const int threads : {2, 3, 7}) {
    EXPECT_EQ(intersections(a, b, {threads}), pairs);
    EXPECT_EQ(selfIntersections(both, {threads}).size(), pairs.size());
  }
}

RC_GTEST_PROP(SelfIntersections, OfTwoSolidsInOneMeshAreThoseBetweenThem, ()) {
  const TriangleMesh a = test::moved(test::drawnSolid(Vec3d::Zero(), 0.1, 1.0), test::drawnMotion(0.5));
  const TriangleMesh b = test::drawnSolid(Vec3d::Zero(), 0.1, 1.0);
  TriangleMesh both = a;
  append(both, b);
  Pairs shifted = intersections(a, b, kTwo);
  for (TrianglePair& pair : shifted) {
    pair.second += static_cast<std::uint32_t>(a.triangles.size());
  }
  RC_ASSERT(selfIntersections(both, kTwo) == shifted);
}

using Vec3i = Eigen::Vector3i;
using GridTriangle = std::array<Vec3i, 3>;

/// A triangle on a coarse grid, so that faces often lie in one plane and edges often touch.
GridTriangle gridTriangle() {
  GridTriangle triangle;
  for (Vec3i& corner : triangle) {
    for (int axis = 0; axis < 3; ++axis) {
      corner[axis] = *rc::gen::resize(100, rc::gen::inRange(0, 4));
    }
  }
  return triangle;
}

/// The separating axis theorem in whole numbers: an oracle that is exact and shares no arithmetic with meeting().
bool apart(const GridTriangle& a, const GridTriangle& b) {
  const auto edges = [](const GridTriangle& t) { return GridTriangle{t[1] - t[0], t[2] - t[1], t[0] - t[2]}; };
  const Vec3i normalA = edges(a)[0].cross(edges(a)[1]);
  const Vec3i normalB = edges(b)[0].cross(edges(b)[1]);
  std::vector<Vec3i> axes{normalA, normalB};
  for (const Vec3i& u : edges(a)) {
    axes.emplace_back(normalA.cross(u));
    for (const Vec3i& v : edges(b)) {
      axes.emplace_back(u.cross(v));
      axes.emplace_back(normalB.cross(v));
    }
  }
  return std::any_of(axes.begin(), axes.end(), [&](const Vec3i& axis) {
    const auto [lowA, highA] = std::minmax({axis.dot(a[0]), axis.dot(a[1]), axis.dot(a[2])});
    const auto [lowB, highB] = std::minmax({axis.dot(b[0]), axis.dot(b[1]), axis.dot(b[2])});
    return highA < lowB || highB < lowA;
  });
}

Corners scaled(const GridTriangle& t, float by) {
  return {by * t[0].cast<float>(), by * t[1].cast<float>(), by * t[2].cast<float>()};
}

RC_GTEST_PROP(Meeting, IsThereWhereNoAxisSeparates, ()) {
  const GridTriangle a = gridTriangle();
  const GridTriangle b = gridTriangle();
  RC_PRE((a[1] - a[0]).cross(a[2] - a[0]) != Vec3i::Zero() && (b[1] - b[0]).cross(b[2] - b[0]) != Vec3i::Zero());
  const Meeting found = meeting(scaled(a, 1.0F), scaled(b, 1.0F));
  RC_ASSERT((found == Meeting::none) == apart(a, b));
  RC_ASSERT(found == meeting(scaled(b, 1.0F), scaled(a, 1.0F)));
  RC_ASSERT(found == meeting(scaled({a[1], a[2], a[0]}, 1.0F), scaled({b[2], b[1], b[0]}, 1.0F)));
  RC_ASSERT(found == meeting(scaled(a, 0.0009765625F), scaled(b, 0.0009765625F)));
}

}  // namespace
}  // namespace lorica::geometry
