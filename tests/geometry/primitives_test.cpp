#include "lorica/geometry/primitives.h"

#include <gtest/gtest.h>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "shapes.h"

namespace lorica::geometry {
namespace {

void expectOneClosedManifold(const TriangleMesh& mesh) {
  const MeshAudit found = audit(mesh);
  EXPECT_TRUE(found.closed());
  EXPECT_EQ(found.components.size(), 1U);
  EXPECT_EQ(found.oddEdges, 0U);
  EXPECT_EQ(found.degenerateTriangles, 0U);
  EXPECT_EQ(test::eulerCharacteristic(mesh), 2);
}

/// Every triangle of a star-shaped solid must face away from its centre; the volume alone would forgive one that does
/// not.
void expectEveryTriangleFacesAwayFrom(const TriangleMesh& mesh, const Vec3d& centre) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0);
    EXPECT_GT((a - centre).dot((mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a)), 0.0) << "triangle " << t;
  }
}

TEST(Ellipsoid, IsClosedOutwardAndFourfoldFinerPerLevel) {
  const Vec3d centre(1, -2, 0.5);
  std::size_t triangles = 20;
  for (int level = 0; level <= 5; ++level, triangles *= 4) {
    const TriangleMesh mesh = ellipsoid(centre, Vec3d(0.2, 0.4, 0.8), level);
    EXPECT_EQ(mesh.triangles.size(), triangles);
    expectOneClosedManifold(mesh);
    expectEveryTriangleFacesAwayFrom(mesh, centre);
  }
}

TEST(Ellipsoid, HasItsVerticesOnTheSurface) {
  const Vec3d centre(1, -2, 0.5);
  const Vec3d axes(0.2, 0.4, 0.8);
  for (const Vec3f& vertex : ellipsoid(centre, axes, 4).positions) {
    EXPECT_NEAR((vertex.cast<double>() - centre).cwiseQuotient(axes).norm(), 1.0, 2e-6);
  }
}

TEST(Ellipsoid, RefusesWhatItCannotRefine) {
  EXPECT_THROW(ellipsoid(Vec3d::Zero(), Vec3d(1, 1, 1), -1), base::CallerError);
  EXPECT_THROW(ellipsoid(Vec3d::Zero(), Vec3d(1, 1, 1), 10), base::CallerError);
}

TEST(Box, IsClosedOutwardAndHasItsCorners) {
  const TriangleMesh mesh = box(Vec3d(-1, -2, -3), Vec3d(3, 2, 1));
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_EQ(bounds(mesh.positions).min(), Vec3d(-1, -2, -3));
  EXPECT_EQ(bounds(mesh.positions).max(), Vec3d(3, 2, 1));
  expectOneClosedManifold(mesh);
  expectEveryTriangleFacesAwayFrom(mesh, Vec3d(1, 0, -1));
}

TEST(Append, ShiftsTheIndicesOfThePart) {
  TriangleMesh mesh = box(Vec3d::Zero(), Vec3d(1, 1, 1));
  const TriangleMesh part = box(Vec3d(4, 0, 0), Vec3d(5, 2, 1));
  append(mesh, part);
  ASSERT_EQ(mesh.positions.size(), 16U);
  ASSERT_EQ(mesh.triangles.size(), 24U);
  for (std::size_t t = 0; t < 12; ++t) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.corner(12 + t, k), part.corner(t, k));
    }
  }
  EXPECT_DOUBLE_EQ(signedVolume(mesh), 3.0);
}

}  // namespace
}  // namespace lorica::geometry
