#pragma once

/// \file
/// Soft panels: cut from the cloth along a smooth outline and given a thickness.

#include <functional>
#include <optional>

#include "armor_cloth.h"

namespace lorica::manikin {

/// How a panel is cut. Lengths in metres; places are points on the cloth.
struct PanelCut {
  /// About the distance from the outline along the cloth, positive in the panel.
  std::function<double(const Vec3d&)> inside;
  /// Of the panel's inner face over the cloth, not negative; changes slowly.
  std::function<double(const Vec3d&)> height;
  double thickness = 0.0;
  bool onArms = false;  ///< may also cover the upper arms
};

struct Panel {
  geometry::TriangleMesh mesh;  ///< closed: the inner face's vertices, then as many of the outer face
  human::SkinWeights weights;
  double middleArea = 0.0;  ///< m2, half way between the faces
};

/// The largest connected part of the cloth within the outline, as a shell.
/// \pre the outline encloses some cloth
Panel cutPanel(const Cloth& cloth, const PanelCut& cut, const Body& body, const geometry::ClosestPointTree& skin,
               base::Threads threads);

}  // namespace lorica::manikin
