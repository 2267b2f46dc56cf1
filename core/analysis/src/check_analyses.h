#pragma once

#include "lorica/analysis/loaded_study.h"

namespace lorica::analysis {

/// Fails when the study's `gaps` or `anatomy` ask for what is not there. \throw base::InputError
void checkAnalyses(const LoadedStudy& study);

}  // namespace lorica::analysis
