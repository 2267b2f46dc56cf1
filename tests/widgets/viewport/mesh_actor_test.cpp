#include "mesh_actor.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"

namespace lorica::viewport {
namespace {

TEST(MeshActor, VerticesNormalsAndTrianglesReachVtkWithoutACopy) {
  const geometry::TriangleMesh ball = geometry::ellipsoid(geometry::Vec3d::Zero(), geometry::Vec3d::Ones(), 2);
  const std::vector<geometry::Vec3f> normals = geometry::vertexNormals(ball.positions, ball.triangles);
  MeshActor actor(ball.triangles);
  actor.show(ball.positions, normals);
  vtkPolyData* data = actor.data();
  EXPECT_EQ(data->GetPoints()->GetVoidPointer(0), ball.positions.data());
  EXPECT_EQ(data->GetPointData()->GetNormals()->GetVoidPointer(0), normals.data());
  EXPECT_EQ(data->GetPolys()->GetConnectivityArray()->GetVoidPointer(0), ball.triangles.data());
  EXPECT_EQ(data->GetNumberOfPoints(), static_cast<vtkIdType>(ball.positions.size()));
  EXPECT_EQ(data->GetNumberOfCells(), static_cast<vtkIdType>(ball.triangles.size()));
}

TEST(MeshActor, AnotherFrameIsTakenFromWhereItIs) {
  const geometry::TriangleMesh ball = geometry::ellipsoid(geometry::Vec3d::Zero(), geometry::Vec3d::Ones(), 1);
  const std::vector<geometry::Vec3f> normals = geometry::vertexNormals(ball.positions, ball.triangles);
  geometry::Positions moved = ball.positions;
  for (geometry::Vec3f& vertex : moved) {
    vertex.x() += 5.0F;
  }
  MeshActor actor(ball.triangles);
  actor.show(ball.positions, normals);
  const vtkMTimeType before = actor.data()->GetMTime();
  actor.show(moved, normals);
  EXPECT_EQ(actor.data()->GetPoints()->GetVoidPointer(0), moved.data());
  EXPECT_GT(actor.data()->GetMTime(), before) << "or nothing would be drawn anew";
  EXPECT_NEAR(actor.data()->GetBounds()[0], 4.0, 1e-5);
}

TEST(MeshActor, CoarseTrianglesAreDrawnOverTheSameVerticesUntilAllAreWantedAgain) {
  const geometry::TriangleMesh ball = geometry::ellipsoid(geometry::Vec3d::Zero(), geometry::Vec3d::Ones(), 2);
  const std::vector<geometry::Vec3f> normals = geometry::vertexNormals(ball.positions, ball.triangles);
  MeshActor actor(ball.triangles);
  actor.show(ball.positions, normals);
  const auto few =
      std::make_shared<const std::vector<geometry::Triangle>>(ball.triangles.begin(), ball.triangles.begin() + 7);
  actor.drawCoarsely(few);
  EXPECT_EQ(actor.actor()->GetMapper()->GetInput(), actor.data());
  EXPECT_EQ(actor.data()->GetNumberOfCells(), 7);
  EXPECT_EQ(actor.data()->GetPolys()->GetConnectivityArray()->GetVoidPointer(0), few->data());
  EXPECT_EQ(actor.data()->GetPoints()->GetVoidPointer(0), ball.positions.data());
  EXPECT_EQ(actor.data()->GetPointData()->GetNormals()->GetVoidPointer(0), normals.data());

  geometry::Positions moved = ball.positions;
  moved.front().x() += 5.0F;
  actor.show(moved, normals);
  EXPECT_EQ(actor.data()->GetPoints()->GetVoidPointer(0), moved.data()) << "a frame reaches what is drawn";

  actor.drawCoarsely(nullptr);
  EXPECT_EQ(actor.actor()->GetMapper()->GetInput(), actor.data());
  EXPECT_EQ(actor.data()->GetNumberOfCells(), static_cast<vtkIdType>(ball.triangles.size()));
  EXPECT_EQ(actor.data()->GetPoints()->GetVoidPointer(0), moved.data());
}

}  // namespace
}  // namespace lorica::viewport
