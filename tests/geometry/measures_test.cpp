#include "lorica/geometry/measures.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <numeric>

#include <cmath>
#include <numbers>

#include "shapes.h"

namespace lorica::geometry {
namespace {

using std::numbers::pi;

/// What rounding each coordinate up to 16 m to a float can move a vertex by.
constexpr double vertexRounding = 1e-6;

double perimeters(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      sum += (mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k)).norm();
    }
  }
  return sum;
}

TEST(Measures, OfABoxAreExact) {
  const TriangleMesh mesh = box(Vec3d(-1, 2, 0.5), Vec3d(1, 5, 4.5));
  EXPECT_DOUBLE_EQ(signedVolume(mesh), 2.0 * 3.0 * 4.0);
  EXPECT_DOUBLE_EQ(area(mesh), 2.0 * (2 * 3 + 3 * 4 + 4 * 2));
  EXPECT_LT((centroid(mesh) - Vec3d(0, 3.5, 2.5)).norm(), 1e-14);
}

TEST(Measures, OfABoxAreExactAKilometreAway) {
  // Floats near 1000 hold steps of 1/16384, so these corners are exact.
  const Vec3d low(1000.0, -1000.0, 1000.0);
  const Vec3d size(0.25, 0.0625, 0.0009765625);
  const TriangleMesh mesh = box(low, low + size);
  EXPECT_NEAR(signedVolume(mesh), size.prod(), 1e-12 * size.prod());
  EXPECT_NEAR(area(mesh), 2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x()), 1e-14);
  EXPECT_LT((centroid(mesh) - (low + size / 2)).norm(), 1e-12);
}

TEST(Measures, OfAnEllipsoidApproachTheAnalyticOnes) {
  const Vec3d axes(0.3, 0.3, 0.5);
  const double volume = 4.0 / 3.0 * pi * axes.prod();
  const double eccentricity = std::sqrt(1.0 - 0.09 / 0.25);
  const double surface = 2.0 * pi * 0.09 * (1.0 + 0.5 / (0.3 * eccentricity) * std::asin(eccentricity));
  double volumeError = 0.0;
  double areaError = 0.0;
  for (int level = 2; level <= 5; ++level) {
    const TriangleMesh mesh = ellipsoid(Vec3d(1, 2, 3), axes, level);
    const double volumeNow = 1.0 - signedVolume(mesh) / volume;
    const double areaNow = 1.0 - area(mesh) / surface;
    EXPECT_GT(volumeNow, 0.0) << "an inscribed mesh is smaller";
    EXPECT_GT(areaNow, 0.0);
    if (level > 2) {
      EXPECT_NEAR(volumeError / volumeNow, 4.0, 0.3) << "halving the edges quarters the error";
      EXPECT_NEAR(areaError / areaNow, 4.0, 0.3);
    }
    volumeError = volumeNow;
    areaError = areaNow;
    EXPECT_LT((centroid(mesh) - Vec3d(1, 2, 3)).norm(), 1e-6);
  }
  EXPECT_LT(volumeError, 1e-3);
  EXPECT_LT(areaError, 1e-3);
}

TEST(Measures, OfAnEllipsoidSurviveAKilometre) {
  const Vec3d centre(1000, 1000, -1000);
  const Vec3d axes(0.3, 0.4, 0.5);
  const TriangleMesh mesh = ellipsoid(centre, axes, 4);
  EXPECT_NEAR(signedVolume(mesh) / (4.0 / 3.0 * pi * axes.prod()), 1.0, 5e-3);
  EXPECT_NEAR(area(mesh) / area(ellipsoid(Vec3d::Zero(), axes, 4)), 1.0, 1e-3);
  EXPECT_LT((centroid(mesh) - centre).norm(), 1e-5);
}

TEST(Measures, OfNothingAreZero) {
  EXPECT_EQ(signedVolume({}), 0.0);
  EXPECT_EQ(area({}), 0.0);
  EXPECT_EQ(centroid({}), Vec3d::Zero());
  EXPECT_TRUE(bounds({}).isEmpty());
}

TEST(SignedVolume, IsNegativeInsideOut) {
  const TriangleMesh mesh = test::insideOut(box(Vec3d::Zero(), Vec3d(1, 2, 3)));
  EXPECT_DOUBLE_EQ(signedVolume(mesh), -6.0);
  EXPECT_DOUBLE_EQ(area(mesh), 22.0);
  EXPECT_LT((centroid(mesh) - Vec3d(0.5, 1, 1.5)).norm(), 1e-14);
}

