#pragma once

/// \file
/// The plain sample human: a mannequin of rounded limbs that needs no file. Made for samples, tests and first steps; it
/// has the right size, joints and organ volumes, not the right anatomy.

#include <string>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/clip.h"
#include "lorica/human/skeleton.h"
#include "lorica/human/skinning.h"

namespace lorica::manikin {

struct PlainOrgan {
  std::string name;
  geometry::TriangleMesh mesh;  ///< closed, outward, inside the skin at rest
};

/// Metres, y up, facing +z, x to the person's left, soles at y = 0, arms 30 degrees from the trunk.
struct PlainHuman {
  geometry::TriangleMesh skin;     ///< closed, manifold, outward, one piece, 20,000 to 40,000 triangles
  human::SkinWeights weights;      ///< at most four joints per vertex, neighbours along one limb
  human::Skeleton skeleton;        ///< rest frames are translations only
  std::vector<human::Clip> clips;  ///< toe_touch, belly_twist, lateral_twist, squat: all start and end at rest
  std::vector<PlainOrgan> organs;  ///< in the order of builtinOrganNames()
};

/// An adult male of 1.755 m. Sizes roughly after the ANSUR II male medians, organ volumes after ICRP publication 89,
/// organ places after the stylised phantom of Cristy and Eckerman 1987.
/// The same bytes at each call. Thread-safe. Cost: about half a second.
PlainHuman plainHuman();

std::vector<std::string> builtinOrganNames();

}  // namespace lorica::manikin
