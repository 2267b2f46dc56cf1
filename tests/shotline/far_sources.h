#pragma once

#include <numbers>

#include "lorica/shotline/source.h"

namespace lorica::shotline {

inline constexpr double fullTurn = 2.0 * std::numbers::pi;

inline Source beamFrom(double azimuth, double elevation, double radius, Sequence sequence = Sequence::random,
                       std::uint64_t gridSide = 1) {
  return {"far", ParallelBeam{azimuth, elevation, {0, 0, 0}, radius, gridSide}, sequence};
}

inline Source bandOf(AngleRange azimuth, AngleRange elevation, double radius, Sequence sequence = Sequence::random) {
  return {"band", DirectionBand{azimuth, elevation, {0, 0, 0}, radius}, sequence};
}

inline Source everyDirection(double radius, Sequence sequence = Sequence::random) {
  return bandOf({0, fullTurn}, {-0.25 * fullTurn, 0.25 * fullTurn}, radius, sequence);
}

}  // namespace lorica::shotline
