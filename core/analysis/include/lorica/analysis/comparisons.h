#pragma once

/// \file
/// Armor systems and organ models compared on the same shots, pieces left out one at a time, and how the coverage
/// settles with the number of trials. For runs whose study asks for `compare`.

#include "lorica/analysis/run.h"
#include "lorica/stats/intervals.h"

namespace lorica::analysis {

/// One structure under two systems, or in two models.
struct Comparison {
  std::string what;  ///< "system" or "model"
  std::string source;
  std::string pose;
  std::string held;  ///< the model when systems are compared, the system when models are
  std::string first;
  std::string second;
  std::string structure;  ///< body or an organ
  std::uint64_t shots = 0;
  shotline::Count countFirst;  ///< over all trials
  shotline::Count countSecond;
  std::optional<double> coverageFirst;  ///< of those counts; none when nothing was hit
  std::optional<double> coverageSecond;
  std::uint64_t onlyFirst = 0;  ///< shots protected (systems) or hit (models) in the first alone
  std::uint64_t onlySecond = 0;
  std::optional<double> mcNemarP;           ///< exact; none where the shots of a trial are not independent
  std::optional<double> mcNemarHolm;        ///< over the structures
  std::size_t trials = 0;                   ///< with a coverage in both
  std::optional<double> difference;         ///< mean over the trials of first minus second
  std::optional<stats::Interval> interval;  ///< 95 %, Student
  std::optional<double> t;                  ///< paired over the trials
  std::optional<double> pairedP;
  std::optional<double> pairedHolm;  ///< over the structures that have one
};

/// Every pair of systems, the unarmored body among them, in each model; then every pair of models under each system.
/// \pre the run was made with `compare`
std::vector<Comparison> comparisons(const LoadedStudy& study, const RunResult& result);

std::string comparisonsCsv(const std::vector<Comparison>& rows);
/// Leaving out one piece at a time: what coverage each piece alone gives. \pre as comparisons
std::string piecesCsv(const LoadedStudy& study, const RunResult& result);
/// Coverage with its interval after 1, 2, ... trials. Needs no `compare`.
std::string convergenceCsv(const LoadedStudy& study, const RunResult& result);
/// Mass and area of every system and piece beside the coverage of the classes: both are blank where the study and the
/// program know none. Needs no `compare`.
std::string systemsCsv(const LoadedStudy& study, const RunResult& result);

}  // namespace lorica::analysis
