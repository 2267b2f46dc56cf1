#pragma once

/// \file
/// Two finished runs compared, structure by structure, from the tables they left: two armors, postures, models or
/// persons that were not shot at in one study.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lorica/stats/intervals.h"

namespace lorica::analysis {

/// One structure in two runs.
struct RunComparison {
  std::string source;
  std::string systemFirst, systemSecond;
  std::string modelFirst, modelSecond;
  std::string poseFirst, poseSecond;
  std::string structure;
  std::string kind;
  std::string measure;  ///< "pct_of_shots", per cent; or "coverage", 0 to 1
  std::size_t trialsFirst = 0;
  std::size_t trialsSecond = 0;
  std::uint64_t hitsFirst = 0;  ///< of those trials: any hits, or protected ones where the measure is coverage
  std::uint64_t ofFirst = 0;    ///< what they are a share of: shots, or any hits
  std::uint64_t hitsSecond = 0;
  std::uint64_t ofSecond = 0;
  double meanFirst = 0.0;  ///< over the trials
  double meanSecond = 0.0;
  double difference = 0.0;                  ///< first minus second
  std::optional<stats::Interval> interval;  ///< 95 %
  std::string test;                         ///< "welch", or "paired" for runs on the same shots
  std::optional<double> t;                  ///< none when nothing varies
  std::optional<double> degreesOfFreedom;
  std::optional<double> p;      ///< two-sided
  std::optional<double> pHolm;  ///< over the structures of one source, system, model, pose and measure
};

struct RunComparisons {
  bool paired = false;
  bool partialFirst = false;  ///< the run was cut short: its finished trials are compared
  bool partialSecond = false;
  std::vector<RunComparison> rows;
  std::size_t unmatched = 0;  ///< structures that only one of the runs has
};

/// Compares the folders of two runs (trials.csv and provenance.json of each). Runs with different seeds are
/// independent: Welch's t (stats::welch). Runs with the same seed met the same shots wherever their sources have the
/// same name, so their trials go in pairs (stats::pairedT). Rows match by source, system, model, pose and structure;
/// where each run has but one system beside `unarmored`, one model or one pose, these may differ.
/// \throw base::InputError when a table is missing or damaged, when a source has another basis in the second run, when
///        the runs share no structure with two trials each, or when both folders are the same
RunComparisons compareRuns(const std::filesystem::path& first, const std::filesystem::path& second);

/// Marked as partial (see results.h) when one of the runs is.
std::string runComparisonsCsv(const RunComparisons& comparisons);

}  // namespace lorica::analysis
