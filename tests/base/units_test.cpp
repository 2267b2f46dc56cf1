#include "lorica/base/units.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <compare>
#include <type_traits>

#include "lorica/base/index.h"

namespace lorica::base {
namespace {

constexpr LengthUnit allUnits[] = {LengthUnit::metre, LengthUnit::centimetre, LengthUnit::millimetre, LengthUnit::inch};

TEST(LengthUnit, IsFoundByItsName) {
  for (const LengthUnit unit : allUnits) {
    EXPECT_EQ(lengthUnitNamed(name(unit)), unit);
  }
}

TEST(LengthUnit, HasTheNamesOfTheFileFormats) {
  EXPECT_EQ(lengthUnitNamed("m"), LengthUnit::metre);
  EXPECT_EQ(lengthUnitNamed("cm"), LengthUnit::centimetre);
  EXPECT_EQ(lengthUnitNamed("mm"), LengthUnit::millimetre);
  EXPECT_EQ(lengthUnitNamed("in"), LengthUnit::inch);
}

TEST(LengthUnit, IsNotFoundByAnyOtherName) {
  for (const char* wanted : {"", "M", "metre", " m", "m ", "inch", "ft"}) {
    EXPECT_FALSE(lengthUnitNamed(wanted)) << wanted;
  }
}

TEST(LengthUnit, HasItsDefinedLength) {
  EXPECT_DOUBLE_EQ(metresPer(LengthUnit::metre), 1.0);
  EXPECT_DOUBLE_EQ(100.0 * metresPer(LengthUnit::centimetre), 1.0);
  EXPECT_DOUBLE_EQ(1000.0 * metresPer(LengthUnit::millimetre), 1.0);
  EXPECT_DOUBLE_EQ(metresPer(LengthUnit::inch) / metresPer(LengthUnit::millimetre), 25.4);
}

TEST(Angles, HaveKnownValues) {
  EXPECT_DOUBLE_EQ(radians(180.0), std::acos(-1.0));
  EXPECT_DOUBLE_EQ(std::sin(radians(30.0)), 0.5);
  EXPECT_DOUBLE_EQ(degrees(std::atan2(1.0, 1.0)), 45.0);
}

RC_GTEST_PROP(Angles, GoRoundTrip, ()) {
  const double angle = *rc::gen::inRange(-720000, 720001) / 1000.0;
  RC_ASSERT(std::abs(degrees(radians(angle)) - angle) <= 1e-12 * (1.0 + std::abs(angle)));
}

TEST(Index, OfOneThingIsNotTheIndexOfAnother) {
  using Apple = Index<struct AppleTag>;
  using Pear = Index<struct PearTag>;
  static_assert(!std::is_convertible_v<Apple, Pear> && !std::is_convertible_v<std::size_t, Apple>);
  static_assert(!std::is_convertible_v<Apple, std::size_t>);
  static_assert(!std::three_way_comparable_with<Apple, Pear>);
  EXPECT_LT(Apple(2U), Apple(3U));
  EXPECT_EQ(Apple(3U), Apple(3U));
}

}  // namespace
}  // namespace lorica::base
