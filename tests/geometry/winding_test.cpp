#include "lorica/geometry/winding.h"

#include <gtest/gtest.h>

#include <utility>

#include "lorica/geometry/primitives.h"

namespace lorica::geometry {
namespace {

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
  for (const TriangleMesh& mesh :
       {box(Vec3d(-1, -2, -3), Vec3d(1, 2, 3)), ellipsoid(Vec3d::Zero(), Vec3d(1, 2, 3), 3)}) {
    for (const Vec3d& inside : {Vec3d(0, 0, 0), Vec3d(0.5, -0.6, 1.0), Vec3d(-0.9, 0.1, -0.1)}) {
      EXPECT_NEAR(windingNumber(mesh, inside), 1.0, 1e-12);
    }
    for (const Vec3d& outside : {Vec3d(1.5, 0, 0), Vec3d(0, -2.1, 0), Vec3d(100, 100, 100)}) {
      EXPECT_NEAR(windingNumber(mesh, outside), 0.0, 1e-12);
    }
  }
}

TEST(WindingNumber, CountsOverlappingSolids) {
  TriangleMesh mesh = box(Vec3d(0, 0, 0), Vec3d(2, 2, 2));
  append(mesh, box(Vec3d(1, 1, 1), Vec3d(3, 3, 3)));
  EXPECT_NEAR(windingNumber(mesh, Vec3d(1.5, 1.4, 1.3)), 2.0, 1e-12);
  EXPECT_NEAR(windingNumber(mesh, Vec3d(0.5, 0.4, 0.3)), 1.0, 1e-12);
  EXPECT_NEAR(windingNumber(mesh, Vec3d(2.5, 2.4, 2.3)), 1.0, 1e-12);
  EXPECT_NEAR(windingNumber(mesh, Vec3d(2.5, 0.4, 0.3)), 0.0, 1e-12);
}

TEST(WindingNumber, IsMinusOneInsideAnInsideOutSolid) {
  TriangleMesh mesh = box(Vec3d(0, 0, 0), Vec3d(2, 2, 2));
  for (Triangle& triangle : mesh.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  EXPECT_NEAR(windingNumber(mesh, Vec3d(0.7, 1.1, 0.4)), -1.0, 1e-12);
}

TEST(WindingNumber, OfOneBoxSideSeenFromTheMiddleIsOneSixth) {
  TriangleMesh mesh = box(Vec3d(-1, -1, -1), Vec3d(1, 1, 1));
  mesh.triangles.resize(2);  // two triangles make a side
  EXPECT_NEAR(windingNumber(mesh, Vec3d::Zero()), 1.0 / 6.0, 1e-12);
}

}  // namespace
}  // namespace lorica::geometry
