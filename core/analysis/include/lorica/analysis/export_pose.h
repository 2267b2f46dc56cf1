#pragma once

#include <string>

#include "lorica/analysis/loaded_study.h"
#include "lorica/io/export.h"

namespace lorica::analysis {

/// A pose of the whole study - skin, organs of one model, armor of every system - as a scene file's bytes.
/// \throw base::InputError for an unknown pose
std::string exportPose(const LoadedStudy& study, const std::string& pose, viscera::OrganModel model,
                       io::SceneFormat format, base::Threads threads);

}  // namespace lorica::analysis
