#pragma once

/// \file
/// Body regions: every table names them beside the organs.

#include <string>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/skinning.h"

namespace lorica::human {

/// Region of every skin triangle, as an index into `names`.
struct BodyRegions {
  std::vector<std::string> names;         ///< only regions that own a triangle, in head-to-foot order
  std::vector<std::uint16_t> ofTriangle;  ///< one per triangle
};

/// From each triangle's dominant joint: its name is matched against the field's names for joints, and a joint that
/// says nothing belongs to the region of its nearest named ancestor. Left is +x of the joint where the name does not
/// say. Chest and abdomen are cut into front and back by which way the triangle faces at rest. A skin whose joints
/// carry no known name is one region, "unassigned".
/// \pre weights fit the mesh and the skeleton
BodyRegions bodyRegions(const geometry::TriangleMesh& skin, const SkinWeights& weights, const Skeleton& skeleton);

}  // namespace lorica::human
