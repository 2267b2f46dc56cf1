#pragma once

#include <filesystem>

#include "lorica/threat/read_threat.h"

namespace lorica::threat {

/// A field of one step from a file of VTK: .vti, .vtr, .vts, .vtp, .vtu or .vtk. Its time is that of the field array
/// TimeValue (or TIME), if it has one; the placement and points at one place are left to the caller.
/// \throw base::InputError
ReadField readVtk(const std::filesystem::path& path, const ReadOptions& options);

/// One file of a .pvd.
struct SeriesEntry {
  std::filesystem::path file;
  double time = 0.0;  ///< as written there
};
/// \throw base::InputError when it is no collection, names no file or its times do not rise
std::vector<SeriesEntry> readSeries(const std::filesystem::path& path);

}  // namespace lorica::threat
