#pragma once

/// \file
/// Interior sites (thesis section 3.4): points spread evenly in the rest skin, each parented to it. They drive the
/// lattices of organs and carry rigid armor.

#include <vector>

#include "lorica/base/issue.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/parenting/skin_parenting.h"

namespace lorica::parenting {

struct InteriorSites {
  std::vector<SkinSite> sites;
  std::size_t unbound = 0;  ///< grid points inside the skin that no three rays could tie to it
};

/// Sites on a cubic grid of `spacing` metres inside the skin. The same skin gives the same sites in the same order,
/// whatever the number of threads.
/// \throw base::Cancelled
InteriorSites placeInteriorSites(const raycast::Scene& scene, raycast::MeshIndex skinMesh, double spacing,
                                 const ParentingOptions& options, base::Threads threads,
                                 const base::Progress& progress = {});

/// How every site moves from rest to a pose.
struct SiteMotion {
  std::vector<geometry::RigidTransform> carry;  ///< one per site
  std::vector<std::uint32_t> collapsed;  ///< sites whose anchors became collinear: they move as the nearest sound one
};

SiteMotion carrySites(const std::vector<SkinSite>& sites, std::span<const geometry::Triangle> triangles,
                      std::span<const geometry::Vec3f> posedSkin, base::Threads threads);

/// Index of the site nearest to a point at rest; the first of equally near ones. \pre there is a site
std::size_t nearestSite(const std::vector<SkinSite>& sites, const geometry::Vec3d& point);

}  // namespace lorica::parenting
