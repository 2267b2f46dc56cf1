#pragma once

/// \file
/// The published tables that organs and vessels are made from, embedded in the program.

#include "lorica/base/table.h"

namespace lorica::manikin {

const base::Table& organTable();
const base::Table& vesselTable();

}  // namespace lorica::manikin
