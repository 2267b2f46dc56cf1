#include "lorica/geometry/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/geometry/winding.h"
#include "shapes.h"

namespace lorica::geometry {
namespace {

using std::numbers::pi;

Box3d cubeAround(const Vec3d& centre, double half) {
  return {centre - Vec3d::Constant(half), centre + Vec3d::Constant(half)};
}

void expectClosedManifold(const TriangleMesh& mesh) {
  const MeshAudit found = audit(mesh);
  EXPECT_TRUE(found.closed());
  EXPECT_EQ(found.boundaryEdges, 0U);
  EXPECT_EQ(found.oddEdges, 0U);
  EXPECT_EQ(found.degenerateTriangles, 0U);
  for (const Component& component : found.components) {
    EXPECT_GT(component.signedVolume, 0.0);
  }
}

TEST(Isosurface, OfASphereIsTheSphere) {
  const Vec3d centre(0.013, 1.1, -0.27);
  constexpr double radius = 0.5;
  constexpr double cell = 0.03;
  const TriangleMesh mesh =
      isosurface([&](const Vec3d& p) { return (p - centre).norm() - radius; }, cubeAround(centre, 0.6), cell);
  expectClosedManifold(mesh);
  EXPECT_EQ(audit(mesh).components.size(), 1U);
  EXPECT_EQ(test::eulerCharacteristic(mesh), 2);
  EXPECT_NEAR(signedVolume(mesh) / (4.0 / 3.0 * pi * std::pow(radius, 3)), 1.0, 0.01);
  EXPECT_NEAR(windingNumber(mesh, centre), 1.0, 1e-9);
  for (const Vec3f& vertex : mesh.positions) {
    // The field bends by cell^2 / (8 radius) between grid points; a cell away would already be wrong.
    EXPECT_NEAR((vertex.cast<double>() - centre).norm(), radius, cell * cell / (4 * radius));
  }
}

TEST(Isosurface, OfATorusHasItsHole) {
  const auto torus = [](const Vec3d& p) { return std::hypot(std::hypot(p.x(), p.z()) - 0.7, p.y()) - 0.2; };
  const TriangleMesh mesh = isosurface(torus, cubeAround(Vec3d::Zero(), 1.0), 0.041);
  expectClosedManifold(mesh);
  EXPECT_EQ(test::eulerCharacteristic(mesh), 0);
  EXPECT_NEAR(signedVolume(mesh) / (2 * pi * pi * 0.7 * 0.04), 1.0, 0.03);
}

TEST(Isosurface, OfTwoBallsHasTwoPieces) {
  const auto balls = [](const Vec3d& p) {
    return std::min((p - Vec3d(0.5, 0, 0)).norm(), (p + Vec3d(0.5, 0, 0)).norm()) - 0.3;
  };
  const TriangleMesh mesh = isosurface(balls, cubeAround(Vec3d::Zero(), 1.0), 0.047);
  expectClosedManifold(mesh);
  EXPECT_EQ(audit(mesh).components.size(), 2U);
}

TEST(Isosurface, IsClosedWhereTheFieldVanishesOnGridPoints) {
  // Cells and sizes are powers of two, so whole faces of the cube lie on grid points.
  for (const double cell : {0.25, 0.0625}) {
    const TriangleMesh mesh = isosurface([](const Vec3d& p) { return p.lpNorm<Eigen::Infinity>() - 1.0; },
                                         cubeAround(Vec3d::Zero(), 1.5), cell);
    expectClosedManifold(mesh);
    EXPECT_EQ(test::eulerCharacteristic(mesh), 2);
    // Marching cubes cuts the cube's edges, at most half a cell square along each.
    EXPECT_LE(signedVolume(mesh), 8.0 + 1e-5);
    EXPECT_GE(signedVolume(mesh), 8.0 - 12 * 2.0 * cell * cell / 2);
  }
}

TEST(Isosurface, IsClosedWhereASphereTouchesGridPoints) {
  for (const double cell : {0.25, 0.03125, 0.0078125}) {
    for (const double away : {0.0, 1.0, 1000.0}) {
      const Vec3d centre = Vec3d::Constant(away);
      const double radius = 16 * cell;
      const TriangleMesh mesh =
          isosurface([&](const Vec3d& p) { return (p - centre).norm() - radius; }, cubeAround(centre, 20 * cell), cell);
      expectClosedManifold(mesh);
      EXPECT_EQ(test::eulerCharacteristic(mesh), 2);
    }
  }
}

TEST(Isosurface, OfAFieldWithoutInsideIsEmpty) {
  const TriangleMesh mesh = isosurface([](const Vec3d&) { return 1.0; }, cubeAround(Vec3d::Zero(), 1.0), 0.25);
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(Isosurface, AsksForTheFieldOncePerGridPointAndCoversTheBox) {
  Box3d asked;
  std::size_t calls = 0;
  const Box3d box(Vec3d(-1, 0, 2), Vec3d(0.1, 0.5, 2.9));
  isosurface(
      [&](const Vec3d& p) {
        asked.extend(p);
        ++calls;
        return 1.0;
      },
      box, 0.25);
  EXPECT_EQ(calls, 6U * 3U * 5U);
  EXPECT_TRUE(asked.contains(box));
}

TEST(Isosurface, RefusesGridsItCannotMake) {
  const auto field = [](const Vec3d&) { return 1.0; };
  EXPECT_THROW(isosurface(field, cubeAround(Vec3d::Zero(), 1.0), 0.0), base::CallerError);
  EXPECT_THROW(isosurface(field, cubeAround(Vec3d::Zero(), 1.0), -1.0), base::CallerError);
  EXPECT_THROW(isosurface(field, Box3d(), 0.1), base::CallerError);
  EXPECT_THROW(isosurface(field, cubeAround(Vec3d::Zero(), 1.0), 1e-3), base::CallerError);
}

TEST(Isosurface, ThatSkipsWhatIsFarIsTheSameAtAnyNumberOfThreads) {
  const auto field = [](const Vec3d& p) { return p.norm() - 0.5; };
  const Box3d box = cubeAround(Vec3d::Zero(), 0.63);
  const TriangleMesh whole = isosurface(field, box, 0.02);
  for (const int threads : {1, 3}) {
    const TriangleMesh sparse = isosurface(field, box, 0.02, 1.0, {threads});
    EXPECT_TRUE(sparse.positions == whole.positions);
    EXPECT_TRUE(sparse.triangles == whole.triangles);
  }
}

}  // namespace
}  // namespace lorica::geometry
