#pragma once

/// \file
/// The tables of a finished run, read back from its folder: what results.h and its neighbours wrote, checked. For
/// reports and for whoever works on with a run. Numbers are as they stand in the files; a blank field is none.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lorica/study/run_facts.h"

namespace lorica::analysis {

/// Which rows belong together. A table without one of these columns leaves it empty.
struct RowPlace {
  std::string source;
  std::string system;
  std::string model;
  std::string pose;
  bool operator==(const RowPlace&) const = default;
};

/// A share with its 95 % interval.
struct Coverage {
  std::optional<double> value;  ///< 0 to 1
  std::optional<double> low;
  std::optional<double> high;
};

/// Of summary.csv.
struct CoverageRow {
  RowPlace place;
  std::string structure;
  std::string kind;
  std::string injuryClass;
  std::uint64_t shots = 0;
  std::uint64_t any = 0;
  std::uint64_t first = 0;
  std::uint64_t unprotectedHits = 0;
  std::uint64_t protectedHits = 0;
  double percentOfShots = 0.0;
  std::optional<double> percentOfBodyHits;
  Coverage coverage;
};

/// Of deformation.csv.
struct DeformationRow {
  std::string organ;
  std::string model;
  std::string pose;
  std::optional<double> volumeChange;  ///< %
  std::optional<double> outsideSkin;   ///< %
  std::optional<double> protrusion;    ///< mm
  std::optional<double> overlap;       ///< cm3, beyond rest
  std::optional<double> gap;           ///< mm, mean
  std::optional<double> largestGap;    ///< mm
  std::optional<double> stretch;       ///< largest, as a ratio
  std::uint64_t invertedCells = 0;
  std::string basis;
  std::string gaveWay;  ///< bars the organ did not keep; empty: none
};

/// Of contacts.csv.
struct ContactRow {
  std::string first;
  std::string second;
  std::string model;
  std::string pose;
  std::optional<double> overlap;     ///< cm3, beyond rest
  std::optional<double> largestGap;  ///< mm
};

/// Of room.csv.
struct RoomRow {
  std::string pose;
  std::optional<double> skin;         ///< litres
  std::optional<double> skinChange;   ///< %
  std::optional<double> torso;        ///< litres
  std::optional<double> torsoChange;  ///< %
};

/// Of comparisons.csv.
struct ComparisonRow {
  std::string what;  ///< system or model
  RowPlace place;    ///< without system and model
  std::string held;  ///< the model when systems are compared, the system when models are
  std::string first;
  std::string second;
  std::string structure;
  std::optional<double> coverageFirst;
  std::optional<double> coverageSecond;
  std::uint64_t onlyFirst = 0;
  std::uint64_t onlySecond = 0;
  std::optional<double> mcNemarHolm;
  Coverage difference;  ///< first minus second
  std::optional<double> pairedHolm;
};

/// Of pieces.csv.
struct PieceRow {
  RowPlace place;
  std::string piece;
  std::string structure;
  std::uint64_t any = 0;
  std::uint64_t protectedHits = 0;
  std::uint64_t alone = 0;  ///< hits that this piece alone protects
  std::optional<double> coverage;
  std::optional<double> without;
};

/// Of systems.csv.
struct SystemRow {
  RowPlace place;
  double area = 0.0;           ///< m2
  std::optional<double> mass;  ///< kg
  std::string structure;
  Coverage coverage;
};

/// Of convergence.csv.
struct ConvergenceRow {
  RowPlace place;
  std::string structure;
  std::string kind;
  std::uint64_t trials = 0;
  Coverage coverage;
};

/// Of gaps.csv.
struct GapRow {
  RowPlace place;
  std::string structure;
  std::uint64_t patch = 0;  ///< 0: shots that enter through no patch
  std::string region;
  std::optional<double> area;       ///< cm2
  std::optional<double> azimuth;    ///< degrees, where its shots come from
  std::optional<double> elevation;  ///< degrees
  std::uint64_t unprotectedHits = 0;
  std::optional<double> percentOfUnprotected;
  std::string neighbours;
};

/// Of anatomy.csv.
struct AnatomyTableRow {
  RowPlace place;
  std::string structure;
  std::string kind;
  std::uint64_t draws = 0;
  Coverage coverage;
  std::optional<double> p05, p50, p95;  ///< percentiles of the coverage over the draws
};

/// Of directions.csv.
struct DirectionRow {
  RowPlace place;  ///< without source
  std::string structure;
  std::string kind;
  double azimuth = 0.0;    ///< degrees
  double elevation = 0.0;  ///< degrees
  Coverage coverage;
  std::optional<double> unprotectedArea;  ///< m2
  bool lowest = false;                    ///< of all directions
};

/// Of motion.csv.
struct MotionRow {
  RowPlace place;  ///< without pose
  std::uint64_t frame = 0;
  double seconds = 0.0;
  std::string structure;
  std::string kind;
  Coverage coverage;
};

/// Of motion_summary.csv.
struct MotionSummaryRow {
  RowPlace place;  ///< without pose
  std::string structure;
  std::string kind;
  std::optional<double> mean;
  std::optional<double> lowest;
  std::optional<double> worstSeconds;
};

struct RunTables {
  study::RunFacts facts;
  std::vector<CoverageRow> summary;
  std::vector<DeformationRow> deformation;
  std::vector<ContactRow> contacts;
  std::vector<RoomRow> rooms;
  std::vector<ComparisonRow> comparisons;
  std::vector<PieceRow> pieces;
  std::vector<SystemRow> systems;
  std::vector<ConvergenceRow> convergence;
  std::vector<GapRow> gaps;
  std::vector<AnatomyTableRow> anatomy;
  std::vector<DirectionRow> directions;
  std::vector<MotionRow> motion;
  std::vector<MotionSummaryRow> motionSummary;
  std::vector<std::string> present;  ///< names of the tables that were read
  std::vector<std::string> missing;  ///< that the run was to have and has not: its analyses were stopped
};

/// Reads the folder of a run. Tables that provenance.json does not name are another run's and left alone.
/// \throw base::InputError when a file is missing, damaged, cut or of another run: file, line, what was expected, what
///        to do
RunTables readRunTables(const std::filesystem::path& folder);

}  // namespace lorica::analysis
