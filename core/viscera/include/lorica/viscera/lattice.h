#pragma once

/// \file
/// Free-form deformation (thesis chapter 3, Eq 10-14): a lattice of control points around an organ; every vertex
/// belongs to one cell and moves by the trilinear blend of the offsets of its eight control points.

#include <array>
#include <span>
#include <vector>

#include "lorica/base/parallel.h"
#include "lorica/geometry/triangle_mesh.h"

namespace lorica::viscera {

/// How control points are laid out (section 3.3).
struct LatticeOptions {
  enum class Layout {
    boundingBox,  ///< one cell
    uniform,      ///< cells[0] cells along each axis
    perAxis,      ///< cells[0], cells[1], cells[2] cells along x, y, z
    cellSize      ///< as many cells along each axis as bring them near `cellMetres`
  };
  Layout layout = Layout::cellSize;
  std::array<int, 3> cells{1, 1, 1};  ///< 1 to 1000 each
  double cellMetres = 0.04;
  bool prune = true;  ///< drop control points none of whose up to eight cells holds a vertex (section 3.3.4)
  bool operator==(const LatticeOptions&) const = default;
};

/// Control points a lattice may have before pruning.
inline constexpr double latticeLimit = 5e6;

/// How many control points the options ask for around a box, before pruning.
double controlPointsAsked(const geometry::Box3d& box, const LatticeOptions& options);

/// Digits x, y, z of the corners of a cell in the order of Eq 12:
/// V0(000) V1(100) V2(001) V3(101) V4(010) V5(110) V6(011) V7(111).
inline constexpr std::array<std::array<int, 3>, 8> cornerDigits = {
    {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}}};

/// Where the vertices of an organ lie in the cells of a lattice.
struct Embedding {
  geometry::Vec3d cell = geometry::Vec3d::Ones();  ///< edge lengths of a cell, metres
  /// Control points of every cell that holds a vertex, in the order of cornerDigits.
  std::vector<std::array<std::uint32_t, 8>> cellCorners;
  std::vector<std::uint32_t> cellOf;      ///< per vertex, index into cellCorners
  std::vector<geometry::Vec3f> fraction;  ///< per vertex x_d, y_d, z_d (Eq 11), 0 to 1
};

/// Bound once to the rest vertices; never changes afterwards.
struct Lattice : Embedding {
  geometry::Vec3d origin = geometry::Vec3d::Zero();  ///< low corner, metres
  std::array<int, 3> cells{1, 1, 1};
  std::vector<geometry::Vec3d> controlPoints;  ///< those kept, at rest
  std::size_t pruned = 0;                      ///< how many were dropped
};

/// \pre positions is not empty; cell counts and size are in range; controlPointsAsked() is at most latticeLimit
Lattice makeLattice(std::span<const geometry::Vec3f> positions, const LatticeOptions& options);

/// posed = rest + trilinear blend of the offsets (Eq 12-14). Zero offsets leave every vertex bit for bit.
/// \param offsets one per control point, metres (Eq 10)
/// \pre every corner of the embedding is one of the offsets
void deform(std::span<const geometry::Vec3f> rest, const Embedding& lattice, std::span<const geometry::Vec3f> offsets,
            std::span<geometry::Vec3f> posed, base::Threads threads);

}  // namespace lorica::viscera
