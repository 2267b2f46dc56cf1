#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

#include <array>
#include <memory>
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
  /// Draws these triangles over the same vertices instead of all; null: all. To and fro costs next to nothing.
  using Triangles = std::shared_ptr<const std::vector<geometry::Triangle>>;
  void drawCoarsely(const Triangles& coarse);
  std::span<const geometry::Triangle> triangles() const { return triangles_; }
  /// Gives each vertex a colour of its own (red, green, blue), in place of the actor's; none: the actor's.
  /// \pre none, or as many as there are vertices
  using Rgb = std::array<unsigned char, 3>;
  void colourVertices(const std::vector<Rgb>& colours);
  vtkActor* actor() { return actor_; }
  /// What is drawn now.
  vtkPolyData* data() { return isCoarse_ ? coarse_.data : full_.data; }

 private:
  /// A list of triangles with its own buffer of them on the graphics card.
  struct Level {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPolyDataMapper> mapper;
    Level();
    void setTriangles(std::span<const geometry::Triangle> triangles);
  };

  std::span<const geometry::Triangle> triangles_;
  Level full_;
  Level coarse_;
  Triangles coarseTriangles_;  ///< keeps alive what VTK reads
  bool isCoarse_ = false;
  vtkNew<vtkActor> actor_;
};

}  // namespace lorica::viewport
