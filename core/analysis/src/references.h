#pragma once

#include "lorica/analysis/loaded_study.h"

namespace lorica::analysis {

/// Errors for what the rule for stopping, the overlap policy and the analyses name and the study does not have, and for
/// a study without a model, so that a run fails before its first shot.
base::Issues danglingReferences(const LoadedStudy& study);
/// \throw base::InputError for the first of them
void requireReferences(const LoadedStudy& study);

}  // namespace lorica::analysis
