#pragma once

/// \file
/// How far coverage is open because nobody knows where in a person the organs lie: each organ is moved as a whole, at
/// random, by published displacements between postures and with the breath, and the same shots are traced again.

#include <array>
#include <optional>

#include "lorica/analysis/results.h"

namespace lorica::analysis {

/// One published range of an organ's place along one axis of the body.
struct PublishedRange {
  std::string organ;   ///< as built in
  int axis = 1;        ///< 0 to the person's left, 1 up, 2 forward
  double width = 0.0;  ///< metres, from the lowest to the highest place
  bool verified = false;
};

/// The table resources/tables/organ_motion.csv, which has every source.
const std::vector<PublishedRange>& publishedRanges();

/// How one organ is moved. Each component is normal, cut at two standard deviations, about the place the organ has in
/// the study; components are independent and add up. A published range is four standard deviations wide, so no draw
/// leaves it.
struct OrganJitter {
  std::string organ;
  enum class Basis { none, unverified, verified, given } basis = Basis::none;  ///< of ranges the weakest
  struct Component {
    int axis = 0;
    double deviation = 0.0;  ///< metres
  };
  std::vector<Component> components;  ///< none: the organ stays

  /// Standard deviation along each axis before the cut, metres.
  geometry::Vec3d deviation() const;
};

/// How the study's `anatomy` moves each of its organs. An organ has the ranges of the built-in one of its name; the
/// words of a name may stand in any order ("Left kidney").
/// \pre the study asks for anatomy
/// \throw base::InputError when a given deviation is of no organ of the study
std::vector<OrganJitter> jitterOf(const LoadedStudy& study);

/// A displacement in metres along the rest body's axes: a function of (seed, organ, draw) and of nothing else.
geometry::Vec3d displacement(const OrganJitter& jitter, std::uint64_t seed, std::uint32_t draw);

/// How far points inside a skin may go along `shift` before one of them comes nearer than 1 mm to leaving it, as a
/// share of it, 0 to 1. Points outside, and skins that do not close, do not count.
/// \param skin a built scene whose mesh 0 is the posed skin
double shareInside(const raycast::Scene& skin, std::span<const geometry::Vec3f> points, const geometry::Vec3d& shift,
                   base::Threads threads);

/// Coverage of a structure over the draws.
struct AnatomyRow {
  std::size_t source = 0;
  std::size_t pose = 0;
  std::size_t row = 0;                 ///< of the summary of that source and pose: organs, classes and `organs`
  std::vector<double> coverage;        ///< of the draws in which the structure was hit, rising
  std::vector<double> percentOfShots;  ///< of all draws, rising
  std::uint32_t heldBack = 0;          ///< draws in which the skin shortened the organ's displacement
};

struct AnatomyResult {
  std::vector<OrganJitter> jitter;  ///< per organ
  std::uint32_t draws = 0;
  std::vector<AnatomyRow> rows;  ///< source by source, pose by pose, in the order of the summary
};

/// Moves the organs of every pose of a finished run and traces its shots again for every draw. A displacement is turned
/// as the posed organ is against rest, and shortened where the organ would leave the skin (shareInside). Only organs
/// are refitted. Memory does not grow with the shots. The same run gives the same result at any number of threads. \pre
/// the study asks for anatomy \throw base::InputError as jitterOf, base::Cancelled
AnatomyResult overAnatomies(const LoadedStudy& study, const RunResult& run, base::Threads threads,
                            const base::Progress& progress = {});

/// What the draws say of one structure, as tables have it.
struct AnatomyRecord {
  ResultRow run;                                          ///< of the run itself, organs where the study has them
  std::optional<OrganJitter> jitter{};                    ///< of an organ; none of classes and of all organs together
  std::uint32_t heldBack = 0;                             ///< as AnatomyRow
  std::size_t drawsHit = 0;                               ///< draws in which it was hit
  std::array<std::optional<double>, 3> coverage{};        ///< 5th, 50th, 95th percentile over those, 0 to 1
  std::array<std::optional<double>, 3> percentOfShots{};  ///< over all draws
};

/// A record for each row of the result, in its order. \pre the result is of that run
std::vector<AnatomyRecord> anatomyRecords(const LoadedStudy& study, const RunResult& run, const AnatomyResult& result);

/// The name of a basis in tables: none, unverified, verified, given.
const char* nameOf(OrganJitter::Basis basis);

/// A row for each (source, system, model, pose, structure): the coverage of the run with its interval, and the 5th,
/// 50th and 95th percentile over the draws.
std::string anatomyCsv(const LoadedStudy& study, const RunResult& run, const AnatomyResult& result);

}  // namespace lorica::analysis
