#pragma once

/// \file
/// Threat data of a study against the posed person: what reaches which structure, when and how much, and which
/// structures the paths of fragments cross. The values are those of the field at the structures' surfaces: nothing in
/// the scene shields or reflects. See lorica/threat for the field and what holds between its points.

#include <filesystem>
#include <string>
#include <vector>

#include "lorica/analysis/loaded_study.h"
#include "lorica/base/progress.h"
#include "lorica/threat/field_sampler.h"

namespace lorica::analysis {

/// The data of one entry of Study::threats, placed in the scene, its times those of the scene.
struct LoadedThreat {
  std::string name;
  std::shared_ptr<const threat::ThreatField> field;
  std::optional<std::size_t> attribute;  ///< the study's, else the first; none when the data are paths alone
  base::Issues issues;
};

/// \param around what a built-in blast is worked out for, metres
/// \pre index < study.study.threats.size(), and around is not empty
/// \throw base::InputError for a missing or unusable file or attribute; base::Cancelled
LoadedThreat loadThreat(const LoadedStudy& study, std::size_t index, const geometry::Box3d& around,
                        base::Threads threads, const base::Progress& progress = {});

/// One structure in one pose.
struct ThreatRow {
  std::string threat;
  threat::Attribute attribute;
  std::string pose;
  std::string model;  ///< of organs, else empty
  std::string structure;
  std::string kind;            ///< body, region, organ, armor
  std::optional<double> time;  ///< seconds asked for; none: the greatest values over all times
  std::optional<double> peak;
  std::optional<double> peakTime;            ///< seconds; none for data without times
  std::optional<geometry::Vec3d> peakPlace;  ///< metres
  std::optional<double> mean;                ///< by area, of the values (over all times: of each place's greatest)
  std::optional<double> threshold;           ///< of the study
  std::optional<double> shareAbove;          ///< of areaWithValue, 0 to 1
  double area = 0.0;                         ///< m2
  double areaWithValue = 0.0;                ///< m2
  std::optional<double> peakImpulse;         ///< greatest integral over time; unit times seconds, pressure in Pa s
  std::optional<double> meanImpulse;         ///< by area
};

/// A fragment enters a structure.
struct FragmentCrossing {
  std::string threat;
  std::string pose;
  std::int64_t fragment = 0;
  std::size_t order = 0;  ///< of the crossing along the path, from 1
  std::string structure;
  std::string kind;   ///< body, organ, armor
  std::string group;  ///< armor system of a piece, model of an organ
  /// Systems with a piece that the path entered before; ';' between them.
  std::string armorBefore;
  std::optional<double> time;  ///< seconds; none for paths without times
  geometry::Vec3d place = geometry::Vec3d::Zero();
};

/// Across an axis of the scene.
struct SlicePlane {
  int axis = 1;  ///< 0 x, 1 y, 2 z
  double metres = 0.0;
};

struct ThreatOptions {
  std::vector<std::string> poses{};  ///< empty: defaultPoses()
  viscera::OrganModel model = viscera::OrganModel::dynamic;
  std::optional<double> time{};  ///< seconds; none: the greatest values over all times
  bool models = false;           ///< also the coloured models, a .vtp per threat and pose
  std::vector<double> levels{};  ///< also the surfaces of these values; need a time when the data have times
  std::vector<SlicePlane> slices{};
  std::optional<double> spacing{};  ///< of surfaces and slices, metres; default threat::typicalSpacing()
  base::Threads threads{};
};

/// A file of the result, by its name in the folder.
struct ThreatFile {
  std::string name;
  std::string bytes;
};

struct ThreatResult {
  std::vector<ThreatRow> rows;  ///< threat by threat, pose by pose; body, regions, organs, armor
  std::vector<FragmentCrossing> crossings;
  std::vector<ThreatFile> files;  ///< coloured models, surfaces and slices, .vtp
  base::Issues issues;
};

/// All threats of the study. \throw base::InputError when the study has none, for an unknown pose, for data as
/// loadThreat(), or where a time is needed; base::Cancelled
ThreatResult threatAnalysis(const LoadedStudy& study, const ThreatOptions& options,
                            const base::Progress& progress = {});

std::string threatCsv(const std::vector<ThreatRow>& rows);
std::string fragmentsCsv(const std::vector<FragmentCrossing>& crossings);

/// Writes threat.csv where there are values, fragments.csv where fragments cross something, and the files, all or none.
/// \return the names written. \throw base::InputError
std::vector<std::string> writeThreats(const ThreatResult& result, const std::filesystem::path& folder);

/// What an analyst wants to know of a file of threat data: size, times, attributes and their ranges.
/// \throw base::InputError, base::Cancelled
base::Issues checkThreatFile(const std::filesystem::path& path, const base::Progress& progress = {});
/// The same of the threats of a study, and whether they reach the body at rest. What cannot be read is an issue.
/// \throw base::Cancelled
base::Issues checkThreats(const LoadedStudy& study, base::Threads threads, const base::Progress& progress = {});

}  // namespace lorica::analysis
