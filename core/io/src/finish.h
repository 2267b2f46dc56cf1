#pragma once

#include "lorica/io/import.h"
#include "raw_model.h"
#include "reading.h"

namespace lorica::io {

/// What a format says about itself; nothing means it has to be guessed.
struct FormatFrame {
  std::optional<base::LengthUnit> units;
  std::optional<UpAxis> up;
};

/// Brings a raw model into metres and the scene's axes, welds and audits its parts and gives everything its name.
Model finish(RawModel raw, const FormatFrame& frame, const ImportOptions& options, Reading& reading);

}  // namespace lorica::io
