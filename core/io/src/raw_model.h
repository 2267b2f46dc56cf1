#pragma once

/// \file
/// What the readers of all formats hand over: checked, but neither welded nor in metres.

#include <string>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/clip.h"
#include "lorica/human/skinning.h"

namespace lorica::io {

struct RawPart {
  std::string name;                           ///< as the file gives it; may be empty
  std::vector<geometry::Vec3d> positions;     ///< finite, in the file's units and axes, at rest
  std::vector<geometry::Triangle> triangles;  ///< every index is below positions.size()
  std::size_t influences = 0;                 ///< places per vertex in `weights`; 0 when not skinned
  std::vector<human::Influence> weights;      ///< influences * vertices; finite, not negative, joints exist
  bool protects = true;                       ///< false when the file says that the part is no armor
};

struct RawModel {
  std::vector<RawPart> parts;
  std::vector<human::Joint> joints;  ///< parents before children; names may be empty or repeated
  std::vector<human::Clip> clips;    ///< on `joints`
};

}  // namespace lorica::io
