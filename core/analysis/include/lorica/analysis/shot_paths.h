#pragma once

/// \file
/// Single shots of a source, as they are drawn: where each one goes and what it meets first.

#include <cstdint>
#include <optional>
#include <vector>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/run.h"

namespace lorica::analysis {

/// What a crossing belongs to, in a posed scene.
struct StructureRef {
  enum class Kind { body, piece, organ };
  Kind kind = Kind::body;
  std::size_t index = 0;  ///< of the piece or organ
  std::size_t model = 0;  ///< for organs, index into PosedScene::models()
  bool operator==(const StructureRef&) const = default;
};

/// What mesh `mesh` of a posed scene stands for (TargetLayout).
StructureRef structureOfMesh(const shotline::TargetLayout& layout, std::uint32_t mesh);

struct ShotCrossing {
  StructureRef structure;
  double distance = 0.0;  ///< metres from the shot's origin
  bool entering = false;
};

struct ShotPath {
  std::uint64_t number = 0;  ///< of the shot in its trial
  geometry::Vec3f origin;
  geometry::Vec3f direction;            ///< unit length
  std::vector<ShotCrossing> crossings;  ///< in order
};

/// The source of a study made ready to shoot at the posed skin of the scene: its cone or disk bounds that skin alone,
/// unless a run over more poses widens it.
/// \throw base::InputError when the source stands on its target or inside the body
ShotSource shotSourceFor(const LoadedStudy& study, std::size_t source, const PosedScene& scene);

/// Shots 0 to `count` - 1 of trial 0 with all their crossings, of a grid as many that lie spread over it; fewer where
/// the source has fewer. Exact as in a run. Cost: that of `count` rays.
std::vector<ShotPath> shotPaths(const PosedScene& scene, const ShotSource& source, std::uint64_t seed,
                                std::size_t count);

}  // namespace lorica::analysis
