#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <span>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::viewport {

/// A mesh as VTK draws it. Triangles, vertices and normals are used where they are: whoever calls show() keeps them
/// alive and unchanged until the next show() or the end of the actor.
class MeshActor {
 public:
  explicit MeshActor(std::span<const geometry::Triangle> triangles);
  MeshActor(const MeshActor&) = delete;
  MeshActor& operator=(const MeshActor&) = delete;

  /// \pre as many normals as positions
  void show(std::span<const geometry::Vec3f> positions, std::span<const geometry::Vec3f> normals);
  vtkActor* actor() { return actor_; }
  vtkPolyData* data() { return data_; }

 private:
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkActor> actor_;
};

}  // namespace lorica::viewport
