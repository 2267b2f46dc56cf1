#include "lorica/geometry/closest_point.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "lorica/base/error.h"
#include "lorica/geometry/isosurface.h"
#include "lorica/geometry/winding.h"
#include "shapes.h"

namespace lorica::geometry {
namespace {

/// Nearest point of a triangle the slow way: of its plane when that is inside, else of its three sides.
Vec3d nearestOfTriangle(const Vec3d& query, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d normal = (b - a).cross(c - a);
  const std::array<Vec3d, 3> corners{a, b, c};
  if (normal.squaredNorm() > 0.0) {
    const Vec3d foot = query - normal * normal.dot(query - a) / normal.squaredNorm();
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d side = corners[(k + 1) % 3] - corners[k];
      inside = inside && side.cross(foot - corners[k]).dot(normal) >= 0.0;
    }
    if (inside) {
      return foot;
    }
  }
  Vec3d best = a;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d side = corners[(k + 1) % 3] - corners[k];
    const double length2 = side.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((query - corners[k]).dot(side) / length2, 0.0, 1.0) : 0.0;
    const Vec3d point = corners[k] + t * side;
    if ((point - query).norm() < (best - query).norm()) {
      best = point;
    }
  }
  return best;
}

double nearestOfMesh(const TriangleMesh& mesh, const Vec3d& query) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d point = nearestOfTriangle(query, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
    best = std::min(best, (point - query).norm());
  }
  return best;
}

/// Points in and around a mesh; every third lies on the perpendicular through a vertex or on a corner itself.
Vec3d drawnQuery(const TriangleMesh& mesh) {
  const Vec3d anywhere = test::drawnPoint(-2.0, 2.0);
  const auto vertex = *rc::gen::inRange<std::size_t>(0, mesh.positions.size());
  switch (*rc::gen::inRange(0, 3)) {
    case 0:
      return mesh.positions[vertex].cast<double>();
    case 1:
      return mesh.positions[vertex].cast<double>() * test::drawn(0.0, 2.0);
    default:
      return anywhere;
  }
}

RC_GTEST_PROP(ClosestPoint, IsThatOfBruteForce, ()) {
  TriangleMesh mesh = test::drawnSolid(test::drawnPoint(-0.5, 0.5), 0.2, 1.0);
  append(mesh, test::drawnSolid(test::drawnPoint(-1.5, 1.5), 0.1, 0.5));
  const ClosestPointTree tree(mesh);
  const Vec3d query = drawnQuery(mesh);
  const auto found = tree.closest(query);
  RC_ASSERT(found.has_value());
  const double expected = nearestOfMesh(mesh, query);
  RC_ASSERT(std::abs(found->distance - expected) <= 1e-12);
  RC_ASSERT(std::abs((found->point - query).norm() - expected) <= 1e-12);
  RC_ASSERT(std::abs(found->barycentric.sum() - 1.0) <= 1e-12);
  RC_ASSERT(found->barycentric.minCoeff() >= 0.0);
  const Vec3d rebuilt = found->barycentric[0] * mesh.corner(found->triangle, 0) +
                        found->barycentric[1] * mesh.corner(found->triangle, 1) +
                        found->barycentric[2] * mesh.corner(found->triangle, 2);
  RC_ASSERT((rebuilt - found->point).norm() <= 1e-12);
}

RC_GTEST_PROP(ClosestPoint, OfTrianglesWithoutAreaIsThatOfTheirSides, ()) {
  const Vec3d a = test::drawnPoint(-1.0, 1.0);
  const Vec3d b = test::drawnPoint(-1.0, 1.0);
  const double t = test::drawn(-1.0, 2.0);
  const Vec3d c = *rc::gen::arbitrary<bool>() ? Vec3d(a + t * (b - a)) : a;
  const Vec3d query = test::drawnPoint(-2.0, 2.0);
  const Vec3d barycentric = closestBarycentric(query, a, b, c);
  const Vec3d point = barycentric[0] * a + barycentric[1] * b + barycentric[2] * c;
  RC_ASSERT(std::abs((point - query).norm() - (nearestOfTriangle(query, a, b, c) - query).norm()) <= 1e-7);
}

