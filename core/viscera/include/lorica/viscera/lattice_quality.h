#pragma once

/// \file
/// What a lattice's cells went through: whether any turned inside out, and how far the worst was squeezed.

#include <span>

#include "lorica/viscera/organ_rig.h"

namespace lorica::viscera {

struct LatticeQuality {
  std::size_t cells = 0;          ///< looked at; 0 for a rigid model
  std::size_t inverted = 0;       ///< cells with a Jacobian of 0 or less at one of the points looked at
  double smallestJacobian = 1.0;  ///< volume now over volume at rest, of the smallest point; 1 for a rigid model

  bool operator==(const LatticeQuality&) const = default;
};

/// Looks at the eight corners and the eight Gauss points (2 x 2 x 2) of every cell that holds a vertex. A cell may
/// still turn inside out between them; where all sixteen are well above 0 it does not. \pre one offset per control
/// point. Cost: 16 determinants a cell.
LatticeQuality latticeQuality(const Embedding& lattice, std::span<const geometry::Vec3f> offsets);

/// Of an organ in a pose and a model: that of the lattice which poseOrgan() moves, or a rigid model's.
LatticeQuality latticeQuality(const OrganRig& organ, OrganModel model, const parenting::PosedBody& pose,
                              base::Threads threads);

}  // namespace lorica::viscera
