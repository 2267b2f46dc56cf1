#include "lorica/threat/read_threat.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "column_names.h"
#include "field_builder.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "read_vtk.h"

namespace lorica::threat {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 6> vtkEndings{".vti", ".vtr", ".vts", ".vtp", ".vtu", ".vtk"};
constexpr std::array<std::string_view, 3> textEndings{".csv", ".txt", ".tsv"};

std::string endingOf(const fs::path& path) {
  return lowerCase(path.extension().string());
}

template <std::size_t N>
bool isOneOf(const std::array<std::string_view, N>& endings, const std::string& ending) {
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// The same lattice to a millionth of its spacing; files of a series are often written with rounded coordinates.
bool isSame(const Lattice& a, const Lattice& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& planes = a.axes.at(axis);
    const std::vector<double>& others = b.axes.at(axis);
    if (planes.size() != others.size()) {
      return false;
    }
    const double spacing =
        planes.size() > 1 ? (planes.back() - planes.front()) / static_cast<double>(planes.size() - 1) : 1.0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (std::abs(planes[i] - others[i]) > 1e-6 * spacing) {
        return false;
      }
    }
  }
  return true;
}

ReadField readSeriesOf(const fs::path& path, const ReadOptions& options, const base::Progress& progress) {
  const std::vector<SeriesEntry> entries = readSeries(path);
  const double seconds = secondsPer(options.timeUnits.value_or(TimeUnit::second));
  ReadField all;
  for (std::size_t e = 0; e < entries.size(); ++e) {
    progress.check();
    const std::string file = entries[e].file.string();
    const std::string ending = endingOf(entries[e].file);
    if (!isOneOf(vtkEndings, ending)) {
      throw base::InputError(path.string(), fmt::format("entry {}", e + 1),
                             fmt::format("expected a .vti, .vtr, .vts, .vtp, .vtu or .vtk file, found \"{}\"", file));
    }
    ReadField one = readVtk(entries[e].file, options);
    one.field.steps.front().time = entries[e].time * seconds;
    if (e == 0) {
      all.field = std::move(one.field);
      all.field.timed = true;
    } else {
      if (one.field.attributes != all.field.attributes) {
        throw base::InputError(file, "", "has other arrays than the first file of the series; write the same into all");
      }
      if (one.field.lattice.has_value() != all.field.lattice.has_value() ||
          (one.field.lattice && !isSame(*one.field.lattice, *all.field.lattice))) {
        throw base::InputError(file, "", "has another grid than the first file of the series; use one grid for all");
      }
      all.field.steps.push_back(std::move(one.field.steps.front()));
    }
    base::append(all.issues, std::move(one.issues));
    progress.report(static_cast<double>(e + 1) / static_cast<double>(entries.size()));
  }
  return all;
}

}  // namespace

geometry::Quatd uprighting(char up) {
  LORICA_CHECK(up == 'y' || up == 'z', "y or z is up");
  return up == 'z' ? geometry::Quatd(geometry::zUpToYUp()) : geometry::Quatd::Identity();
}

double secondsPer(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::millisecond:
      return 1e-3;
    case TimeUnit::microsecond:
      return 1e-6;
    case TimeUnit::second:
      break;
  }
  return 1.0;
}

bool isThreatFile(const fs::path& path) {
  const std::string ending = endingOf(path);
  return ending == ".pvd" || isOneOf(vtkEndings, ending);
}

std::vector<fs::path> filesOfSeries(const fs::path& path) {
  std::vector<fs::path> files;
  if (endingOf(path) == ".pvd") {
    for (SeriesEntry& entry : readSeries(path)) {
      files.push_back(std::move(entry.file));
    }
  }
  return files;
}

ReadField readThreat(const fs::path& path, const ReadOptions& options, const base::Progress& progress) {
  const std::string ending = endingOf(path);
  ReadField read;
  if (isOneOf(textEndings, ending)) {
    read = readThreatCsv(base::readFile(path), path.string(), options, progress);
  } else if (ending == ".pvd") {
    read = readSeriesOf(path, options, progress);
  } else if (isOneOf(vtkEndings, ending)) {
    read = readVtk(path, options);
  } else {
    throw base::InputError(path.string(), "",
                           "is no threat data by its name; expected .csv, .vti, .vtr, .vts, .vtp, .vtu, .vtk or .pvd");
  }
  if (!isOneOf(textEndings, ending) && !read.field.lattice) {
    checkScattered(read.field, path.string(), read.issues);
  }
  read.field.placement.rotation = uprighting(options.up);
  return read;
}

}  // namespace lorica::threat
