#include "lorica/manikin/body_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"
#include "mesh_tape.h"

namespace lorica::manikin {
namespace {

using geometry::Vec3d;
using human::Sex;

std::map<std::string, BodyMeasure> measuresOf(const Body& body) {
  std::map<std::string, BodyMeasure> byName;
  for (BodyMeasure& measure : measureBody(body)) {
    byName.emplace(measure.name, std::move(measure));
  }
  return byName;
}

const Body& woman() {
  static const Body body = makeBody(personAtPercentile(Sex::female, 50.0), {});
  return body;
}

TEST(BodyMeasures, HaveEveryDimensionOnceWithTargetAndSource) {
  const std::vector<BodyMeasure> all = measureBody(woman());
  const auto byName = measuresOf(woman());
  EXPECT_EQ(all.size(), byName.size());
  for (const char* name :
       {"stature", "head_girth", "neck_girth", "chest_girth", "chest_breadth", "chest_depth", "waist_girth",
        "hip_girth", "hip_breadth", "hip_depth", "thigh_girth", "calf_girth", "upper_arm_girth"}) {
    ASSERT_TRUE(byName.contains(name)) << name;
    const BodyMeasure& measure = byName.at(name);
    EXPECT_NEAR(measure.value / measure.target, 1.0, name == std::string("stature") ? 0.0013 : 0.03) << name;
    EXPECT_NE(measure.source.find("ANSUR"), std::string::npos);
  }
}

TEST(BodyMeasures, TargetsOfTheMedianAreTheSurveysMedians) {
  // Rows of resources/tables/anthropometry.csv.
  const auto byName = measuresOf(woman());
  EXPECT_NEAR(byName.at("stature").target, 1.626, 1e-9);
  EXPECT_EQ(byName.at("chest_girth").dimension, "chestcircumference");
  EXPECT_EQ(byName.at("upper_arm_girth").dimension, "bicepscircumferenceflexed");
}

TEST(BodyMeasures, ReadWhatAnotherTapeReads) {
  const auto byName = measuresOf(woman());
  const auto joint = [&](const char* name) { return woman().skeleton.restPosition(*woman().skeleton.find(name)); };
  const Vec3d low = joint("spine_C7T1");
  const Vec3d high = joint("head_C0C1");
  const test::Reading neck = test::tapeAt(woman().skin, low + 0.45 * (high - low) + Vec3d(0.0, 0.0, 0.012), high - low);
  EXPECT_NEAR(byName.at("neck_girth").value, neck.girth, 1e-9);
  // A level section through the chest falls into the trunk and two arms; only the trunk is read.
  double broadest = 0.0;
  for (double y = 0.70 * 1.626; y < 0.76 * 1.626; y += 0.002) {
    broadest = std::max(broadest, test::tapeAt(woman().skin, {0.0, y, 0.0}, Vec3d::UnitY()).breadth);
  }
  EXPECT_LE(byName.at("chest_breadth").value, broadest);
  EXPECT_LT(byName.at("chest_breadth").value, 0.5 * geometry::bounds(woman().skin.positions).sizes().x());
}

TEST(BodyMeasures, GrowWithTheBody) {
  // A body blown up by a tenth has girths that are longer by a tenth at places that lie as much higher; the places
  // are the person's, so the person grows with it.
  Body large = woman();
  for (geometry::Vec3f& p : large.skin.positions) {
    p = geometry::Vec3f(1.1F * p.x(), p.y(), 1.1F * p.z());
  }
  const auto before = measuresOf(woman());
  const auto after = measuresOf(large);
  for (const char* name : {"chest_girth", "chest_breadth", "chest_depth", "waist_girth", "hip_girth", "hip_breadth"}) {
    EXPECT_NEAR(after.at(name).value / before.at(name).value, 1.1, 1e-5) << name;
  }
  EXPECT_EQ(after.at("stature").value, before.at("stature").value);
}

TEST(BodyMeasures, MassIsThatOfTheVolumeWithoutTheAirOfTheLungs) {
  Body ball = woman();
  ball.skin = geometry::ellipsoid({0.0, 1.0, 0.0}, {0.2, 0.9, 0.1}, 5);
  const double volume = geometry::signedVolume(ball.skin);
  EXPECT_NEAR(measuredMass(ball), (volume - lungAir(ball.person)) * 1034.0, 1e-9);
  // ICRP 89: 1.56 l of the reference woman of 1.63 m, with the cube of stature.
  EXPECT_NEAR(lungAir({Sex::female, 1.63, 60.0}), 1.56e-3, 1e-5);
  EXPECT_NEAR(lungAir({Sex::female, 2.0 * 1.63, 60.0}), 8.0 * 1.56e-3, 1e-4);
  EXPECT_NEAR(measuredMass(woman()) / woman().person.mass, 1.0, 0.03);
}

}  // namespace
}  // namespace lorica::manikin
