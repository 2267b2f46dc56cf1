#pragma once

/// \file
/// Plates carried by all the skin under them.

#include <optional>
#include <span>

#include "lorica/armor/piece_rig.h"

namespace lorica::armor {

/// Finds the skin under a plate, as PieceRig::under. Leaves it empty where too little of it is there to hold a plate.
/// \param plate at rest, outside the skin; its face has an area
void findUnder(PieceRig& piece, const geometry::TriangleMesh& plate, const parenting::BodyRig& body);

/// How the skin of a pose carries what lies over `piece.under`: the exact identity where it has not moved, nothing
/// where it has collapsed to a line.
std::optional<geometry::RigidTransform> carriedBySkin(const PieceRig& piece, std::span<const geometry::Vec3f> skin);

}  // namespace lorica::armor
