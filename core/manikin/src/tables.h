#pragma once

/// \file
/// The published tables the built-in human is made from, embedded in the program.

#include "lorica/base/table.h"

namespace lorica::manikin {

const base::Table& anthropometryTable();
const base::Table& jointTable();
const base::Table& organTable();
const base::Table& vesselTable();

}  // namespace lorica::manikin
