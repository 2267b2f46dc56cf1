#pragma once

/// \file
/// An organ made ready to follow the body, in each of four models. Any analysis runs any of them on the same shots.

#include <optional>
#include <string>
#include <string_view>

#include "lorica/parenting/body_rig.h"
#include "lorica/viscera/lattice.h"
#include "lorica/viscera/site_blend.h"

namespace lorica::viscera {

enum class OrganModel {
  staticJoint,    ///< rigid, carried by one joint: what plain "static" means
  staticSkin,     ///< rigid, carried by skin-based parenting, position and orientation
  dynamicThesis,  ///< lattice driven by the nearest site, with the thesis' anchors and planes
  dynamic         ///< our best: see Deformer
};

/// What OrganModel::dynamic stands for.
enum class Deformer {
  softBody,  ///< all organs as one SoftBody: they keep their volume and their contacts
  lattice    ///< each organ by a lattice of its own, driven by blended sites: plain, and several times faster
};

/// "static_joint", "static_skin", "dynamic_thesis", "dynamic".
std::string name(OrganModel model);
std::optional<OrganModel> organModelNamed(std::string_view wanted);

struct OrganOptions {
  std::optional<human::JointIndex> joint;  ///< carries static_joint; default the nearest to the organ's centroid
  LatticeOptions lattice;
};

/// Immutable. The body rig it was bound to must outlive it only for poseOrgan().
struct OrganRig {
  geometry::TriangleMesh rest;
  geometry::Vec3d reference = geometry::Vec3d::Zero();  ///< volume centroid, or the nearest site when that is outside
  std::optional<human::JointIndex> joint;
  std::optional<parenting::SkinSite> site;  ///< at `reference`; carries static_skin
  Lattice lattice;
  std::vector<SiteBlend> thesisDrivers;  ///< one per control point
  std::vector<SiteBlend> drivers;
  base::Issues issues;
};

/// Binds an organ. On a body without interior sites (an open or tiny skin) the skin-driven models fall back to what
/// static_joint does, and an issue says so.
/// \pre rest is not empty
OrganRig bindOrgan(geometry::TriangleMesh rest, const std::string& name, const parenting::BodyRig& body,
                   const OrganOptions& options, base::Threads threads);

/// The organ's vertices in a pose; Deformer::lattice for OrganModel::dynamic. At rest every vertex keeps its bits, in
/// every model. \pre posed.size() == organ.rest.positions.size()
void poseOrgan(const OrganRig& organ, OrganModel model, const parenting::BodyRig& body,
               const parenting::PosedBody& pose, std::span<geometry::Vec3f> posed, base::Threads threads);

}  // namespace lorica::viscera
