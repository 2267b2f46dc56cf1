#pragma once

/// \file
/// Fields sampled on a lattice: who has which place inside the body, and the surface of what an organ has.

#include <array>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "fields.h"
#include "lorica/base/parallel.h"
#include "lorica/geometry/triangle_mesh.h"
#include "organ_frame.h"

namespace lorica::manikin {

/// Values at the points of a grid of cubes; between them trilinear.
struct Lattice {
  Vec3d origin = Vec3d::Zero();
  double cell = 1.0;
  std::array<std::size_t, 3> points{};
  std::vector<double> values;  ///< x runs fastest, then y, then z

  /// A lattice that covers the box, its values unset.
  static Lattice over(const geometry::Box3d& box, double cell);

  geometry::Box3d box() const;
  Vec3d place(std::size_t i, std::size_t j, std::size_t k) const {
    return origin + cell * Vec3d(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return i + points[0] * (j + points[1] * k); }
  /// Trilinear; `outside` beyond the box.
  double at(const Vec3d& p, double outside = std::numeric_limits<double>::infinity()) const;
  /// Moves along the gradient until the field vanishes, a few steps.
  Vec3d project(const Vec3d& p) const;
};

/// Fills a lattice: `field` gets the body's level of the row, and the place. Rows of one height share their level.
void sample(Lattice& lattice, const AnatomyFrame& frame, base::Threads threads,
            const std::function<double(const Level& level, const Vec3d& place)>& field);

/// Lowers values to the distance from a round tube, within `reach` of it.
void stampTube(Lattice& lattice, std::span<const Station> tube, double reach);

/// One pass of the weights 1, 2, 1 along each axis: what is thinner than a cell or two goes.
void blur(Lattice& lattice);

/// Smooths a mesh where it passes through itself, until it does no more or a number of rounds is over. True when it
/// does no more.
bool untangle(geometry::TriangleMesh& mesh, base::Threads threads);

/// Volume where the values are negative, m3; the values are distances near zero.
double volumeBelowZero(const Lattice& lattice);

/// The outermost closed pieces of the zero surface, the `pieces` largest of them.
geometry::TriangleMesh surfaceOf(const Lattice& lattice, std::size_t pieces);

}  // namespace lorica::manikin
