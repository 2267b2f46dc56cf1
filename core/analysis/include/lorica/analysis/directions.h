#pragma once

/// \file
/// Coverage by direction and over a motion.

#include <optional>
#include <span>

#include "lorica/analysis/run.h"

namespace lorica::analysis {

struct ResultRow;

/// Counts of a parallel beam from one direction, at one pose.
struct DirectionResult {
  std::size_t pose = 0;  ///< index into the run's
  double azimuth = 0.0;  ///< degrees, as lorica/shotline/source.h has it
  double elevation = 0.0;
  double area = 0.0;  ///< m2 across the shots
  shotline::Tally tally;
};

/// Shoots every posed body of a planned run with a parallel beam from each direction of a grid: the middles of the
/// cells that the study's `directions` divides azimuth and elevation into, elevation by elevation from below.
/// \pre the study asks for directions
/// \throw base::Cancelled
std::vector<DirectionResult> byDirection(const LoadedStudy& study, const RunResult& plan, base::Threads threads,
                                         const base::Progress& progress = {});

/// One structure under one system, seen from one direction.
struct DirectionRow {
  const ResultRow* row = nullptr;  ///< of the shots from there
  double area = 0.0;               ///< m2 across the shots

  /// Of the structure, as seen from there, m2.
  double unprotectedArea() const;
};

/// The worst of the directions of one structure, as places in the rows; none where the system covers it from nowhere.
struct WorstDirections {
  /// Whose coverage interval ends lowest, as a few hits that went through are no evidence yet; of equals the first of
  /// the largest unprotected area.
  std::optional<std::size_t> lowestCoverage;
  std::optional<std::size_t> largestUnprotected;
};
WorstDirections worstDirections(std::span<const DirectionRow> rows);

/// A row for each (system, model, pose, direction, structure), with a mark at the direction of lowest coverage (that
/// whose interval ends lowest) and at that of the largest unprotected area of each structure, where the system covers
/// the structure at all.
std::string directionsCsv(const LoadedStudy& study, const RunResult& plan, const std::vector<DirectionResult>& results);

/// Counts of one frame of a motion from one source, over all trials.
struct FrameResult {
  std::size_t source = 0;
  std::size_t frame = 0;
  double seconds = 0.0;
  std::vector<shotline::Tally> trials;
};

struct MotionResult {
  RunResult plan;                   ///< of the frames as poses; its results are empty
  std::vector<FrameResult> frames;  ///< source by source, frame by frame
};

/// Runs a study over the frames of its `motion`: one scene that is moved and refitted from frame to frame, all frames
/// met by the same shots.
/// \pre the study asks for a motion
/// \throw base::InputError for an unknown clip, base::Cancelled
MotionResult overMotion(const LoadedStudy& study, const RunOptions& options, const base::Progress& progress = {});

/// A row for each (source, system, model, frame, structure).
std::string motionCsv(const LoadedStudy& study, const MotionResult& result);
/// A row for each (source, system, model, structure): the mean over time (trapezoids between frames that hit), and the
/// frame of lowest coverage.
std::string motionSummaryCsv(const LoadedStudy& study, const MotionResult& result);

}  // namespace lorica::analysis
