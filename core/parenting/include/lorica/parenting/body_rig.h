#pragma once

/// \file
/// A digital human made ready: its skin, what moves it, and the interior sites that carry organs and armor.

#include <memory>
#include <optional>

#include "lorica/human/regions.h"
#include "lorica/human/rotation_centres.h"
#include "lorica/human/skinning.h"
#include "lorica/parenting/interior_sites.h"
#include "lorica/parenting/joint_parenting.h"

namespace lorica::parenting {

/// A human at rest, as read or generated. Without skeleton and weights it can be shot but not posed.
struct Body {
  geometry::TriangleMesh skin;
  std::optional<human::Skeleton> skeleton;
  std::optional<human::SkinWeights> weights;  ///< present exactly when the skeleton is
  human::BodyRegions regions;
};

/// The body in one pose: a value, owned by whoever asked for it.
struct PosedBody {
  geometry::Positions skin;
  std::vector<geometry::RigidTransform> joints;
  human::SkinningDeltas deltas;  ///< what skinned the skin and skins soft armor; empty without a skeleton
  SiteMotion sites;              ///< of BodyRig::sites()
  SiteMotion thesisSites;        ///< of BodyRig::thesisSites()
};

struct RigOptions {
  double siteSpacing = 0.04;  ///< metres
  bool thesisSites = true;    ///< also place the sites the thesis' settings ask for
  human::Skinning skinning = human::Skinning::rotationCentres;
};

/// Immutable; const functions are thread-safe.
class BodyRig {
 public:
  /// \throw base::Cancelled
  BodyRig(Body body, const RigOptions& options, base::Threads threads, const base::Progress& progress = {});

  const Body& body() const { return *body_; }
  /// Of human::skin(), one per vertex of the skin; none with linear skinning or without a skeleton.
  std::span<const geometry::Vec3f> centres() const { return centres_; }
  const std::vector<SkinSite>& sites() const { return sites_.sites; }
  const std::vector<SkinSite>& thesisSites() const { return thesisSites_.sites; }
  const base::Issues& issues() const { return issues_; }
  /// Of placing the sites of the thesis' settings; of no interest where they are not used.
  const base::Issues& thesisIssues() const { return thesisIssues_; }
  /// The skin at rest, as the only mesh of a scene.
  const raycast::Scene& restScene() const { return *restScene_; }
  raycast::MeshIndex skinMesh() const { return skinMesh_; }
  std::shared_ptr<const raycast::MeshTopology> skinTopology() const { return topology_; }

  /// The body in a pose of its skeleton; without one, or without a skeleton, at rest.
  PosedBody pose(const std::optional<human::Pose>& pose, base::Threads threads) const;
  /// The same into a value whose buffers are reused, so that the skin keeps its place in memory.
  void poseInto(const std::optional<human::Pose>& pose, base::Threads threads, PosedBody& posed) const;

 private:
  std::unique_ptr<const Body> body_;
  std::vector<geometry::Vec3f> centres_;
  std::shared_ptr<const raycast::MeshTopology> topology_;
  std::unique_ptr<raycast::Scene> restScene_;
  raycast::MeshIndex skinMesh_;
  InteriorSites sites_;
  InteriorSites thesisSites_;
  base::Issues issues_;
  base::Issues thesisIssues_;
};

}  // namespace lorica::parenting
