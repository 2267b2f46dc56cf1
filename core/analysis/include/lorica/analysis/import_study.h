#pragma once

/// \file
/// Makes a study from files: DESIGN's conventions for names, systems, carriage, classes and defaults.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lorica/analysis/loaded_study.h"
#include "lorica/base/issue.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/base/units.h"
#include "lorica/study/study.h"

namespace lorica::analysis {

/// One armor file, or one generated plate, and the system it joins.
struct ArmorRequest {
  std::string system;
  std::variant<std::filesystem::path, study::Builtin> from;
};

struct ImportRequest {
  std::filesystem::path skin;
  std::vector<std::filesystem::path> organs;
  std::vector<ArmorRequest> armor;
  std::vector<std::filesystem::path> motions;  ///< recorded, for the body to do; each a clip named by the file's stem
  bool split = false;                          ///< each node of an organ file is a structure of its own
  std::optional<base::LengthUnit> units;
  std::optional<char> up;           ///< 'y' or 'z'
  std::filesystem::path studyFile;  ///< where the study will be saved: inputs are named relative to it
  /// A study that organs and armor are added to: it keeps all it has, its body included, so that `skin` is not read;
  /// names are made unique against it, and pieces join a system of the same name. Its inputs are relative to
  /// studyFile. Null: a new study is made.
  const study::Study* addTo = nullptr;
  /// An earlier loading of that study, which spares reading it again; may be null.
  const LoadedStudy* previous = nullptr;
};

struct ImportedStudy {
  study::Study study;
  base::Issues issues;  ///< what was understood, guessed or is odd
};

/// Reads every file, so that what it returns loads. Nothing is written.
/// \throw base::InputError, base::Cancelled
ImportedStudy importStudy(const ImportRequest& request, base::Threads threads, const base::Progress& progress = {});

/// "essential", "desirable" or empty for a structure's name (Breeze et al. 2016, editable in the study): essential are
/// heart and great vessels, liver, spleen; desirable are lungs, kidneys, trachea, spinal cord, intestines.
std::string injuryClassOf(std::string_view name);

}  // namespace lorica::analysis
