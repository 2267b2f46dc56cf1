#pragma once

/// \file
/// Gaps in the armor, and coverage over the places where organs may lie, as the window's tables have them. Names of
/// organ models are the window's; numbers are those of gaps.csv and anatomy.csv.

#include <span>

#include "lorica/analysis/anatomy.h"
#include "lorica/analysis/gaps.h"
#include "lorica/models/value_table.h"

namespace lorica::models {

/// A row for each gap, in their order.
TableContent gapTable(const analysis::RunResult& run, std::span<const analysis::Gap> gaps);
/// A row for each record, in their order.
TableContent anatomyTable(std::span<const analysis::AnatomyRecord> records, std::uint32_t draws);

}  // namespace lorica::models
