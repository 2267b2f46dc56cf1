#pragma once

/// \file
/// Recorded motions of a study, done by its body.

#include "lorica/analysis/loaded_study.h"
#include "lorica/human/joint_roles.h"

namespace lorica::analysis {

/// What the joints of a study's own skeleton stand for.
/// \throw base::InputError as human::findRoles() and human::rolesFromNames(); its place is a role, not one of the study
human::RoleMap bodyRoles(const study::Study& study, const human::Skeleton& skeleton);

/// Reads the study's motions and puts them behind its clips. \pre `study` has its body and the clips that body has
/// \param previous an earlier loading on the same body, whose motions are taken as they are; may be null
/// \return what was understood and is odd, `file` being the input's path
/// \throw base::InputError
base::Issues addMotions(LoadedStudy& study, const LoadedStudy* previous, const base::Progress& progress);

}  // namespace lorica::analysis
