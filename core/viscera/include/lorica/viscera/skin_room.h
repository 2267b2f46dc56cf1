#pragma once

#include "lorica/parenting/body_rig.h"

namespace lorica::viscera {

/// The room inside a skin, m3. A skinned body that bends gives up some of it; no deformer can give it back.
struct SkinRoom {
  double whole = 0.0;  ///< of the whole skin by the divergence theorem; where it passes through itself it counts twice
  double torso = 0.0;  ///< of chest, abdomen and pelvis, each hole of that part closed by a fan about its middle
};

/// \return nothing of use for a skin that does not close; a body without named regions has no torso (0)
/// Cost: one pass over the triangles. \pre posedSkin has the body's vertices
SkinRoom skinRoom(const parenting::Body& body, std::span<const geometry::Vec3f> posedSkin);

}  // namespace lorica::viscera
