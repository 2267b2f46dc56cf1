#include "lorica/parenting/body_rig.h"

#include <fmt/format.h>

#include "lorica/base/error.h"

namespace lorica::parenting {

BodyRig::BodyRig(Body body, const RigOptions& options, base::Threads threads, const base::Progress& progress)
    : body_(std::make_unique<const Body>(std::move(body))) {
  LORICA_CHECK(body_->skeleton.has_value() == body_->weights.has_value(), "skeleton and weights come together");
  if (body_->weights && options.skinning == human::Skinning::rotationCentres) {
    centres_ = human::rotationCentres(body_->skin, *body_->weights, threads);
  }
  topology_ = raycast::makeTopology(body_->skin);
  restScene_ = std::make_unique<raycast::Scene>(raycast::SceneUse::manyRays);
  skinMesh_ = restScene_->add(body_->skin.positions, topology_);
  restScene_->build();
  const auto place = [&](const ParentingOptions& parenting, const char* what, base::Issues& issues,
                         const base::Progress& share) {
    InteriorSites placed = placeInteriorSites(*restScene_, skinMesh_, options.siteSpacing, parenting, threads, share);
    if (placed.unbound > 0) {
      issues.push_back({base::Severity::note, "", "body",
                        fmt::format("{} of {} interior sites ({}) could not be tied to the skin and are left out",
                                    placed.unbound, placed.unbound + placed.sites.size(), what)});
    }
    return placed;
  };
  sites_ = place({}, "default", issues_, progress.part(0.0, options.thesisSites ? 0.8 : 1.0));
  if (options.thesisSites) {
    thesisSites_ = place(ParentingOptions::thesis(), "thesis", thesisIssues_, progress.part(0.8, 1.0));
  }
}

PosedBody BodyRig::pose(const std::optional<human::Pose>& pose, base::Threads threads) const {
  PosedBody posed;
  poseInto(pose, threads, posed);
  return posed;
}

void BodyRig::poseInto(const std::optional<human::Pose>& pose, base::Threads threads, PosedBody& posed) const {
  posed.skin.resize(body_->skin.positions.size());
  posed.deltas = {};
  if (body_->skeleton) {
    posed.deltas = human::skinningDeltas(*body_->skeleton, pose ? *pose : human::restPose(*body_->skeleton));
  }
  if (pose && body_->skeleton) {
    human::skin(body_->skin.positions, *body_->weights, centres_, posed.deltas, posed.skin, threads);
    posed.joints = carryJoints(*body_->skeleton, *pose);
  } else {
    std::copy(body_->skin.positions.begin(), body_->skin.positions.end(), posed.skin.begin());
    posed.joints.assign(body_->skeleton ? body_->skeleton->size() : 0, geometry::RigidTransform{});
  }
  posed.sites = carrySites(sites_.sites, body_->skin.triangles, posed.skin, threads);
  posed.thesisSites = carrySites(thesisSites_.sites, body_->skin.triangles, posed.skin, threads);
}

}  // namespace lorica::parenting
