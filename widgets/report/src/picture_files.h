#pragma once

/// \file
/// Pictures of a run as the files of its folder.

#include <vector>

#include "lorica/base/files.h"
#include "lorica/report/report.h"

namespace lorica::report {

/// PNG files, pictures.csv and legend.csv in the folder's `pictures`, which say of what study they are.
std::vector<base::FileBytes> pictureFiles(const PictureSet& set, const std::string& studyHash,
                                          const std::filesystem::path& folder);

}  // namespace lorica::report
