#pragma once

/// \file
/// Linear blend skinning (Lewis, Cordner and Fong 2000; thesis section 2.4.2).

#include <span>
#include <vector>

#include "lorica/base/issue.h"
#include "lorica/base/parallel.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/skeleton.h"

namespace lorica::human {

/// Joints and weights of every vertex. The influences of a vertex stand together, strongest first; unused places
/// have weight 0. Weights of a vertex sum to 1.
struct SkinWeights {
  std::size_t influences = 0;         ///< places per vertex
  std::vector<std::uint32_t> joints;  ///< influences * vertices, indices into the skeleton
  std::vector<float> weights;         ///< as many

  std::size_t vertices() const { return influences == 0 ? 0 : joints.size() / influences; }
  JointIndex strongest(std::size_t vertex) const { return JointIndex{joints[vertex * influences]}; }
};

/// One vertex' joint and weight, before they are brought into order.
struct Influence {
  std::uint32_t joint = 0;
  double weight = 0.0;
};

struct NormalisedWeights {
  SkinWeights weights;
  std::size_t truncatedVertices = 0;     ///< had more than `limit` influences; the weakest were dropped
  std::size_t unnormalisedVertices = 0;  ///< weights summed to something further than 1e-3 from 1
  std::size_t firstUnweighted = 0;       ///< index of the first vertex whose weights sum to zero
  std::size_t unweightedVertices = 0;
};

/// Merges repeated joints, drops zeros, keeps the `limit` strongest (ties: lower joint first) and normalises.
/// `perVertex` holds `stride` influences for each vertex. Unweighted vertices come out tied to joint 0 and counted.
/// \pre weights are finite and not negative; stride > 0 divides perVertex.size()
NormalisedWeights normaliseWeights(std::span<const Influence> perVertex, std::size_t stride, std::size_t limit = 12);

/// The linear maps of skinning minus the identity, in single precision: at rest they are exactly zero.
using SkinningDelta = Eigen::Matrix<float, 3, 4>;
std::vector<SkinningDelta> skinningDeltas(const Skeleton& skeleton, const Pose& pose);

/// posed = rest + sum(w_j * delta_j) * (rest, 1). A vertex whose joints do not move keeps its bits.
/// Threads: cuts the vertices into ranges; the result does not depend on their number.
/// \pre posed.size() == rest.size() == weights.vertices(); posed may be the buffer a ray tracer reads
void skin(std::span<const geometry::Vec3f> rest, const SkinWeights& weights, std::span<const SkinningDelta> deltas,
          std::span<geometry::Vec3f> posed, base::Threads threads);

}  // namespace lorica::human
