#pragma once

/// \file
/// Steps that a run and the merging of its parts share.

#include <chrono>

#include "commands.h"
#include "lorica/analysis/loaded_study.h"

namespace lorica::cli {

/// The study with the models that are asked for. \throw base::InputError, base::Cancelled
analysis::LoadedStudy loadForRun(const RunArguments& arguments);

analysis::RunOptions runOptions(const RunArguments& arguments);

/// Writes the tables, shoots what the study asks for beside the run, and tells the user. Returns the exit code.
int writeRun(const RunArguments& arguments, const analysis::LoadedStudy& study, analysis::RunResult result,
             std::chrono::steady_clock::time_point start);

}  // namespace lorica::cli
