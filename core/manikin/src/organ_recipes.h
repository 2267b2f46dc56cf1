#pragma once

/// \file
/// How each organ is made from its shape: how fine, how deep under the skin, how far from its neighbours.

#include <vector>

#include "organ_shapes.h"

namespace lorica::manikin {

/// Lengths in metres of the canonical man.
struct OrganRecipe {
  const char* name;
  ShapeField shape = nullptr;                              ///< may be empty when there are tubes
  std::vector<std::vector<Station>> (*tubes)() = nullptr;  ///< joined to the shape
  ShapeField furrows = nullptr;                            ///< cut into what came out, before the last blur
  Vec3d low{0, 0, 0};                                      ///< box that holds the organ with room to grow
  Vec3d high{0, 0, 0};
  double cell = 0.0026;    ///< of the lattice
  double edge = 0.0046;    ///< of the triangles
  double depth = 0.015;    ///< least distance to the skin
  double gap = 0.0015;     ///< to what was there before
  double fillet = 0.003;   ///< where it meets that
  int blurs = 1;           ///< passes that take what is too thin for the triangles
  bool yielding = false;   ///< its tubes bend around what was there before
  bool besideBone = true;  ///< the spinal canal lies in it
  /// m3, in the canonical man, of an organ that does not grow with the body: its shape shrinks about `middle` in a
  /// larger one. 0 for those that do.
  double canonicalVolume = 0.0;
  Vec3d middle{0, 0, 0};
};

/// In the order in which they take their places: firm ones first, the lungs last.
const std::vector<OrganRecipe>& organRecipes();

}  // namespace lorica::manikin
