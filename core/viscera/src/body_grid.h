#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lorica/base/parallel.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/raycast/mesh_topology.h"

namespace lorica::viscera {

/// Cubic cells in a box, x fastest.
struct BodyGrid {
  geometry::Vec3d origin = geometry::Vec3d::Zero();  ///< low corner, metres
  double cell = 1.0;                                 ///< edge length, metres
  std::array<int, 3> cells{1, 1, 1};

  /// A grid over a box with `margin` cells around it.
  static BodyGrid over(const geometry::Box3d& box, double cell, int margin);

  std::size_t size() const {
    return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(cells[2]);
  }
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(cells[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(k));
  }
  std::array<int, 3> place(std::size_t index) const;

  struct Spot {
    std::size_t cell = 0;
    geometry::Vec3f fraction = geometry::Vec3f::Zero();  ///< 0 to 1 along each axis
  };
  /// Nothing outside the grid.
  std::optional<Spot> locate(const geometry::Vec3f& point) const;
};

/// How much of every cell lies inside a closed mesh, and where in the cell.
struct CellFill {
  std::vector<float> share;               ///< 0 to 1
  std::vector<geometry::Vec3f> centroid;  ///< of that part, as fractions of the cell; meaningless where share is 0
};

/// Samples 4 x 4 x 4 points of every cell by rays along z. Inside is a winding of 1 or more of the closed components.
CellFill cellFill(const BodyGrid& grid, const geometry::Positions& positions,
                  const std::shared_ptr<const raycast::MeshTopology>& topology, base::Threads threads);

/// Adds to the marked cells their neighbours face to face that hold some of the inside, `rings` times over.
void growInside(const BodyGrid& grid, const CellFill& inside, int rings, std::vector<char>& marked);

}  // namespace lorica::viscera
