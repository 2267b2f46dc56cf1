#pragma once

/// \file
/// What is known of single shots: one in full, or all of a run as a stream.

#include <filesystem>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/run.h"
#include "lorica/shotline/partition.h"

namespace lorica::analysis {

/// A passage of a shot with what it belongs to.
struct NamedPassage {
  shotline::Passage passage;
  std::string structure;
  std::string kind;               ///< body, organ or armor
  std::string group;              ///< system of a piece, model of an organ; empty for the body
  std::optional<double> depth{};  ///< metres from the first skin crossing to the entry; none for shots that miss it
};

/// One shot in one pose.
struct ShotDetails {
  std::string pose;
  raycast::Ray ray;
  std::vector<NamedPassage> passages;  ///< of all systems and models, in order
};

/// A shot by its name: SOURCE:TRIAL:SHOT, trials from 1 as in trials.csv, shots from 0. The source may hold colons.
struct ShotName {
  std::string source;
  std::uint32_t trial = 0;  ///< from 0
  std::uint64_t shot = 0;
};
/// \throw base::InputError when the text is none
ShotName shotNamed(const std::string& text);

/// A shot in every pose of a planned run.
/// \throw base::InputError when the run has no such source, trial or shot
std::vector<ShotDetails> shotDetails(const LoadedStudy& study, const RunResult& plan, const ShotName& name,
                                     base::Threads threads);

/// Those passages that are of the body, of a system's armor and of a model's organs.
std::vector<NamedPassage> passagesUnder(std::span<const NamedPassage> passages, const std::string& system,
                                        const std::string& model);

/// A shot cut into pieces with their owners, as the overlap policy of a study decides. The body is what all else lies
/// in: it owns only what nothing else does. \param passages of one armor system and one organ model
std::vector<shotline::Segment> segmentsOf(const study::Overlap& overlap, std::span<const NamedPassage> passages);

/// The shot as text: for each pose the passages in order, then for each armor system and organ model the shot cut into
/// pieces, with gaps and with overlaps as the study says.
std::string shotReport(const LoadedStudy& study, const RunResult& plan, const ShotName& name, base::Threads threads);

enum class HitFormat { csv, vtp };

/// Writes what every shot of a finished run goes through: hits.csv, a row per passage, or hits.vtp, a line per passage.
/// The run's shots are traced again, block by block; memory does not grow with their number. The same run gives the
/// same bytes at any number of threads.
/// \throw base::InputError when the file cannot be written, base::Cancelled; then nothing stays
void writeHits(const LoadedStudy& study, const RunResult& result, HitFormat format, const std::filesystem::path& folder,
               base::Threads threads, const base::Progress& progress = {});

}  // namespace lorica::analysis
