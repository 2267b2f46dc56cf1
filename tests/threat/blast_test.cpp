#include "lorica/threat/blast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "lorica/threat/surface_values.h"
#include "real_data.h"

namespace lorica::threat {
namespace {

using geometry::Vec3d;

TEST(Blast, ScalesWithTheCubeRootOfTheCharge) {
  const BlastWave one = blastWave(1.0, 3.0);
  const BlastWave eight = blastWave(8.0, 6.0);
  EXPECT_NEAR(eight.peak, one.peak, 1e-9 * one.peak);
  EXPECT_NEAR(eight.duration, 2.0 * one.duration, 1e-12);
  EXPECT_NEAR(eight.arrival, 2.0 * one.arrival, 1e-12);
}

TEST(Blast, IsNearTheIdealPointSource) {
  // The table: an ideal point source of energy E, by finite differences; ranges in (E/P0)^(1/3). TNT gives 4.52 MJ/kg
  // (Kinney and Graham). A real charge is no point, which shows near it.
  LORICA_NEEDS_REAL_DATA("tables/point_source_spherical_g1.4_shock_table.csv");
  std::ifstream table(test::realData() / "tables/point_source_spherical_g1.4_shock_table.csv");
  const double scale = std::cbrt(4.52e6 / ambientPressure);
  std::string line;
  std::getline(table, line);
  int compared = 0;
  while (std::getline(table, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    double x = 0.0;
    double y = 0.0;
    double slope = 0.0;
    double z = 0.0;
    fields >> x >> y >> slope >> z;
    const double metres = std::exp(x) * scale;
    if (metres < 3.5 || metres > 12.0) {
      continue;
    }
    const BlastWave wave = blastWave(1.0, metres);
    EXPECT_NEAR(wave.peak / ambientPressure / std::exp(y), 1.0, 0.2) << metres << " m";
    EXPECT_NEAR(wave.arrival / ((std::exp(x) - std::exp(z)) * scale / ambientSoundSpeed), 1.0, 0.1) << metres << " m";
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST(Blast, ImpulseOfThePositivePhaseIsPeakTimesDurationOverE) {
  const BlastWave wave = blastWave(5.0, 4.0);
  double impulse = 0.0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    impulse += overpressure(wave, wave.arrival + wave.duration * (i + 0.5) / steps) * wave.duration / steps;
  }
  EXPECT_NEAR(impulse, wave.peak * wave.duration / std::exp(1.0), 1e-6 * impulse);
  EXPECT_EQ(overpressure(wave, 0.999 * wave.arrival), 0.0);
  EXPECT_DOUBLE_EQ(overpressure(wave, wave.arrival), wave.peak);
  EXPECT_LT(overpressure(wave, wave.arrival + 1.5 * wave.duration), 0.0);
}

TEST(Blast, FieldHasTheFormulasValuesAtItsPoints) {
  BlastOptions options;
  options.tntKilograms = 2.0;
  options.position = {0.0, 1.0, 3.0};
  options.spacing = 0.3;
  options.steps = 7;
  const ThreatField field = blastField(options);
  EXPECT_TRUE(field.bounds().contains(options.box));
  ASSERT_EQ(field.steps.size(), 7U);
  double earliest = 1.0;
  for (std::size_t p = 0; p < field.points(0); ++p) {
    const BlastWave wave = blastWave(2.0, (field.place(0, p) - options.position).norm());
    earliest = std::min(earliest, wave.arrival);
    for (const Step& step : field.steps) {
      EXPECT_NEAR(static_cast<double>(step.values[0][p]), 1e-3 * overpressure(wave, step.time), 1e-4);
    }
  }
  EXPECT_DOUBLE_EQ(field.steps[0].time, earliest);
}

TEST(Blast, ImpulseOnTheFieldIsNearThatOfTheWave) {
  BlastOptions options;
  options.tntKilograms = 5.0;
  options.position = {0.0, 1.1, 4.0};
  const FieldSampler sampler(std::make_shared<const ThreatField>(blastField(options)));
  const Vec3d chest(0.02, 1.25, 0.11);
  const Exposure seen = exposure(sampler, 0, geometry::Positions{chest.cast<float>()});
  const BlastWave wave = blastWave(5.0, (chest - options.position).norm());
  const double whole = 1e-3 * wave.peak * wave.duration / std::exp(1.0);
  EXPECT_NEAR(static_cast<double>(seen.integral[0]), whole, 0.02 * whole);
  EXPECT_LT(static_cast<double>(seen.peak[0]), 1e-3 * wave.peak);
  EXPECT_GT(static_cast<double>(seen.peak[0]), 0.88e-3 * wave.peak) << "smeared over a cell and a step";
  EXPECT_NEAR(seen.peakTime[0], wave.arrival, 1e-3);
}

}  // namespace
}  // namespace lorica::threat
