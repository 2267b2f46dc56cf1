#pragma once

/// \file
/// Runs a study: every pose, source and trial, all systems and models on the same shots.

#include <span>

#include "lorica/analysis/deformation.h"
#include "lorica/shotline/pair_tally.h"

namespace lorica::analysis {

/// An even share of the shots of every trial: shots index * n / count up to (index + 1) * n / count.
struct RunPart {
  std::uint32_t index = 0;
  std::uint32_t count = 1;  ///< 1: the whole run
  bool operator==(const RunPart&) const = default;
};

/// What a run computes, when it is not all the study says. Empty and absent fields mean the study's own.
struct RunOptions {
  std::vector<std::string> poses;  ///< names or CLIP@SECONDS
  std::optional<std::uint64_t> seed;
  std::optional<std::uint32_t> trials;
  std::optional<std::uint64_t> shots;  ///< per trial, for every source but grids and lists, which have their own
  RunPart part;
  bool audit = true;  ///< measure the deformation
  bool shoot = true;  ///< else `results` has no trials, as of a run whose shots come from elsewhere
  base::Threads threads;
};

/// One source as it was shot from.
struct ShotSource {
  shotline::Source source;
  std::uint64_t shots = 0;    ///< per trial
  shotline::Measure measure;  ///< what all shots of a trial together make
};

/// Counts of one source at one pose, trial by trial.
struct SourcePoseResult {
  std::size_t source = 0;
  std::size_t pose = 0;
  std::vector<shotline::Tally> trials;  ///< those that were finished
  raycast::CastCounts counts;           ///< over all of them
  shotline::PairTally pairs;            ///< over all of them, when the study asks for `compare`
  std::optional<bool> goalReached{};    ///< whether the rule for stopping was met, where there is one
};

struct RunResult {
  std::vector<ShotSource> sources;
  std::vector<std::string> poses;
  std::vector<viscera::OrganModel> models;
  std::vector<std::string> systems;  ///< "unarmored" first
  std::uint64_t seed = 0;
  std::uint32_t trials = 0;                 ///< asked for; more with a rule for stopping
  std::vector<SourcePoseResult> results;    ///< source by source, pose by pose
  std::vector<std::size_t> collapsedSites;  ///< per pose, interior sites whose anchors collapsed
  /// Pose by pose, model by model, as far as the run came; a study without organs has rows without organs.
  std::vector<ModelDeformation> deformations;
  std::optional<viscera::SkinRoom> restRoom;            ///< none for a skin that does not close
  std::vector<std::optional<viscera::SkinRoom>> rooms;  ///< per pose, as far as the run came; none as for restRoom
  base::Issues issues;
  RunPart part;          ///< which share of the shots was shot
  bool partial = false;  ///< cancelled: `results` holds what was finished
};

/// How many trials a source has in a run, before a rule for stopping asks for more: a list of shots is the same in
/// every trial, so it has one.
std::uint32_t trialsOf(const RunResult& result, std::size_t source);

/// What a run would shoot from and at, without a shot: `results` has no trials.
/// \throw base::InputError for an unknown pose, a source that cannot be, and for what the rule for stopping, the
/// overlap policy or an analysis names and the study does not have
RunResult planRun(const LoadedStudy& study, const RunOptions& options, const base::Progress& progress = {});

/// Runs. When cancelled, returns what was finished and marks it partial. The same study, options and seed give the
/// same result at any number of threads.
/// With a rule for stopping in the study, each source and pose has as many trials as it takes.
/// A part of a run shoots its share of the shots alone; the deformation audit is the first part's.
/// \throw base::InputError as planRun, and for a part of a run with a rule for stopping, which asks for all shots
RunResult run(const LoadedStudy& study, const RunOptions& options, const base::Progress& progress = {});

/// The whole run from its parts, in their order: the same result, to the last bit, as of a run that was never cut,
/// wherever the parts were computed.
/// \pre they are parts 0, 1, ... of one run (study, options), all of them, none partial
RunResult merge(std::span<const RunResult> parts);

/// The shots of each trial that a part shoots.
shotline::ShotRange rangeOf(const RunPart& part, std::uint64_t shots);

}  // namespace lorica::analysis
