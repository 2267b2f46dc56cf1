#include "colour_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lorica::viewport {
namespace {

using document::Colouring;

/// CIE lightness of an sRGB colour, 0 to 100.
double lightness(const QColor& colour) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(ColourScale, DepthDarkensEvenly) {
  const ColourScale scale{Colouring::protrusion, 0.02};
  double last = lightness(scale.at(1e-9));
  const double step = (last - lightness(scale.at(0.02))) / 20.0;
  EXPECT_GT(step, 3.0) << "from light to dark";
  for (int i = 1; i <= 20; ++i) {
    const double now = lightness(scale.at(0.001 * i));
    EXPECT_NEAR(last - now, step, 0.6 * step) << i;
    last = now;
  }
}

TEST(ColourScale, StrainIsLightWhereThereIsNoneAndEquallyDarkToBothSides) {
  const ColourScale scale{Colouring::strain, 0.5};
  for (int i = 1; i <= 10; ++i) {
    const double stretched = lightness(scale.at(0.05 * i));
    const double squeezed = lightness(scale.at(-0.05 * i));
    EXPECT_NEAR(stretched, squeezed, 5.0) << i;
    EXPECT_LT(stretched, lightness(scale.at(0.05 * (i - 1))));
  }
  EXPECT_GT(scale.at(0.4).red(), scale.at(0.4).blue());
  EXPECT_LT(scale.at(-0.4).red(), scale.at(-0.4).blue());
  EXPECT_LT(scale.at(0.0).hsvSaturationF(), 0.05F);
}

TEST(ColourScale, WhatIsInsideIsGreyAndWhatIsBeyondTheEndIsAsTheEnd) {
  const ColourScale scale{Colouring::protrusion, 0.02};
  EXPECT_EQ(scale.at(0.0).hsvSaturation(), 0);
  EXPECT_EQ(scale.at(5.0), scale.at(0.02));
  const ColourScale strain{Colouring::strain, 0.5};
  EXPECT_EQ(strain.at(-9.0), strain.at(-0.5));
}

TEST(ColourScale, EndsAtARoundNumberBeyondAllButOneInAHundred) {
  std::vector<float> values(1000, 0.013F);
  values[3] = 7.0F;  // one bad triangle
  const std::vector<std::span<const float>> all{values};
  EXPECT_DOUBLE_EQ(scaleFor(Colouring::protrusion, all).end, 0.015);
  values.assign(1000, -0.2F);
  EXPECT_DOUBLE_EQ(scaleFor(Colouring::strain, all).end, 0.2) << "a round number stands for itself";
}

TEST(ColourScale, OfNextToNothingDoesNotMakeItLookLarge) {
  const std::vector<float> values{0.0F, 1e-5F};
  const std::vector<std::span<const float>> all{values};
  EXPECT_DOUBLE_EQ(scaleFor(Colouring::protrusion, all).end, 0.001);
  EXPECT_DOUBLE_EQ(scaleFor(Colouring::strain, all).end, 0.05);
  EXPECT_DOUBLE_EQ(scaleFor(Colouring::strain, {}).end, 0.05);
}

}  // namespace
}  // namespace lorica::viewport
