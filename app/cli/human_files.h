#pragma once

/// \file
/// The built-in human as files: what `generate human` writes.

#include <filesystem>
#include <vector>

#include "lorica/base/files.h"
#include "lorica/base/progress.h"
#include "lorica/manikin/human.h"

namespace lorica::cli {

/// body.glb, organs/NAME.glb, armor/SYSTEM/PIECE.glb and facts.json below a folder. Nothing is written.
/// \throw base::Cancelled
std::vector<base::FileBytes> humanFiles(const manikin::Human& human, const std::filesystem::path& folder,
                                        const base::Progress& progress);

/// What was measured on the human beside what was wanted, with the sources: the text of facts.json.
std::string humanFacts(const manikin::Human& human);

}  // namespace lorica::cli
