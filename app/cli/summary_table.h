#pragma once

#include <string>

#include "lorica/analysis/results.h"

namespace lorica::cli {

/// The summary as a person reads it: for every source, pose and armor system one table, organs down, models across.
std::string summaryTable(const analysis::RunResult& result, const std::vector<analysis::ResultRow>& rows);

}  // namespace lorica::cli
