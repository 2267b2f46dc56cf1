#pragma once

/// \file
/// Meshes that rays are cast at. The one room that knows Embree.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lorica/base/index.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/raycast/mesh_topology.h"

namespace lorica::raycast {

using MeshIndex = base::Index<struct MeshTag>;

/// What the scene is tuned for.
enum class SceneUse {
  manyRays,   ///< built once, traced much
  manyFrames  ///< vertices move and refit() follows, at the price of slower rays
};

/// A set of meshes and Embree's hierarchy over them. Positions are shared, not copied: each array handed to add() must
/// keep its place and size until the scene is gone. Casting (Caster, closestPoint) is thread-safe between build() and
/// the next change of a position.
class Scene {
 public:
  struct Impl;

  explicit Scene(SceneUse use);
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// \pre positions.size() == topology->vertices
  MeshIndex add(const geometry::Positions& positions, std::shared_ptr<const MeshTopology> topology);
  /// Makes what was added visible to rays.
  void build();
  /// Follows positions that changed since build(). \pre the scene is for manyFrames and was built
  void refit();
  /// Follows those of some meshes alone; the others have not moved. \pre as refit(), and the scene has the meshes
  void refit(std::span<const MeshIndex> moved);

  std::size_t meshes() const;
  const MeshTopology& topology(MeshIndex mesh) const;
  const geometry::Vec3f* positions(MeshIndex mesh) const;

 private:
  friend class Caster;
  friend struct SceneAccess;
  std::unique_ptr<Impl> impl_;
};

/// A place on a mesh.
struct SurfacePoint {
  MeshIndex mesh;
  std::uint32_t triangle = 0;
  geometry::Vec3d barycentric = geometry::Vec3d::Zero();  ///< weights of the corners, sum 1
  geometry::Vec3d point = geometry::Vec3d::Zero();
  double distance = 0.0;  ///< metres from the query
};

/// The surface point nearest to `query`; none when the scene is empty or nothing lies within `radius`.
std::optional<SurfacePoint> closestPoint(const Scene& scene, const geometry::Vec3d& query, double radius = 1e6);

}  // namespace lorica::raycast
