#pragma once

/// \file
/// Old versions of the study file are brought up to date step by step before they are read.

#include <span>

#include "json_node.h"

namespace lorica::study {

/// Turns a study of one version into one of the next.
using UpgradeStep = Json (*)(Json);

/// The steps of this program: the first leads from version 1 to 2, the last to studyVersion.
std::span<const UpgradeStep> upgradeSteps();

/// The tree in the version that `steps` lead to (their number plus one), whatever version it has; the number of the
/// version itself is kept up to date here.
/// \throw base::InputError when the tree has no version or one that is not known
Json upgraded(Json tree, const std::string& file, std::span<const UpgradeStep> steps);

}  // namespace lorica::study
