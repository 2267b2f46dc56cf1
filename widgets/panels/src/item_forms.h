#pragma once

/// \file
/// The rows of each kind of thing, by its name.

#include "lorica/panels/property_form.h"

namespace lorica::panels {

void fillBody(PropertyForm& form);
void fillRegion(PropertyForm& form, const std::string& name);
void fillOrgan(PropertyForm& form, const std::string& name);
void fillSystem(PropertyForm& form, const std::string& name);
void fillPiece(PropertyForm& form, const std::string& name);
void fillRun(PropertyForm& form, const std::string& name);

}  // namespace lorica::panels
