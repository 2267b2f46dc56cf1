#pragma once

/// \file
/// Smoothing of what the vertices of a surface carry, in steps half way to the mean of their neighbours.

#include <cstdint>
#include <functional>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

/// Neighbours along edges, those of one vertex together. Near ones have a greater share (as one over the length of the
/// edge), so that slivers and uneven triangles do not bias the mean.
struct SurfaceNeighbours {
  std::vector<std::size_t> first;     ///< of each vertex, and the end
  std::vector<std::uint32_t> vertex;  ///< the neighbour
  std::vector<double> share;          ///< sums to 1 over the neighbours of a vertex
  double squaredEdge = 0.0;           ///< mean square of the edges, m2; 0 when there is none

  /// The mean of the neighbours' values; `alone` when the vertex has none.
  template <class Value, class Values>
  Value mean(const Values& values, std::size_t v, const Value& alone) const {
    if (first[v] == first[v + 1]) {
      return alone;
    }
    Value sum = share[first[v]] * values[vertex[first[v]]];
    for (std::size_t e = first[v] + 1; e < first[v + 1]; ++e) {
      sum += share[e] * values[vertex[e]];
    }
    return sum;
  }

  /// How many steps of half way to the mean spread a value over about `length` metres; 0 without edges.
  std::size_t stepsFor(double length) const;
};

/// Of the edges whose ends are both kept; of all without `kept`. Cost: n log n.
SurfaceNeighbours surfaceNeighbours(const TriangleMesh& mesh,
                                    const std::function<bool(std::uint32_t vertex)>& kept = {});

/// Taubin (1995), "A Signal Processing Approach to Fair Surface Design": a round is a step towards the mean of the
/// neighbours and one back that is a little longer, which together leave long waves as they are.
struct TaubinOptions {
  int rounds = 10;
  double lambda = 0.33;  ///< share of the way to the mean, 0 to 1
  double mu = 0.34;      ///< share of the way back, above lambda; the waves kept are those below 1/lambda - 1/mu
};

/// Positions smoothed without shrinking; corners on the border of an open mesh move too.
/// Cost: some nanoseconds per edge and round.
Positions taubinSmoothed(const TriangleMesh& mesh, const TaubinOptions& options = {});

}  // namespace lorica::geometry
