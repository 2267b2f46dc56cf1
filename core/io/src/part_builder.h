#pragma once

#include <optional>
#include <string>

#include "lorica/io/import.h"
#include "raw_model.h"
#include "reading.h"

namespace lorica::io {

/// Welds, cleans and turns a part whose positions are in the scene already; nothing when no triangle is left.
std::optional<Part> buildPart(RawPart raw, const std::string& name, Reading& reading);

}  // namespace lorica::io
