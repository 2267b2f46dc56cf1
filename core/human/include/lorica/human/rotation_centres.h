#pragma once

/// \file
/// Where the blended rotations of skinning turn, found once at rest.

#include <vector>

#include "lorica/base/parallel.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/skinning.h"

namespace lorica::human {

/// The centre of every vertex of a skin, for skin(). Two joints that share skin have a common centre: the centroid of
/// the skin they share, each place counted by its area and the product of both weights. For a limb it lies inside,
/// near the joint, half way around. A vertex takes the centres of its pairs of joints, each by the product of its two
/// weights; then the centres are smoothed along the skin over about 3 % of the square root of its area (40 mm for an
/// adult), for a centre that changes abruptly would crease the skin. A vertex held by one joint is its own centre.
/// Le and Hodgins 2016 average over the skin with similar weights instead (their Eq 1, 4); the centres of pairs give
/// the same volume and, smoothed, fewer folds, and need no search.
/// The result does not depend on the number of threads. Cost: linear in the vertices, times the smoothing's steps:
/// about 0.1 s for 50,000 vertices.
/// \pre weights.vertices() == rest.positions.size()
std::vector<geometry::Vec3f> rotationCentres(const geometry::TriangleMesh& rest, const SkinWeights& weights,
                                             base::Threads threads);

}  // namespace lorica::human
