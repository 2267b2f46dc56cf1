#pragma once

/// \file
/// What provenance.json says of a run, read back.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lorica::study {

struct RunFacts {
  struct Input {
    std::string file;
    std::string sha256;  ///< may be empty
  };
  struct Stop {
    std::vector<std::string> structures;
    double halfWidth = 0.0;  ///< of the coverage's interval, 0 to 1
    std::uint64_t maxTrials = 0;
  };
  struct Source {
    std::string name;
    std::string type;      ///< point, parallel, band, list
    std::string sampler;   ///< of points
    std::string sequence;  ///< random, sobol, grid
    std::string interval;  ///< how its intervals are made, in words
    std::string basis;     ///< what its percentages are of, in words
    std::uint64_t shotsPerTrial = 0;
    std::vector<double> position;      ///< m; of points
    std::vector<double> azimuth;       ///< degrees; one of a beam, two of a band
    std::vector<double> elevation;     ///< likewise
    std::optional<double> halfAngle;   ///< degrees, of a cone
    std::optional<double> solidAngle;  ///< sr
    std::optional<double> area;        ///< m2
  };
  struct Run {
    std::string source;
    std::string pose;
    std::uint64_t trials = 0;  ///< finished
    std::uint64_t shots = 0;
    std::uint64_t retraced = 0;
    std::uint64_t unresolved = 0;
    std::uint64_t nearOpenEdge = 0;
    std::optional<bool> goalReached;  ///< of the rule for stopping
  };

  std::string version;  ///< of Lorica
  bool partial = false;
  std::string study;
  std::string description;
  std::string studyHash;  ///< SHA-256
  std::vector<Input> inputs;
  std::uint64_t seed = 0;
  std::uint64_t trials = 0;  ///< asked for
  std::optional<Stop> stop;
  std::vector<std::string> models;
  std::vector<std::string> systems;
  std::vector<std::string> poses;
  std::vector<Source> sources;
  std::string skinning;
  std::string deformer;
  std::uint64_t interiorSites = 0;
  std::vector<Run> runs;
  std::vector<std::string> issues;                 ///< a line each
  std::optional<std::vector<std::string>> tables;  ///< files of the run; none: written before this was told
};

/// \throw base::InputError for a missing or damaged file, with line and column or JSON pointer and what was expected
RunFacts readProvenance(const std::filesystem::path& file);

}  // namespace lorica::study
