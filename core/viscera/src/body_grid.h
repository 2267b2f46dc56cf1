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

/// Which of the 4 x 4 x 4 sample points of every cell lie in something: bit x + 4 y + 16 z of the cell's word.
using Samples = std::vector<std::uint64_t>;
inline constexpr int samplesPerEdge = 4;

/// Samples inside a mesh: where its closed components wind around them. Cost: one ray along z for each column.
Samples samplesInside(const BodyGrid& grid, const geometry::Positions& positions,
                      const std::shared_ptr<const raycast::MeshTopology>& topology, base::Threads threads);

/// The sample nearest to a place in a cell.
std::uint64_t sampleAt(const geometry::Vec3f& fraction);

/// Share of a cell that a set of its samples stands for, and the centroid of that part as fractions of the cell.
float share(std::uint64_t set);
geometry::Vec3f centroid(std::uint64_t set);

/// Adds the samples of `inside` that are reached from `seeds` within `steps` from sample to sample, face to face.
void flood(const BodyGrid& grid, const Samples& inside, int steps, Samples& seeds);

}  // namespace lorica::viscera
