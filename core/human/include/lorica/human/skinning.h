#pragma once

/// \file
/// Skin weights, and how they carry a skin: with blended rotations about centres found at rest, or linearly.

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
  /// Whether more than one joint holds the vertex.
  bool isShared(std::size_t vertex) const { return influences > 1 && weights[vertex * influences + 1] > 0.0F; }
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

/// How the motion of several joints is blended where they share a vertex.
enum class Skinning {
  /// The turns are blended as unit quaternions about a centre that is found once at rest (rotationCentres()), the
  /// centre moves linearly: after Le and Hodgins 2016, "Real-time skeletal skinning with optimized centers of
  /// rotation". Keeps the girth of what bends or twists.
  rotationCentres,
  /// Linear blend skinning (Lewis, Cordner and Fong 2000; thesis section 2.4.2): what other programs show for the same
  /// weights. Loses volume where joints bend or twist far.
  linear
};

/// What a pose does to everything bound to the joints; made once per pose by skinningDeltas().
struct SkinningDeltas {
  /// Columns 0 to 3: the map of the joint (3 x 4, and a row of zeros) minus the identity, so that it is exactly zero at
  /// rest. Column 4: the map's turn as a unit quaternion x, y, z, w, on the same side as that of the joint's parent.
  using Joint = Eigen::Matrix<float, 4, 5>;
  std::vector<Joint> joints;
  /// Per joint what its map has beyond the turn (scale, shear); empty when no joint has any.
  std::vector<Eigen::Matrix3f> stretches;
};

SkinningDeltas skinningDeltas(const Skeleton& skeleton, const Pose& pose);

/// Carries every vertex by the joints it is weighted to. With L the linear blend of their maps, R the rotation of their
/// blended quaternions and c the vertex' centre:
///     posed = R (rest - c) + L c.
/// A vertex held by one joint moves with it, rigidly moved joints move the skin rigidly, and a vertex whose joints do
/// not move keeps its bits. What a joint has beyond a turn (scale) is blended linearly. Without centres every vertex is
/// its own: linear blend skinning.
/// Threads: cuts the vertices into ranges; the result does not depend on their number.
/// \pre posed.size() == rest.size() == weights.vertices(); centres are as many or none; posed may be the buffer a ray
///      tracer reads
void skin(std::span<const geometry::Vec3f> rest, const SkinWeights& weights, std::span<const geometry::Vec3f> centres,
          const SkinningDeltas& deltas, std::span<geometry::Vec3f> posed, base::Threads threads);

/// Linear blend skinning.
inline void skin(std::span<const geometry::Vec3f> rest, const SkinWeights& weights, const SkinningDeltas& deltas,
                 std::span<geometry::Vec3f> posed, base::Threads threads) {
  skin(rest, weights, {}, deltas, posed, threads);
}

}  // namespace lorica::human
