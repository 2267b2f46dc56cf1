#pragma once

/// \file
/// What both ways to find roles check.

#include <string>
#include <vector>

#include "lorica/human/joint_roles.h"

namespace lorica::human {

/// Names of the necessary roles without a joint.
std::vector<std::string> missingRoles(const RoleMap& roles);

/// \throw base::InputError when a joint does not hang below the one it has to
void requireChains(const Skeleton& skeleton, const RoleMap& roles);

}  // namespace lorica::human
