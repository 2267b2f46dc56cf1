#pragma once

#include <functional>
#include <span>

#include "lorica/analysis/run.h"

namespace lorica::analysis {

/// What a source is aimed at: the same for all poses compared.
struct Aim {
  std::vector<std::span<const geometry::Vec3f>> skins;  ///< posed, one per pose
  /// Box around an organ or a piece over all poses and models; empty when the study has none of that name.
  std::function<geometry::Box3d(const std::string& structure)> boxOf;
};

/// A source of the study made ready: its target, and the cone or disk that bounds the posed skins.
/// \throw base::InputError when it stands on its target or inside a posed skin, or the structure it is aimed at is
///        unknown
ShotSource prepareSource(const LoadedStudy& study, std::size_t source, const Aim& aim, base::Issues& issues);

}  // namespace lorica::analysis
