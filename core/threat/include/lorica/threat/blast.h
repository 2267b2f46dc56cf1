#pragma once

/// \file
/// The blast wave of a charge in free air by published formulas: a field to try things with, and to judge measured
/// data beside. Peak and duration of the overpressure: Kinney and Graham (1985), Explosive Shocks in Air, 2nd ed.,
/// tables of chemical explosions; its course: Friedlander (1946), Proc. R. Soc. A 186, p(t) = Ps (1 - t/td) exp(-t/td);
/// the speed of the front: Rankine and Hugoniot for air of ratio of specific heats 1.4. Without reflection by ground or
/// body. Overpressure is what a gauge beside the wave reads, not what a wall that faces it bears.

#include "lorica/base/parallel.h"
#include "lorica/threat/threat_field.h"

namespace lorica::threat {

/// The standard atmosphere at sea level (ISO 2533).
inline constexpr double ambientPressure = 101325.0;   ///< Pa
inline constexpr double ambientSoundSpeed = 340.294;  ///< m/s

/// The wave at a distance.
struct BlastWave {
  double arrival = 0.0;   ///< seconds after the detonation
  double peak = 0.0;      ///< Pa above ambient, at arrival
  double duration = 0.0;  ///< seconds that the pressure stays above ambient
};

/// \param tntKilograms of TNT, or of what is as strong
/// \param metres from the middle of the charge
/// \pre both positive
BlastWave blastWave(double tntKilograms, double metres);

/// Overpressure, Pa, at a time after the detonation: 0 before the arrival, negative after the duration.
double overpressure(const BlastWave& wave, double seconds);

/// A blast and the box in which it is asked for.
struct BlastOptions {
  double tntKilograms = 1.0;                           ///< above 0
  geometry::Vec3d position = geometry::Vec3d::Zero();  ///< of the charge, metres
  geometry::Box3d box{geometry::Vec3d(-1.2, -0.1, -1.2), geometry::Vec3d(1.2, 2.3, 1.2)};
  double spacing = 0.06;    ///< of the lattice, metres, above 0; the box grows to whole cells
  std::size_t steps = 100;  ///< of time, at least 2, evenly from the arrival at the nearest point of the lattice to the
                            ///< end of the positive phase at the farthest
};

/// The attribute `pressure` in kPa on a lattice, times from the detonation. Points within 5 cm of the charge take the
/// wave at 5 cm. The front is smeared over a cell and a step, so a peak between points is below blastWave()'s.
/// \pre as the options say
ThreatField blastField(const BlastOptions& options, base::Threads threads = {});

}  // namespace lorica::threat
