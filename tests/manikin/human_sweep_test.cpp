#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "armor_checks.h"
#include "lorica/geometry/intersections.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/manikin/body.h"
#include "lorica/manikin/body_measures.h"
#include "organ_checks.h"

namespace lorica::manikin {
namespace {

using human::Person;
using human::Sex;

struct Size {
  Sex sex;
  double stature;
  double bmi;  ///< 0 for the least that is accepted

  Person person() const {
    const double least = PersonLimits{}.leastBmi(sex, stature);
    return {sex, stature, (bmi > 0.0 ? bmi : least) * stature * stature};
  }
};

double measured(const std::vector<BodyMeasure>& measures, const std::string& name) {
  for (const BodyMeasure& measure : measures) {
    if (measure.name == name) {
      return measure.value / measure.target;
    }
  }
  ADD_FAILURE() << name;
  return 0.0;
}

void expectSoundBody(const Body& body) {
  const Person& person = body.person;
  const geometry::MeshAudit audit = geometry::audit(body.skin);
  EXPECT_EQ(audit.components.size(), 1u);
  EXPECT_TRUE(audit.closed());
  EXPECT_EQ(audit.oddEdges, 0u);
  EXPECT_EQ(audit.degenerateTriangles, 0u);
  EXPECT_TRUE(geometry::selfIntersections(body.skin, {}).empty());
  // Euler characteristic 2: no limb is fused to another part.
  EXPECT_EQ(static_cast<long>(body.skin.positions.size()) - static_cast<long>(body.skin.triangles.size()) / 2, 2);
  EXPECT_NEAR(geometry::bounds(body.skin.positions).max().y(), person.stature, 0.002);
  EXPECT_NEAR(measuredMass(body) / person.mass, 1.0, 0.03);
  const std::vector<BodyMeasure> measures = measureBody(body);
  // A chest that an arm is fused to is half as broad again.
  EXPECT_NEAR(measured(measures, "chest_girth"), 1.0, 0.06);
  EXPECT_NEAR(measured(measures, "chest_breadth"), 1.0, 0.07);
  EXPECT_NEAR(measured(measures, "upper_arm_girth"), 1.0, 0.06);
  std::cout << fmt::format("{:5} {:.2f} m {:5.1f} kg: mass {:+.2f} %, chest girth {:+.1f} %, breadth {:+.1f} %\n",
                           person.sex == Sex::male ? "man" : "woman", person.stature, person.mass,
                           100.0 * (measuredMass(body) / person.mass - 1.0),
                           100.0 * (measured(measures, "chest_girth") - 1.0),
                           100.0 * (measured(measures, "chest_breadth") - 1.0));
}

class HumanOfAnySize : public testing::TestWithParam<Size> {};

// One test for all, as a body takes seconds to make.
TEST_P(HumanOfAnySize, HasASoundBodyWithItsOrgansInsideAndItsArmorAround) {
  const test::Dressed who(makeBody(GetParam().person(), {}));
  expectSoundBody(who.body);
  test::expectWellDressed(who);
  test::expectSoundOrgans(who.body, organsOf(who.body));
}

INSTANTIATE_TEST_SUITE_P(Persons, HumanOfAnySize,
                         testing::Values(Size{Sex::male, 1.45, 0.0}, Size{Sex::male, 1.45, 44.9},
                                         Size{Sex::male, 1.75, 0.0}, Size{Sex::male, 1.75, 33.0},
                                         Size{Sex::male, 1.98, 35.7}, Size{Sex::male, 2.05, 0.0},
                                         Size{Sex::male, 2.05, 44.9}, Size{Sex::female, 1.45, 0.0},
                                         Size{Sex::female, 1.45, 44.9}, Size{Sex::female, 1.65, 17.6},
                                         Size{Sex::female, 1.75, 33.0}, Size{Sex::female, 2.05, 0.0},
                                         Size{Sex::female, 2.05, 44.9}));

}  // namespace
}  // namespace lorica::manikin
