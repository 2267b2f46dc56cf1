#pragma once

/// \file
/// From points as files list them to a field.

#include <string>
#include <vector>

#include "lorica/base/issue.h"
#include "lorica/base/progress.h"
#include "lorica/threat/threat_field.h"

namespace lorica::threat {

/// A table of points, a row each.
struct PointRows {
  geometry::Positions places;     ///< metres
  std::vector<double> times;      ///< seconds; empty when there are none
  std::vector<std::int64_t> ids;  ///< empty when there are none
  std::vector<Attribute> attributes;
  std::vector<std::vector<float>> values;  ///< per attribute, finite
};

/// Rows of one time make a step, in their order. Points that fill a lattice of two planes at least along each axis, the
/// same at all times, become one. \throw base::InputError when an id is twice at one time; base::Cancelled
/// \param file how errors and issues call it
ThreatField fieldOf(PointRows rows, const std::string& file, base::Issues& issues, const base::Progress& progress);

/// The turn that makes the file's up axis the scene's. \pre up is 'y' or 'z'
geometry::Quatd uprighting(char up);

/// What holds for scattered points of any origin: equal sets of points are shared, points at one place are an issue.
/// \throw base::InputError when an id is twice at one time
void checkScattered(ThreatField& field, const std::string& file, base::Issues& issues);

}  // namespace lorica::threat
