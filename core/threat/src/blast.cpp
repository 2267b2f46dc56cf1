#include "lorica/threat/blast.h"

#include <algorithm>
#include <cmath>

#include "lorica/base/error.h"

namespace lorica::threat {

using geometry::Vec3d;

namespace {

double square(double value) {
  return value * value;
}

/// Peak overpressure over ambient pressure at scaled distance Z, m/kg^(1/3) (Kinney and Graham 1985).
double peakRatio(double z) {
  return 808.0 * (1.0 + square(z / 4.5)) /
         std::sqrt((1.0 + square(z / 0.048)) * (1.0 + square(z / 0.32)) * (1.0 + square(z / 1.35)));
}

/// Duration of the positive phase over the cube root of the charge, s/kg^(1/3) (Kinney and Graham 1985).
double scaledDuration(double z) {
  return 0.98 * (1.0 + std::pow(z / 0.54, 10)) /
         ((1.0 + std::pow(z / 0.02, 3)) * (1.0 + std::pow(z / 0.74, 6)) * std::sqrt(1.0 + square(z / 6.9)));
}

/// Seconds the front needs from the charge to scaled distance Z, over the cube root of the charge: the integral of one
/// over its speed, c sqrt(1 + 6/7 p), by Simpson's rule.
double scaledArrival(double z) {
  constexpr int intervals = 200;
  const double h = z / intervals;
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double slowness = 1.0 / (ambientSoundSpeed * std::sqrt(1.0 + 6.0 / 7.0 * peakRatio(h * i)));
    sum += slowness * (i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return sum * h / 3.0;
}

std::vector<double> planes(double from, double to, double spacing) {
  std::vector<double> result;
  const auto cells = static_cast<std::size_t>(std::ceil((to - from) / spacing * (1.0 - 1e-9)));
  for (std::size_t i = 0; i <= cells; ++i) {
    result.push_back(from + spacing * static_cast<double>(i));
  }
  return result;
}

}  // namespace

BlastWave blastWave(double tntKilograms, double metres) {
  LORICA_CHECK(tntKilograms > 0.0 && metres > 0.0, "a charge and a distance");
  const double scale = std::cbrt(tntKilograms);
  const double z = metres / scale;
  return {scale * scaledArrival(z), ambientPressure * peakRatio(z), scale * scaledDuration(z)};
}

double overpressure(const BlastWave& wave, double seconds) {
  const double phase = (seconds - wave.arrival) / wave.duration;
  return phase < 0.0 ? 0.0 : wave.peak * (1.0 - phase) * std::exp(-phase);
}

ThreatField blastField(const BlastOptions& options, base::Threads threads) {
  LORICA_CHECK(options.tntKilograms > 0.0 && options.spacing > 0.0 && options.steps >= 2 && !options.box.isEmpty(),
               "a charge, a lattice and times");
  ThreatField field;
  field.attributes = {{"pressure", "kPa"}};
  field.timed = true;
  Lattice& lattice = field.lattice.emplace();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    lattice.axes.at(axis) = planes(options.box.min()[a], options.box.max()[a], options.spacing);
  }
  constexpr double nearest = 0.05;
  std::vector<BlastWave> waves(lattice.points());
  base::parallelFor(waves.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      waves[p] = blastWave(options.tntKilograms, std::max(nearest, Vec3d(lattice.place(p) - options.position).norm()));
    }
  });
  const auto [first, last] = std::minmax_element(
      waves.begin(), waves.end(), [](const BlastWave& a, const BlastWave& b) { return a.arrival < b.arrival; });
  const double end = last->arrival + last->duration;
  field.steps.resize(options.steps);
  base::parallelFor(options.steps, 1, threads, [&](std::size_t from, std::size_t to) {
    for (std::size_t s = from; s < to; ++s) {
      Step& step = field.steps[s];
      step.time =
          first->arrival + (end - first->arrival) * static_cast<double>(s) / static_cast<double>(options.steps - 1);
      step.values.emplace_back(waves.size());
      for (std::size_t p = 0; p < waves.size(); ++p) {
        step.values.front()[p] = static_cast<float>(1e-3 * overpressure(waves[p], step.time));
      }
    }
  });
  return field;
}

}  // namespace lorica::threat
