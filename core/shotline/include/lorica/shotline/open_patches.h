#pragma once

/// \file
/// Connected open patches of a surface, told from counts of shots per triangle.
///
/// A triangle is open when, of the shots that come through it, more than a stated share is unprotected, as Wilson's
/// 95 % lower bound says. With fewer shots than a stated number of its own it is pooled with the triangles around it,
/// ring by ring, as far as it takes and no further than a stated radius; where that does not suffice nothing is
/// claimed. A triangle without a shot is taken for one that was missed by chance when, at the density of its pool,
/// fewer than three were to be expected on it and the shots of the pool lie around it, not to one side. Open triangles
/// with a common corner make up a patch; a patch holds as many shots as a triangle needs, and passes the same test as a
/// whole.
///
/// Wilson's bound is the rule here, not an interval: points spread more evenly than at random only make it cautious.

#include <cstdint>
#include <span>
#include <vector>

#include "lorica/geometry/vectors.h"
#include "lorica/raycast/mesh_topology.h"

namespace lorica::shotline {

struct PatchRule {
  double openShare = 0.1;       ///< 0 to 1
  std::uint64_t minShots = 20;  ///< at least 1
  double radius = 0.03;         ///< metres, between the middles of triangles that are pooled
};

struct OpenPatch {
  std::vector<std::uint32_t> triangles;  ///< rising
  /// m2: of each triangle the share of its shots that is unprotected (of its pool, where it has none). What one
  /// direction sees of a hole is this, whatever the size of the triangles at its rim; of many directions it falls short
  /// by no more than openShare of the triangles at the rim. Where `through` is given, the share is of those shots: then
  /// triangles at the rim of what the shots reach count by the part of them that leads there.
  double area = 0.0;
  double extent = 0.0;                               ///< m2, whole triangles
  geometry::Vec3d centre = geometry::Vec3d::Zero();  ///< metres, of `area`; off the surface where that is curved
  std::uint64_t hits = 0;                            ///< on its triangles
  std::uint64_t open = 0;
};

/// The patches under one system, the largest area first.
/// \param positions of the posed mesh, metres
/// \param hits, open shots per triangle
/// \param through all shots that enter through each triangle, no fewer than `hits`; meant for shots that pass a place
/// in one direction only. None: those of `hits`. \pre a position per vertex, a count per triangle. Cost: a walk around
/// each triangle that lies near a hit.
std::vector<OpenPatch> openPatches(const raycast::MeshTopology& mesh, std::span<const geometry::Vec3f> positions,
                                   std::span<const std::uint64_t> hits, std::span<const std::uint64_t> open,
                                   const PatchRule& rule = {}, std::span<const std::uint64_t> through = {});

}  // namespace lorica::shotline
