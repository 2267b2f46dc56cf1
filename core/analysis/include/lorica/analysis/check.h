#pragma once

#include <filesystem>

#include "lorica/base/issue.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"

namespace lorica::analysis {

/// Audits a study (*.lorica.json, *.json) with everything it names, a single mesh, or threat data (VTK's files, .pvd,
/// .csv): one issue per finding. What cannot be read at all is an issue of severity error, not an exception. \throw
/// base::Cancelled
base::Issues checkFile(const std::filesystem::path& path, base::Threads threads, const base::Progress& progress = {});

}  // namespace lorica::analysis
