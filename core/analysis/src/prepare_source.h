#pragma once

#include <span>

#include "lorica/analysis/run.h"

namespace lorica::analysis {

/// A source of the study with its target, and its cone around the posed skins.
/// \throw base::InputError when it stands on its target
ShotSource prepareSource(const LoadedStudy& study, std::size_t source,
                         std::span<const std::span<const geometry::Vec3f>> skins, base::Issues& issues);

}  // namespace lorica::analysis
