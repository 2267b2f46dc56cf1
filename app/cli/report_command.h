#pragma once

/// \file
/// Reports as PDF, in builds that have Qt.

#include <filesystem>

#include "lorica/analysis/run.h"

namespace lorica::cli {

/// \throw base::InputError where this build has no reports
void requireReports();

/// Pictures of the run and report.pdf beside its tables, both or none. \throw base::InputError, base::Cancelled
void writeRunReport(const analysis::LoadedStudy& study, const analysis::RunResult& result,
                    const std::filesystem::path& folder, base::Threads threads, bool quiet);

int reportFolder(const std::filesystem::path& folder, const std::filesystem::path& out);

}  // namespace lorica::cli
