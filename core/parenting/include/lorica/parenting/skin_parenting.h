#pragma once

/// \file
/// Skin-based parenting (thesis section 2.4.2, Eq 1-9): a point inside the skin is tied to three anchors on it, found
/// by three rays 120 degrees apart, and keeps its place and orientation between them as the skin deforms.

#include <array>
#include <optional>
#include <span>
#include <string>

#include "lorica/geometry/transform.h"
#include "lorica/raycast/caster.h"

namespace lorica::parenting {

enum class AnchorKind {
  hitPoint,     ///< where the ray leaves the skin: the point lies in the anchors' plane, exact at rest
  faceCentroid  ///< centroid of the face hit, as the thesis has it; what is left over stays as a residual
};

enum class RayPlane {
  tightest,   ///< of a fixed fan of planes the one whose three rays are shortest together
  transverse  ///< the horizontal plane, as the thesis has it
};

struct ParentingOptions {
  AnchorKind anchors = AnchorKind::hitPoint;
  RayPlane plane = RayPlane::tightest;

  static ParentingOptions thesis() { return {AnchorKind::faceCentroid, RayPlane::transverse}; }
};

/// A place fixed to a triangle of the skin.
struct SkinAnchor {
  std::uint32_t triangle = 0;
  geometry::Vec3d barycentric = geometry::Vec3d::Zero();
};

/// A point tied to the skin. Anchors, weights and residual do not change with the pose.
struct SkinSite {
  geometry::Vec3d rest = geometry::Vec3d::Zero();  ///< the point itself, metres
  std::array<SkinAnchor, 3> anchors;
  std::array<geometry::Vec3d, 3> restAnchors;               ///< their places at rest
  geometry::Vec3d weights = geometry::Vec3d::Zero();        ///< barycentric, of the point in the anchors' triangle
  geometry::Vec3d residual = geometry::Vec3d::Zero();       ///< what the weights leave over, in the rest frame's axes
  geometry::Mat3d restFrame = geometry::Mat3d::Identity();  ///< Eq 4-6, columns normalised
};

struct SiteBinding {
  std::optional<SkinSite> site;
  std::string trouble;  ///< why there is none
};

/// Ties `point` to the skin.
/// \param caster over a scene at rest that holds the skin as `skinMesh`; other meshes in it are ignored
/// Cost: up to 78 rays.
SiteBinding bindToSkin(const geometry::Vec3d& point, raycast::Caster& caster, const raycast::Scene& scene,
                       raycast::MeshIndex skinMesh, const ParentingOptions& options = {});

/// Builds the site on given anchors; none when they are collinear.
std::optional<SkinSite> siteOnAnchors(const geometry::Vec3d& point, const std::array<SkinAnchor, 3>& anchors,
                                      std::span<const geometry::Triangle> triangles,
                                      std::span<const geometry::Vec3f> restSkin);

/// The map that carries what is fixed to the site from rest to the pose: x' = p' + R (x - p). Anchors that did not move
/// give the exact identity; anchors that became collinear give nothing.
std::optional<geometry::RigidTransform> carry(const SkinSite& site, std::span<const geometry::Triangle> triangles,
                                              std::span<const geometry::Vec3f> posedSkin);

/// Barycentric weights of the point of the plane of a, b, c nearest to p.
geometry::Vec3d barycentricWeights(const geometry::Vec3d& p, const geometry::Vec3d& a, const geometry::Vec3d& b,
                                   const geometry::Vec3d& c);

}  // namespace lorica::parenting
