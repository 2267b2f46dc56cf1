#include "lorica/analysis/posed_scene.h"

#include <algorithm>
#include <functional>

#include "lorica/base/error.h"

namespace lorica::analysis {

shotline::TargetLayout layoutOf(const LoadedStudy& study, std::size_t models) {
  shotline::TargetLayout layout;
  for (const std::size_t system : study.systemOfPiece) {
    layout.pieceSystem.push_back(static_cast<std::uint32_t>(system + 1));
  }
  const human::BodyRegions& regions = study.body->body().regions;
  layout.regionOfTriangle = regions.ofTriangle;
  layout.regions = regions.names.size();
  layout.systems = study.study.systems.size() + 1;
  layout.organs = study.organs.size();
  layout.models = models;
  layout.classes = injuryClasses.size();
  for (const study::Organ& organ : study.study.organs) {
    const auto known = std::find(injuryClasses.begin(), injuryClasses.end(), organ.injuryClass);
    layout.organClass.push_back(
        known == injuryClasses.end() ? 0 : static_cast<std::uint32_t>(known - injuryClasses.begin() + 1));
  }
  return layout;
}

bool usesSoftBody(const LoadedStudy& study, viscera::OrganModel model) {
  return study.softBody != nullptr && model == viscera::OrganModel::dynamic;
}

void placeOrgan(const LoadedStudy& study, std::size_t organ, viscera::OrganModel model,
                const parenting::PosedBody& body, std::span<const geometry::Vec3f> softBody,
                std::span<geometry::Vec3f> posed, base::Threads threads) {
  const viscera::OrganRig& rig = study.organs[organ]->rig;
  if (usesSoftBody(study, model)) {
    study.softBody->place(organ, rig.rest.positions, softBody, body, posed, threads);
  } else {
    viscera::poseOrgan(rig, model, *study.body, body, posed, threads);
  }
}

PosedScene::PosedScene(const LoadedStudy& study, std::vector<viscera::OrganModel> models,
                       const std::optional<human::Pose>& pose, raycast::SceneUse use, base::Threads threads)
    : study_(&study), models_(std::move(models)), scene_(use), layout_(layoutOf(study, models_.size())) {
  for (const auto& piece : study.pieces) {
    pieces_.emplace_back(piece->rig.rest.positions.size());
  }
  for (std::size_t m = 0; m < models_.size(); ++m) {
    for (const auto& organ : study.organs) {
      organs_.emplace_back(organ->rig.rest.positions.size());
    }
  }
  deform(pose, threads);

  scene_.add(body_.skin, study.body->skinTopology());
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    scene_.add(pieces_[p], study.pieces[p]->topology);
  }
  for (std::size_t slot = 0; slot < organs_.size(); ++slot) {
    scene_.add(organs_[slot], study.organs[slot % study.organs.size()]->topology);
  }
  scene_.build();
}

void PosedScene::deform(const std::optional<human::Pose>& pose, base::Threads threads) {
  study_->body->poseInto(pose, threads, body_);
  const auto modelOf = [&](std::size_t slot) { return models_[slot / study_->organs.size()]; };
  const auto posePiece = [&](std::size_t p) { armor::posePiece(study_->pieces[p]->rig, body_, pieces_[p], threads); };
  const auto poseOrgan = [&](std::size_t slot) {
    placeOrgan(*study_, slot % study_->organs.size(), modelOf(slot), body_, softBody_, organs_[slot], threads);
  };
  const auto settle = [&] { softBody_ = study_->softBody->settle(body_, threads); };

  // Most pieces and organs are too small to occupy several threads by themselves, and so is the soft body at times.
  std::vector<std::function<void()>> first;
  std::vector<std::function<void()>> then;
  if (std::any_of(models_.begin(), models_.end(), [&](auto model) { return usesSoftBody(*study_, model); })) {
    first.emplace_back(settle);
  }
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    first.emplace_back([&posePiece, p] { posePiece(p); });
  }
  for (std::size_t slot = 0; slot < organs_.size(); ++slot) {
    (usesSoftBody(*study_, modelOf(slot)) ? then : first).emplace_back([&poseOrgan, slot] { poseOrgan(slot); });
  }
  for (const auto* tasks : {&first, &then}) {
    base::parallelFor(tasks->size(), 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        (*tasks)[i]();
      }
    });
  }
}

void PosedScene::move(const std::optional<human::Pose>& pose, base::Threads threads) {
  base::withThreads(threads, [&] {
    deform(pose, threads);
    scene_.refit();
  });
}

void PosedScene::placeOrgans(std::span<const geometry::Positions> positions, std::span<const geometry::Vec3d> shifts) {
  LORICA_CHECK(positions.size() == organs_.size() && shifts.size() == organs_.size(), "a place for every organ");
  std::vector<raycast::MeshIndex> moved;
  for (std::size_t slot = 0; slot < organs_.size(); ++slot) {
    const geometry::Vec3f shift = shifts[slot].cast<float>();
    LORICA_CHECK(positions[slot].size() == organs_[slot].size(), "a position for every vertex");
    for (std::size_t v = 0; v < organs_[slot].size(); ++v) {
      organs_[slot][v] = positions[slot][v] + shift;
    }
    moved.emplace_back(1 + pieces_.size() + slot);
  }
  scene_.refit(moved);
}

std::size_t PosedScene::triangles() const {
  std::size_t sum = 0;
  for (std::size_t m = 0; m < scene_.meshes(); ++m) {
    sum += scene_.topology(raycast::MeshIndex{m}).triangles.size();
  }
  return sum;
}

}  // namespace lorica::analysis
