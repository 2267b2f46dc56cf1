#pragma once

/// \file
/// The four organ models, and what can be seen of how they work, as the window names them.

#include <QString>
#include <array>
#include <string>

#include "lorica/document/inspection.h"
#include "lorica/viscera/organ_rig.h"

namespace lorica::models {

struct ModelText {
  viscera::OrganModel model;
  QString label;
  QString tip;  ///< one sentence
};

std::array<ModelText, 4> modelTexts();
/// How the window names a model; files have viscera::name().
QString modelLabel(viscera::OrganModel model);
/// The same of a name as files have it; what is no model's name stays as it is.
QString modelFromFile(const std::string& name);

struct DriverText {
  document::Driver driver;
  QString label;
  QString tip;
};

std::array<DriverText, 5> driverTexts();

struct ColouringText {
  document::Colouring colouring;
  QString label;
  QString tip;
};

std::array<ColouringText, 3> colouringTexts();

}  // namespace lorica::models
