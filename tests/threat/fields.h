#pragma once

/// \file
/// Fields whose values are known everywhere.

#include <functional>

#include "lorica/threat/threat_field.h"

namespace lorica::threat {

using Law = std::function<double(const geometry::Vec3d& place, double time)>;

/// Planes from `low`, `count` of them.
inline std::vector<double> planes(double low, double spacing, std::size_t count) {
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(low + spacing * static_cast<double>(i));
  }
  return result;
}

/// The law at the points of a lattice.
inline ThreatField latticeField(Lattice lattice, const std::vector<double>& times, const Law& law) {
  ThreatField field;
  field.attributes = {{"pressure", "kPa"}};
  field.timed = times.size() > 1;
  for (const double time : times) {
    Step& step = field.steps.emplace_back();
    step.time = time;
    std::vector<float>& values = step.values.emplace_back();
    for (std::size_t p = 0; p < lattice.points(); ++p) {
      values.push_back(static_cast<float>(law(lattice.place(p), time)));
    }
  }
  field.lattice = std::move(lattice);
  return field;
}

/// The law at scattered points, the same at all times.
inline ThreatField pointField(geometry::Positions points, const std::vector<double>& times, const Law& law) {
  ThreatField field;
  field.attributes = {{"pressure", "kPa"}};
  field.timed = times.size() > 1;
  const auto shared = std::make_shared<const geometry::Positions>(std::move(points));
  for (const double time : times) {
    Step& step = field.steps.emplace_back();
    step.time = time;
    step.points = shared;
    std::vector<float>& values = step.values.emplace_back();
    for (const geometry::Vec3f& point : *shared) {
      values.push_back(static_cast<float>(law(point.cast<double>(), time)));
    }
  }
  return field;
}

/// Numbers from 0 to 1 that look random and are the same everywhere.
class Numbers {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) * 0x1p-53;
  }
  geometry::Vec3d place(double low, double high) {
    const double x = next();
    const double y = next();
    return geometry::Vec3d::Constant(low) + (high - low) * geometry::Vec3d(x, y, next());
  }
  geometry::Positions places(std::size_t count, double low, double high) {
    geometry::Positions all;
    for (std::size_t i = 0; i < count; ++i) {
      all.emplace_back(place(low, high).cast<float>());
    }
    return all;
  }

 private:
  std::uint64_t state_ = 1;
};

}  // namespace lorica::threat