TEST(Centroid, OfTwoBoxesIsWeighedByVolumeNotByArea) {
  TriangleMesh mesh = box(Vec3d::Zero(), Vec3d(2, 2, 2));
  append(mesh, box(Vec3d(3, 0, 0), Vec3d(4, 1, 1)));
  const Vec3d expected = (8.0 * Vec3d(1, 1, 1) + 1.0 * Vec3d(3.5, 0.5, 0.5)) / 9.0;
  EXPECT_LT((centroid(mesh) - expected).norm(), 1e-14);
}

TEST(Centroid, OfASheetIsThatOfItsSurface) {
  TriangleMesh sheet;
  sheet.positions = {{0, 0, 1}, {4, 0, 1}, {4, 2, 1}, {0, 2, 1}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_LT((centroid(sheet) - Vec3d(2, 1, 1)).norm(), 1e-14);
}

TEST(Bounds, EnclosePointsTightly) {
  const Positions points = {{1, -2, 3}, {-1, 5, 0}, {0, 0, 7}};
  EXPECT_EQ(bounds(points).min(), Vec3d(-1, -2, 0));
  EXPECT_EQ(bounds(points).max(), Vec3d(1, 5, 7));
}

RC_GTEST_PROP(Measures, MoveWithTheMesh, ()) {
  const TriangleMesh mesh = test::drawnSolid(test::drawnPoint(-1, 1), 0.1, 1.0);
  const RigidTransform motion = test::drawnMotion(8.0);
  const TriangleMesh there = test::moved(mesh, motion);
  RC_ASSERT(std::abs(signedVolume(there) - signedVolume(mesh)) <= area(mesh) * vertexRounding);
  RC_ASSERT(std::abs(area(there) - area(mesh)) <= perimeters(mesh) * vertexRounding);
  // A vertex that moves by r moves the centroid by no more than area * size / volume * r.
  const double lever = area(mesh) * 4.0 / signedVolume(mesh);
  RC_ASSERT((centroid(there) - motion * centroid(mesh)).norm() <= lever * vertexRounding);
}

TEST(VertexNormals, OfASpherePointOutwards) {
  const Vec3d centre(5, -3, 2);
  const TriangleMesh mesh = ellipsoid(centre, Vec3d(0.5, 0.5, 0.5), 3);
  const std::vector<Vec3f> normals = vertexNormals(mesh.positions, mesh.triangles);
  ASSERT_EQ(normals.size(), mesh.positions.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3d outward = (mesh.positions[v].cast<double>() - centre).normalized();
    EXPECT_GT(normals[v].cast<double>().dot(outward), 0.999);
    EXPECT_NEAR(normals[v].norm(), 1.0F, 1e-6F);
  }
}

TEST(VertexNormals, AreWeighedByArea) {
  // Around vertex 0: area 1/2 facing +z and area 4/2 facing +x.
  const Positions positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -4}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 3, 2}};
  const std::vector<Vec3f> normals = vertexNormals(positions, triangles);
  EXPECT_LT((normals[0] - Vec3f(4, 0, 1).normalized()).norm(), 1e-6F);
  EXPECT_LT((normals[1] - Vec3f(0, 0, 1)).norm(), 1e-6F);
  EXPECT_LT((normals[3] - Vec3f(1, 0, 0)).norm(), 1e-6F);
}

TEST(VertexNormals, AreZeroWithoutArea) {
  const Positions positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  for (const Vec3f& normal : vertexNormals(positions, triangles)) {
    EXPECT_EQ(normal, Vec3f(Vec3f::Zero()));
  }
}

TEST(Measures, AreasOfTheVerticesAreThoseOfTheCornersAndMakeTheWhole) {
  const TriangleMesh mesh = box({0, 0, 0}, {1, 2, 3});
  const std::vector<double> areas = vertexAreas(mesh);
  ASSERT_EQ(areas.size(), mesh.positions.size());
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), area(mesh), 1e-12);
  const TriangleMesh one{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {9, 9, 9}}, {{0, 1, 2}}};
  EXPECT_EQ(vertexAreas(one), (std::vector<double>{2.0, 2.0, 2.0, 0.0}));
}

}  // namespace
}  // namespace lorica::geometry
