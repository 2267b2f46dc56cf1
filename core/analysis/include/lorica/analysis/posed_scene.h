#pragma once

/// \file
/// Everything of a study in one pose: skin, armor of every system, organs of every model, ready for rays.

#include <array>
#include <string_view>

#include "lorica/analysis/loaded_study.h"
#include "lorica/shotline/tally.h"

namespace lorica::analysis {

/// Classes of organs, in the order of TargetLayout.
inline constexpr std::array<std::string_view, 2> injuryClasses{"essential", "desirable"};

/// What the meshes of a posed scene of `models` models stand for. \pre study outlives the layout
shotline::TargetLayout layoutOf(const LoadedStudy& study, std::size_t models);

/// Whether a model of an organ is that of LoadedStudy::softBody.
bool usesSoftBody(const LoadedStudy& study, viscera::OrganModel model);

/// The vertices of an organ in a posed body, as runs have them.
/// \param softBody of SoftBody::settle() for the same pose, where the model uses it
/// \pre posed has a place for every vertex of the organ
void placeOrgan(const LoadedStudy& study, std::size_t organ, viscera::OrganModel model,
                const parenting::PosedBody& body, std::span<const geometry::Vec3f> softBody,
                std::span<geometry::Vec3f> posed, base::Threads threads);

/// One scene holds all systems and all models, so that one ray serves every comparison.
class PosedScene {
 public:
  /// \pre study outlives the scene
  PosedScene(const LoadedStudy& study, std::vector<viscera::OrganModel> models, const std::optional<human::Pose>& pose,
             raycast::SceneUse use, base::Threads threads);

  /// Takes another pose: deforms everything in place and refits. \pre made for manyFrames
  void move(const std::optional<human::Pose>& pose, base::Threads threads);

  /// Puts organs elsewhere and refits them alone: each at the given positions plus a shift, metres.
  /// \param positions, shifts model by model, organ by organ
  /// \pre made for manyFrames
  void placeOrgans(std::span<const geometry::Positions> positions, std::span<const geometry::Vec3d> shifts);

  const parenting::PosedBody& body() const { return body_; }
  const geometry::Positions& piece(std::size_t piece) const { return pieces_[piece]; }
  const geometry::Positions& organ(std::size_t organ, std::size_t model) const {
    return organs_[model * study_->organs.size() + organ];
  }
  /// How the control points of LoadedStudy::softBody moved; empty where no model shown uses it.
  const std::vector<geometry::Vec3f>& softBodyOffsets() const { return softBody_; }
  const std::vector<viscera::OrganModel>& models() const { return models_; }
  const raycast::Scene& scene() const { return scene_; }
  const shotline::TargetLayout& layout() const { return layout_; }
  std::size_t triangles() const;

 private:
  void deform(const std::optional<human::Pose>& pose, base::Threads threads);

  const LoadedStudy* study_;
  std::vector<viscera::OrganModel> models_;
  parenting::PosedBody body_;
  std::vector<geometry::Positions> pieces_;
  std::vector<geometry::Positions> organs_;  ///< model by model
  std::vector<geometry::Vec3f> softBody_;
  raycast::Scene scene_;
  shotline::TargetLayout layout_;
};

}  // namespace lorica::analysis
