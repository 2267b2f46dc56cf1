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

/// The pieces of a shot by that policy. The body is what all else lies in: it owns only what nothing else does.
std::vector<shotline::Segment> segmentsOf(const study::Overlap& overlap, std::span<const NamedPassage> passages);

/// Those of the body, of a system's armor and of a model's organs.
std::vector<NamedPassage> passagesUnder(std::span<const NamedPassage> passages, const std::string& system,
                                        const std::string& model);

}  // namespace lorica::analysis
