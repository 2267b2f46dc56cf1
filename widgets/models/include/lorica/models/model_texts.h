#pragma once

/// \file
/// The four organ models as the window names them.

#include <QString>
#include <array>

#include "lorica/viscera/organ_rig.h"

namespace lorica::models {

struct ModelText {
  viscera::OrganModel model;
  QString label;
  QString tip;  ///< one sentence
};

std::array<ModelText, 4> modelTexts();

}  // namespace lorica::models
