#pragma once

/// \file
/// The mapping file: which joints of a rig play which role, for rigs whose names say nothing.

#include <filesystem>

#include "lorica/human/joint_roles.h"

namespace lorica::io {

/// Reads a JSON object whose members are roles ("pelvis", "shoulder_left", ...; human::rolesFromNames() lists them) and
/// whose values are a joint's name or a list of names:
///     {"pelvis": "joint_2", "lumbar": "joint_3", "shoulder_left": "joint_7", "toe_left": ["joint_15", "joint_16"]}
/// \throw base::InputError naming the file and the place: line and column where it is no JSON, else a JSON pointer
human::RoleMap readRoleFile(const std::filesystem::path& path, const human::Skeleton& skeleton);

}  // namespace lorica::io
