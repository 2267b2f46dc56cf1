#pragma once

/// \file
/// A study with everything it names read, checked and bound: the body rigged, organs and armor tied to it.

#include <filesystem>
#include <memory>

#include "lorica/armor/piece_rig.h"
#include "lorica/human/clip.h"
#include "lorica/parenting/body_rig.h"
#include "lorica/study/study.h"
#include "lorica/viscera/organ_rig.h"
#include "lorica/viscera/soft_body.h"

namespace lorica::analysis {

struct LoadedOrgan {
  std::string name;
  viscera::OrganRig rig;
  std::shared_ptr<const raycast::MeshTopology> topology;
  base::Issues issues;
};

struct LoadedPiece {
  std::string name;
  armor::PieceRig rig;
  std::shared_ptr<const raycast::MeshTopology> topology;
  std::vector<geometry::TriangleMesh> nonProtecting;  ///< at rest, for pictures only
  base::Issues issues;
};

/// Immutable after loading; const use is thread-safe. Copies are cheap and share what was bound.
struct LoadedStudy {
  study::Study study;
  std::filesystem::path file;  ///< where relative inputs start; may be a file that does not exist
  std::shared_ptr<const parenting::BodyRig> body;
  std::vector<human::Clip> clips;
  std::vector<std::shared_ptr<const LoadedOrgan>> organs;  ///< in the study's order
  /// Of all organs; null where no model uses it (Study::models, Study::deformer) or the body has no skeleton.
  std::shared_ptr<const viscera::SoftBody> softBody;
  std::vector<std::shared_ptr<const LoadedPiece>> pieces;  ///< system by system, in the study's order
  std::vector<std::size_t> systemOfPiece;                  ///< indices into Study::systems
  bool thesisSites = false;                                ///< bound for `dynamic_thesis` too, asked for or not
  base::Issues bodyIssues;
  base::Issues fileIssues;  ///< of reading the inputs; `file` is the input's path
  base::Issues issues;      ///< all of them: body, organs, pieces, files
};

struct LoadOptions {
  /// Bind every organ for all four models, not only for those the study lists.
  bool allModels = false;
  /// An earlier loading: what the study still says in the same way is taken from it instead of read again.
  const LoadedStudy* previous = nullptr;
};

/// Reads the inputs of a study.
/// \param progress is advanced through the whole of it
/// \throw base::InputError for a missing, changed or unusable input, an unknown joint, clip or part; base::Cancelled
LoadedStudy load(study::Study study, const std::filesystem::path& file, base::Threads threads,
                 const base::Progress& progress = {}, const LoadOptions& options = {});

/// A pose by its name in the study, or by CLIP@SECONDS.
struct NamedPose {
  std::string name;
  std::optional<human::Pose> pose;  ///< none: rest
};

/// \throw base::InputError when the study has no such pose or clip, the time lies beyond the clip, or the body has no
///        skeleton to pose
NamedPose resolvePose(const LoadedStudy& study, const std::string& name);

/// The poses a run computes when none is asked for: those the study lists, else rest and all of them.
std::vector<std::string> defaultPoses(const study::Study& study);

}  // namespace lorica::analysis
