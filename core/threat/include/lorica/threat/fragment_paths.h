#pragma once

/// \file
/// Where fragments fly: the points of one id over time, joined to lines.

#include <cstdint>
#include <vector>

#include "lorica/threat/threat_field.h"

namespace lorica::threat {

struct FragmentPath {
  std::int64_t id = 0;
  std::vector<geometry::Vec3f> points;  ///< in the scene, in the order of time; without times in that of the file
  std::vector<double> times;            ///< seconds, one per point; empty when the field has none
};

/// One path per id, by id; also those of a single point. None when the field has no ids.
/// Cost: n log n.
std::vector<FragmentPath> fragmentPaths(const ThreatField& field);

}  // namespace lorica::threat
