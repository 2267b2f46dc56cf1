#pragma once

/// \file
/// The gap finder: where on the skin shots enter that reach a structure past the armor, how large each such hole is,
/// from where it is shot through, and which pieces lie beside it.

#include <filesystem>

#include "lorica/analysis/run.h"
#include "lorica/shotline/gap_counter.h"
#include "lorica/shotline/open_patches.h"

namespace lorica::analysis {

/// One patch of skin through which shots reach a structure unprotected; or, with number 0 and without a place, all
/// unprotected shots that enter the skin in none.
struct Gap {
  std::size_t source = 0;
  std::size_t system = 0;  ///< index into RunResult::systems
  std::size_t model = 0;
  std::size_t pose = 0;
  std::string structure{};                            ///< "body" or an organ
  std::size_t number = 0;                             ///< from 1, the largest first
  shotline::OpenPatch patch{};                        ///< of the posed skin
  std::string region{};                               ///< of the body, that holds most of the area
  geometry::Vec3d towards = geometry::Vec3d::Zero();  ///< mean of unit vectors against its unprotected shots
  std::uint64_t openShots = 0;                        ///< of the structure under this system, in and out of patches
  struct Neighbour {
    std::string piece;
    double distance = 0.0;  ///< metres from the patch
  };
  std::vector<Neighbour> neighbours{};  ///< pieces of the system within neighbourReach, the nearest first
};

/// From where a gap is shot through, degrees.
struct GapBearing {
  double azimuth = 0.0;    ///< 0 ahead of the person, 90 on the left, from 0 to below 360
  double elevation = 0.0;  ///< 90 above
  double spread = 0.0;     ///< root mean square angle of its shots from there, for small ones; 0 of one direction
};
/// \pre the gap has a number
GapBearing bearingOf(const Gap& gap);

/// Farther pieces are no neighbours, metres.
inline constexpr double neighbourReach = 0.1;

/// Fails when a structure of the study's `gaps` is neither the body nor an organ, or an armor system has no piece.
/// \pre the study asks for gaps
/// \throw base::InputError
void checkGaps(const LoadedStudy& study);

/// Traces the shots of a finished run once more and finds the gaps: source by source, system by system (the body
/// without armor among them), model by model, pose by pose, structure by structure. The body has the same gaps in every
/// model. The same run gives the same gaps at any number of threads; memory does not grow with the shots.
/// \pre the study asks for gaps
/// \throw base::InputError as checkGaps, base::Cancelled
std::vector<Gap> findGaps(const LoadedStudy& study, const RunResult& result, base::Threads threads,
                          const base::Progress& progress = {});

/// A row for each gap.
std::string gapsCsv(const RunResult& result, const std::vector<Gap>& gaps);

/// findGaps() into a folder: gaps.csv, and, where the study asks for maps, gaps.SOURCE.SYSTEM.MODEL.POSE.vtp with skin,
/// watched organs and armor and the cell arrays "STRUCTURE patch", "STRUCTURE hits", "STRUCTURE unprotected" and
/// "STRUCTURE share".
/// \return names of the files
/// \throw as findGaps, and base::InputError when a file cannot be written; then nothing stays
std::vector<std::string> writeGaps(const LoadedStudy& study, const RunResult& result, base::Threads threads,
                                   const std::filesystem::path& folder, const base::Progress& progress = {});

}  // namespace lorica::analysis
