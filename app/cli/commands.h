#pragma once

/// \file
/// One function per command of the program. Each returns an exit code and throws what main() turns into one.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lorica/analysis/import_study.h"
#include "lorica/analysis/run.h"
#include "lorica/analysis/threats.h"
#include "lorica/human/person.h"

namespace lorica::cli {

struct RunArguments {
  std::filesystem::path study;
  std::filesystem::path out;
  int threads = 0;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint32_t> trials;
  std::optional<std::uint64_t> shots;
  std::vector<std::string> poses;
  std::vector<std::string> models;
  std::string shotReport;                 ///< SOURCE:TRIAL:SHOT; empty: a run
  std::string hits;                       ///< csv, vtp or empty
  std::optional<analysis::RunPart> part;  ///< of several that run apart: its counts alone are written
  bool pdf = false;                       ///< also the report
  bool quiet = false;
};
int runStudy(const RunArguments& arguments);

struct MergeArguments {
  std::vector<std::filesystem::path> parts;  ///< folders
  std::filesystem::path study;               ///< empty: where the parts found it
  std::filesystem::path out;
  int threads = 0;
  bool quiet = false;
};
int mergeParts(const MergeArguments& arguments);

int checkFiles(const std::vector<std::filesystem::path>& files, bool acceptInputs);

int printTemplate(const std::string& name, bool list);

int importFiles(const analysis::ImportRequest& request);

struct GenerateArguments {
  human::Sex sex = human::Sex::male;
  std::optional<double> stature;     ///< m; with mass or not at all
  std::optional<double> mass;        ///< kg
  std::optional<double> percentile;  ///< of stature and mass; the median when none of the three is given
  std::filesystem::path out;
};
int generateHuman(const GenerateArguments& arguments);

struct ExportArguments {
  std::filesystem::path study;
  std::string pose;
  std::string format;
  std::string model;
  std::filesystem::path out;
};
int exportPose(const ExportArguments& arguments);

struct ThreatArguments {
  std::filesystem::path study;
  std::filesystem::path out;
  std::vector<std::string> poses;
  std::string model;
  std::optional<double> timeMs;
  bool models = false;
  std::vector<double> levels;
  std::vector<std::string> slices;  ///< AXIS@METRES
  std::optional<double> spacingMm;
  int threads = 0;
  bool quiet = false;
};
/// Reads x@METRES, y@METRES or z@METRES; nothing for any other text.
std::optional<analysis::SlicePlane> sliceNamed(const std::string& text);
int exposeToThreats(const ThreatArguments& arguments);

int compareRuns(const std::filesystem::path& first, const std::filesystem::path& second,
                const std::filesystem::path& out);

int upgradeStudy(const std::filesystem::path& file, const std::filesystem::path& out);

int runBenchmarks(const std::filesystem::path& json);

}  // namespace lorica::cli
