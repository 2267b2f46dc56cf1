#pragma once

/// \file
/// Drivers of control points (thesis section 3.4): each follows interior sites and keeps its offset from them, the
/// offset turning with the site's frame.

#include <array>
#include <span>
#include <vector>

#include "lorica/parenting/interior_sites.h"

namespace lorica::viscera {

enum class SiteBinding {
  nearest,  ///< one site, the nearest at rest, as the thesis has it
  smooth    ///< the nearest ones blended with weights that fall to zero at the first one left out
};

/// Which sites carry one point, and how much each.
struct SiteBlend {
  static constexpr std::size_t limit = 8;
  std::array<std::uint32_t, limit> site{};
  std::array<float, limit> weight{};  ///< sum 1; unused places 0
  std::size_t count = 0;
};

/// \pre sites is not empty. Cost: points times sites.
std::vector<SiteBlend> bindToSites(std::span<const geometry::Vec3d> points,
                                   const std::vector<parenting::SkinSite>& sites, SiteBinding binding,
                                   base::Threads threads);

/// Offsets of the points in a pose (Eq 10): zero, exactly, where all sites of a point stand still.
std::vector<geometry::Vec3f> offsets(std::span<const geometry::Vec3d> points, std::span<const SiteBlend> blends,
                                     std::span<const geometry::RigidTransform> siteCarry, base::Threads threads);

}  // namespace lorica::viscera
