#pragma once

/// \file
/// Threat data from files: CSV, VTK images and rectilinear grids, VTK point sets, and time series of those.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lorica/base/issue.h"
#include "lorica/base/progress.h"
#include "lorica/base/units.h"
#include "lorica/threat/threat_field.h"

namespace lorica::threat {

enum class TimeUnit { second, millisecond, microsecond };

/// Seconds in one unit.
double secondsPer(TimeUnit unit);

struct ReadOptions {
  /// Of lengths; metres when neither this nor the file says one.
  std::optional<base::LengthUnit> units;
  /// Of times; seconds when neither this nor the file says one.
  std::optional<TimeUnit> timeUnits;
  char up = 'y';                        ///< 'y' or 'z'; becomes part of ThreatField::placement
  std::vector<std::string> attributes;  ///< those to read, without their units; empty: all
};

struct ReadField {
  ThreatField field;
  base::Issues issues;  ///< survivable trouble: `file` as given, points that lie at one place, values that are missing
};

/// Reads by the ending of the name:
/// - .csv, .txt, .tsv: a line of names, then a line per point; separated by commas, semicolons or tabs. Columns are
///   x, y, z, t (or time) if there are times, id (or fragment, fragment_id, track) if points belong together, all
///   others are attributes. A name may carry its unit, as x_mm, "x (mm)" or x [mm]; NAME_x, NAME_y, NAME_z make one
///   vector. Lines that begin with # are skipped. Rows may come in any order. Points that fill a lattice are read as
///   one.
/// - .vti, .vtr, .vtp, .vtu, .vts, .vtk: point data; the cell data where there is no point data, at the middles of the
///   cells. Other grids than images and rectilinear ones are taken as scattered points.
/// - .pvd: a collection of such files with their times. The files must agree in their attributes, and on their lattice.
/// Every number is checked. \throw base::InputError with the line and column, array, or file of the series, what was
///        expected and what to do; base::Cancelled
/// Cost: linear in the bytes of the file; memory: the file's bytes and twice the field.
ReadField readThreat(const std::filesystem::path& path, const ReadOptions& options = {},
                     const base::Progress& progress = {});

/// The same of the text of a CSV file. \param name how errors call it
ReadField readThreatCsv(std::string_view csv, const std::string& name, const ReadOptions& options = {},
                        const base::Progress& progress = {});

/// Whether files of this name are read as threat data alone: VTK's, and .pvd. A .csv may be anything.
bool isThreatFile(const std::filesystem::path& path);

/// The files that a time series (.pvd) names, in its order; nothing for other files.
/// \throw base::InputError when it cannot be read
std::vector<std::filesystem::path> filesOfSeries(const std::filesystem::path& path);

}  // namespace lorica::threat
