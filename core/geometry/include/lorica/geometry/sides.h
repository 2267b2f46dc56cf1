#pragma once

/// \file
/// Which triangles meet at an edge.

#include <compare>
#include <span>
#include <vector>

#include "lorica/geometry/vectors.h"

namespace lorica::geometry {

/// One side of a triangle, from corner `corner` to the next.
struct TriangleSide {
  std::uint32_t low;   ///< the lower vertex of its edge
  std::uint32_t high;  ///< the higher one
  std::uint32_t triangle;
  std::uint32_t corner;  ///< 0 to 2

  bool sameEdge(const TriangleSide& other) const { return low == other.low && high == other.high; }
  auto operator<=>(const TriangleSide&) const = default;
};

/// All sides, rising: those of one edge stand together, in the order of their triangles. Cost: a sort.
std::vector<TriangleSide> sidesByEdge(std::span<const Triangle> triangles);

}  // namespace lorica::geometry
