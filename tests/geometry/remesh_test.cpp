#include "lorica/geometry/remesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/geometry/isosurface.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"

namespace lorica::geometry {
namespace {

constexpr double kRing = 0.30;
constexpr double kTube = 0.12;

double torus(const Vec3d& p) {
  return std::hypot(std::hypot(p.x(), p.y()) - kRing, p.z()) - kTube;
}
Vec3d ontoTorus(const Vec3d& p) {
  const Vec3d middle = kRing * Vec3d(p.x(), p.y(), 0.0).normalized();
  return middle + kTube * (p - middle).normalized();
}
const TriangleMesh& rough() {
  static const TriangleMesh mesh = isosurface(torus, Box3d(Vec3d::Constant(-0.5), Vec3d::Constant(0.5)), 0.023);
  return mesh;
}

struct Shape {
  double smallestAngle = 180.0;  ///< degrees
  double shareNearWanted = 0.0;
};

Shape shapeOf(const TriangleMesh& mesh, const std::function<double(const Vec3d&)>& wanted) {
  Shape shape;
  std::size_t near = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec3d a = mesh.corner(t, k);
      const Vec3d u = mesh.corner(t, (k + 1) % 3) - a;
      const Vec3d v = mesh.corner(t, (k + 2) % 3) - a;
      const double angle = std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi;
      shape.smallestAngle = std::min(shape.smallestAngle, angle);
      const double ratio = u.norm() / wanted(a + 0.5 * u);
      near += ratio > 0.6 && ratio < 1.6 ? 1 : 0;
    }
  }
  shape.shareNearWanted = static_cast<double>(near) / (3.0 * static_cast<double>(mesh.triangles.size()));
  return shape;
}

RemeshOptions options(std::function<double(const Vec3d&)> wanted) {
  RemeshOptions o;
  o.edgeLength = std::move(wanted);
  o.project = ontoTorus;
  return o;
}

TEST(Remesh, GivesEvenTrianglesOfTheWantedLengthOnTheSurface) {
  for (const double length : {0.01, 0.02, 0.04}) {
    const auto wanted = [length](const Vec3d&) { return length; };
    const TriangleMesh mesh = remeshed(rough(), options(wanted));
    const Shape shape = shapeOf(mesh, wanted);
    EXPECT_GT(shape.smallestAngle, 20.0) << length;
    EXPECT_GT(shape.shareNearWanted, 0.98) << length;
    for (const Vec3f& p : mesh.positions) {
      EXPECT_NEAR(torus(p.cast<double>()), 0.0, 1e-6);
    }
    // The inscribed polyhedron lacks little of 2 pi^2 R r^2.
    const double volume = 2.0 * std::numbers::pi * std::numbers::pi * kRing * kTube * kTube;
    EXPECT_NEAR(signedVolume(mesh), volume, volume * 0.6 * length * length / (kTube * kTube));
  }
}

TEST(Remesh, KeepsTheGenusAndStaysAClosedManifold) {
  const TriangleMesh mesh = remeshed(rough(), options([](const Vec3d&) { return 0.03; }));
  const MeshAudit found = audit(mesh);
  EXPECT_TRUE(found.closed());
  EXPECT_EQ(found.oddEdges, 0u);
  EXPECT_EQ(found.components.size(), 1u);
  const auto vertices = static_cast<long>(mesh.positions.size());
  const auto faces = static_cast<long>(mesh.triangles.size());
  EXPECT_EQ(vertices - 3 * faces / 2 + faces, 0);
}

TEST(Remesh, FollowsALengthThatVaries) {
  const auto wanted = [](const Vec3d& p) { return 0.02 + 0.04 * std::abs(p.x()); };
  const TriangleMesh mesh = remeshed(rough(), options(wanted));
  const Shape shape = shapeOf(mesh, wanted);
  EXPECT_GT(shape.smallestAngle, 15.0);
  EXPECT_GT(shape.shareNearWanted, 0.95);
}

TEST(Remesh, GivesTheSameBytesAtAnyNumberOfThreads) {
  RemeshOptions one = options([](const Vec3d&) { return 0.02; });
  one.threads = {1};
  RemeshOptions five = one;
  five.threads = {5};
  const TriangleMesh a = remeshed(rough(), one);
  const TriangleMesh b = remeshed(rough(), five);
  EXPECT_TRUE(a.positions == b.positions);
  EXPECT_TRUE(a.triangles == b.triangles);
}

}  // namespace
}  // namespace lorica::geometry
