#pragma once

/// \file
/// Where meshes pass through themselves or through each other. Every answer is decided by exact signs of orientation
/// determinants of the float vertices (double precision with an error bound, quadruple precision where that cannot
/// tell), so that faces in one plane, edges on faces and vertices on edges are told from near misses.

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "lorica/base/parallel.h"
#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

/// How two closed triangles meet.
enum class Meeting {
  none,
  touching,  ///< they have common points, but no edge of one passes through the inside of the other
  crossing   ///< an edge of one runs from strictly one side of the other to the other side, through its inside
};

/// \pre both triangles have area (a triangle without area meets nothing)
Meeting meeting(const std::array<Vec3f, 3>& first, const std::array<Vec3f, 3>& second);

/// Indices of two triangles that meet.
struct TrianglePair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;

  // The 0 that a defaulted comparison is rewritten with is the compiler's own.
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

struct IntersectionOptions {
  bool touching = true;  ///< also report pairs that only touch
  /// Triangles with a common edge that enclose less than this angle there (radians) are folded onto each other.
  double foldedBelow = 0.01;
};

/// Pairs of triangles of one mesh that meet where they should not, `first` < `second`, in rising order.
///  - No common vertex: by meeting(). Vertices at one position but of different index are not common: weld first.
///  - One common vertex: they meet at a second point, or, without `touching`, an edge crosses the other's inside.
///  - A common edge: they fold onto each other (foldedBelow), whatever `touching` says.
///  - The same three vertices: always.
/// Triangles without area are left out; audit() counts them.
/// Thread-safe; the answer does not depend on `threads`. Cost: n log n plus the pairs whose boxes overlap; about 0.1 s
/// for 60,000 triangles on two cores.
std::vector<TrianglePair> selfIntersections(const TriangleMesh& mesh, base::Threads threads,
                                            const IntersectionOptions& options = {});

/// Pairs (triangle of `a`, triangle of `b`) that meet, in rising order. Two closed meshes may be apart, or one wholly
/// inside the other, when there is none.
/// Thread-safety and cost as above.
std::vector<TrianglePair> intersections(const TriangleMesh& a, const TriangleMesh& b, base::Threads threads,
                                        const IntersectionOptions& options = {});

}  // namespace lorica::geometry