RC_GTEST_PROP(ClosestPoint, IsFoundWithinItsRadiusOnly, ()) {
  const TriangleMesh mesh = test::drawnSolid(Vec3d::Zero(), 0.2, 1.0);
  const ClosestPointTree tree(mesh);
  const Vec3d query = test::drawnPoint(-2.0, 2.0);
  const double distance = nearestOfMesh(mesh, query);
  RC_PRE(distance > 1e-6);
  RC_ASSERT(!tree.closest(query, distance * 0.999).has_value());
  RC_ASSERT(tree.closest(query, distance * 1.001).has_value());
}

/// Two balls that melt into each other behind a saddle: convex, concave and saddle-shaped edges and vertices.
TriangleMesh peanut() {
  return isosurface(
      [](const Vec3d& p) {
        const double first = (p - Vec3d(0.45, 0.1, 0)).norm() - 0.5;
        const double second = (p + Vec3d(0.45, 0, 0.2)).norm() - 0.4;
        return std::min({first, second, std::hypot(p.y(), p.z()) - 0.2 + 10.0 * std::max(std::abs(p.x()) - 0.4, 0.0)});
      },
      Box3d(Vec3d::Constant(-1.3), Vec3d::Constant(1.3)), 0.11);
}

TEST(SignedDistance, HasTheSignOfTheWindingNumber) {
  const TriangleMesh mesh = peanut();
  const ClosestPointTree tree(mesh);
  std::size_t inside = 0;
  for (int i = -12; i <= 12; ++i) {
    for (int j = -7; j <= 7; ++j) {
      for (int k = -7; k <= 7; ++k) {
        const Vec3d query(0.083 * i, 0.097 * j, 0.089 * k);
        const double distance = tree.signedDistance(query);
        if (std::abs(distance) < 1e-9) {
          continue;
        }
        const bool within = windingNumber(mesh, query) > 0.5;
        inside += within ? 1 : 0;
        ASSERT_EQ(distance < 0.0, within) << query.transpose();
      }
    }
  }
  EXPECT_GT(inside, 200U);
}

RC_GTEST_PROP(SignedDistance, OfABoxIsTheKnownOne, ()) {
  const Vec3d half = test::drawnPoint(0.2, 1.0);
  const TriangleMesh mesh = box(-half, half);
  const Vec3d query = test::drawnPoint(-1.5, 1.5);
  const Vec3d away = query.cwiseAbs() - half;
  const double known = away.cwiseMax(Vec3d::Zero()).norm() + std::min(away.maxCoeff(), 0.0);
  // The box's corners are floats, the known distance is not.
  RC_ASSERT(std::abs(ClosestPointTree(mesh).signedDistance(query) - known) <= 1e-6);
}

TEST(ClosestPoint, OfNothingIsNothing) {
  const ClosestPointTree tree{TriangleMesh{}};
  EXPECT_FALSE(tree.closest({0, 0, 0}).has_value());
  EXPECT_THROW(tree.signedDistance({0, 0, 0}), base::CallerError);
}

TEST(ClosestPoint, OfSeveralEquallyNearTrianglesIsTheFirst) {
  // The corner (1, 1, 1) of a box belongs to several triangles.
  const TriangleMesh mesh = box({-1, -1, -1}, {1, 1, 1});
  const auto found = ClosestPointTree(mesh).closest({2, 2, 2});
  ASSERT_TRUE(found.has_value());
  std::uint32_t first = 0;
  while (mesh.corner(first, 0) != Vec3d(1, 1, 1) && mesh.corner(first, 1) != Vec3d(1, 1, 1) &&
         mesh.corner(first, 2) != Vec3d(1, 1, 1)) {
    ++first;
  }
  EXPECT_EQ(found->triangle, first);
}

}  // namespace
}  // namespace lorica::geometry
