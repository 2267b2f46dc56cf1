#pragma once

/// \file
/// Where a result comes from: enough to compute it again and to judge it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lorica/base/issue.h"
#include "lorica/study/study.h"

namespace lorica::study {

/// What azimuth and elevation of a shot mean, for those who read them.
inline constexpr auto azimuthConvention =
    "azimuth and elevation say where a shot comes from: azimuth 0 is ahead of the person (+z), 90 on its left (+x), "
    "elevation 90 above (+y)";

struct Provenance {
  struct SourceRecord {
    shotline::Source source;
    std::uint64_t shots = 0;  ///< per trial
    shotline::Measure measure;
  };
  struct RunRecord {
    std::string source;
    std::string pose;
    std::size_t trials = 0;  ///< finished
    std::uint64_t rays = 0;
    std::uint64_t retraced = 0;
    std::uint64_t unresolved = 0;
    std::uint64_t nearOpenEdge = 0;
    std::optional<bool> goalReached{};  ///< whether the study's rule for stopping was met
  };

  Study study;
  std::vector<InputFile> inputs;  ///< of the study, with the hashes of the files as they were read
  std::uint64_t seed = 0;
  std::uint32_t trials = 0;
  bool partial = false;
  std::vector<std::string> poses;
  std::vector<std::string> systems;
  std::vector<std::string> models;
  std::vector<SourceRecord> sources;
  std::vector<RunRecord> runs;
  std::size_t interiorSites = 0;
  std::vector<std::size_t> collapsedSites;  ///< per pose
  base::Issues issues;
  std::vector<std::string> tables;  ///< files of the run beside this one
};

/// JSON text. Depends on nothing but its argument and the program's version.
std::string provenanceText(const Provenance& provenance);

/// What a finished run says of itself in its provenance.json.
struct RunOrigin {
  std::uint64_t seed = 0;
  bool partial = false;
};

/// \throw base::InputError when the file is missing, damaged or does not say the seed
RunOrigin originOfRun(const std::filesystem::path& file);

/// The program's version, "MAJOR.MINOR.PATCH".
std::string version();

}  // namespace lorica::study
