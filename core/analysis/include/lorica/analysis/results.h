#pragma once

/// \file
/// A run as tables: summary.csv, trials.csv, deformation.csv, contacts.csv, room.csv, provenance.json.

#include <filesystem>
#include <string>
#include <string_view>

#include "lorica/analysis/run.h"
#include "lorica/stats/accumulators.h"
#include "lorica/stats/intervals.h"

namespace lorica::analysis {

/// One row of a table. Counts are of shots.
struct ResultRow {
  std::string source;
  std::string system;
  std::string model;
  std::string pose;
  std::optional<std::uint32_t> trial;  ///< none: all trials together
  std::string structure;
  std::string kind;         ///< body, region, organ, armor, aggregate
  std::string injuryClass;  ///< essential, desirable or empty
  std::uint64_t shots = 0;
  std::uint64_t bodyHits = 0;
  shotline::Count count;
  shotline::Measure measure;                       ///< what `shots` together make, as those of one trial do
  bool independent = true;                         ///< the shots of each other: Wilson's interval holds
  bool drawn = true;                               ///< at random; a list of shots has no interval
  std::vector<stats::TrialCount> shareByTrial;     ///< any hits of shots, per trial of this row
  std::vector<stats::TrialCount> coverageByTrial;  ///< protected of any hits

  std::uint64_t unprotected() const { return count.any - count.shielded; }
  double percentOfShots() const;
  /// Any hit among body hits over body hits, percent; none without body hits.
  std::optional<double> percentOfBodyHits() const;
  /// Protected over any, 0 to 1; none when nothing was hit.
  std::optional<double> coverage() const;
  /// 95 %; none when nothing was hit. Wilson for independent shots, else across trials (stats::ratioInterval), which
  /// needs two that differ.
  std::optional<stats::Interval> coverageInterval() const;
  /// Of any hits over shots, likewise, 0 to 1.
  std::optional<stats::Interval> shareInterval() const;
  /// Mean and spread of the trials' coverage; none with fewer than two trials that hit.
  std::optional<stats::Moments> coverageOverTrials() const;
};

/// Rows in the order source, system, model, pose, structure; summed over trials.
std::vector<ResultRow> summaryRows(const LoadedStudy& study, const RunResult& result);
/// The same with one row per trial.
std::vector<ResultRow> trialRows(const LoadedStudy& study, const RunResult& result);

/// What the run knows of the organs' deformation, for the tables of deformation.h.
DeformationTables deformationTables(const LoadedStudy& study, const RunResult& result);

std::string summaryCsv(const std::vector<ResultRow>& rows);
std::string trialsCsv(const std::vector<ResultRow>& rows);
/// Version, study and input hashes, sources with their cones, counts of retraced and unresolved shots, issues, and
/// whether the run is partial. Holds no time and no thread count: the same run gives the same bytes.
std::string provenanceJson(const LoadedStudy& study, const RunResult& result);

/// A table with a column `partial` at its end that says "yes" in every row: what a run that was cut short leaves is
/// known for it wherever the file goes. Tables of finished runs have no such column.
std::string markedPartial(std::string_view csv);

/// provenance.json alone, as when a run is finished and its analyses are not. \throw base::InputError
void writeProvenance(const LoadedStudy& study, const RunResult& result, const std::filesystem::path& folder);

/// Writes the six files, and those of comparisons and convergence where the study asks for them, into a folder, all of
/// them or none. The tables of a partial result are marked so. \throw base::InputError
void writeResults(const LoadedStudy& study, const RunResult& result, const std::filesystem::path& folder);

/// Shoots and writes what the study asks for beside the run: gaps.csv with its maps, anatomy.csv, directions.csv,
/// motion.csv, motion_summary.csv.
/// \return names of the files written
/// \throw base::InputError, base::Cancelled; then none of the analysis at hand stays
std::vector<std::string> writeAnalyses(const LoadedStudy& study, const RunResult& result, const RunOptions& options,
                                       const std::filesystem::path& folder, const base::Progress& progress = {});

}  // namespace lorica::analysis
