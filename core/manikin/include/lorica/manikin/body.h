#pragma once

/// \file
/// The body that organs, armor and motions of the built-in human are made for.

#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/person.h"
#include "lorica/human/skeleton.h"
#include "lorica/human/skinning.h"

namespace lorica::manikin {

/// Metres, y up, facing +z, x to the person's left, soles at y = 0, arms in the A-pose.
struct Body {
  human::Person person;
  geometry::TriangleMesh skin;  ///< closed, manifold, outward, one piece
  human::SkinWeights weights;   ///< at most four joints per vertex
  human::Skeleton skeleton;     ///< rest frames are translations only; names as in the joint table, sided ones _L, _R
};

}  // namespace lorica::manikin
