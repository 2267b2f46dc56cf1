#pragma once

#include "lorica/analysis/shot_report.h"

namespace lorica::analysis {

/// Names passages at a posed scene.
class PassageNamer {
 public:
  PassageNamer(const LoadedStudy& study, const PosedScene& scene) : study_(&study), scene_(&scene) {}

  std::vector<NamedPassage> name(const raycast::Ray& ray, std::span<const raycast::Hit> hits) const;

 private:
  const LoadedStudy* study_;
  const PosedScene* scene_;
};

/// What the overlap policy of a study leaves to each passage of one system and model, metres.
/// \param passages of one armor system and one organ model
std::vector<double> claimedLengths(const study::Overlap& overlap, std::span<const NamedPassage> passages);

}  // namespace lorica::analysis
