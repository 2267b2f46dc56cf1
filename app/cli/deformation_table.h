#pragma once

#include <string>

#include "lorica/analysis/deformation.h"

namespace lorica::cli {

/// What poses do to all organs together, a line per pose and model, with the room inside the skin; empty without
/// organs.
std::string deformationTable(const analysis::DeformationTables& tables);

}  // namespace lorica::cli
