#pragma once

/// \file
/// The surface soft armor is cut from: a tight cloth over the skin that bridges its hollows.

#include <vector>

#include "armor_landmarks.h"
#include "lorica/base/parallel.h"
#include "lorica/geometry/closest_point.h"

namespace lorica::manikin {

/// Closed; fine over trunk, neck, shoulders and upper arms, coarse elsewhere. Only its fine part is cloth: the rest
/// stays just over the skin.
struct Cloth {
  geometry::TriangleMesh mesh;
  std::vector<Vec3d> normals;                         ///< unit, smooth
  std::vector<std::vector<std::uint32_t>> neighbors;  ///< of each vertex, rising
  geometry::ClosestPointTree tree;                    ///< of `mesh`
  std::vector<char> trunk;                            ///< per vertex: fine, and not of head or arms
  std::vector<char> shoulders;                        ///< per vertex: fine, and not of the head
};

struct ClothOptions {
  double edge = 0.0105;       ///< m, of the fine part
  double clearance = 0.0035;  ///< m over the skin, where it lies on
  double bridge = 0.018;      ///< m over the skin at most, where it bridges
};

/// Neighbours of each vertex, rising.
std::vector<std::vector<std::uint32_t>> vertexNeighbors(const geometry::TriangleMesh& mesh);

/// A membrane under tension with the skin as its obstacle.
/// Cost: about 1 s on one core for 10,000 vertices of cloth.
Cloth drapedCloth(const Body& body, const BodyShares& shares, const ArmorLandmarks& marks,
                  const geometry::ClosestPointTree& skin, const ClothOptions& options, base::Threads threads);

}  // namespace lorica::manikin
