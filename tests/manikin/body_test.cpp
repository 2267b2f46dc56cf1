#include "lorica/manikin/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "lorica/base/error.h"
#include "lorica/base/table.h"
#include "lorica/geometry/intersections.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/geometry/winding.h"
#include "mesh_tape.h"

namespace lorica::manikin {
namespace {

using geometry::Vec3d;
using human::Person;
using human::Sex;

const Body& bodyOf(const Person& person) {
  static std::map<std::pair<double, double>, Body> known;
  const auto key = std::make_pair(person.stature * (person.sex == Sex::male ? 1.0 : -1.0), person.mass);
  auto found = known.find(key);
  if (found == known.end()) {
    found = known.emplace(key, makeBody(person, {})).first;
  }
  return found->second;
}

/// The survey's value in metres or kilograms, read from the table's file.
double survey(Sex sex, const std::string& dimension, double percentile) {
  static const base::Table table = [] {
    std::ifstream file(LORICA_SOURCE_DIR "/resources/tables/anthropometry.csv");
    std::stringstream text;
    text << file.rdbuf();
    return base::Table(text.str(), "anthropometry.csv");
  }();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "dimension") == dimension && table.text(row, "sex") == (sex == Sex::male ? "male" : "female")) {
      const double value = table.number(row, percentile < 50.0 ? "p5" : (percentile > 50.0 ? "p95" : "p50"));
      return table.text(row, "unit") == "mm" ? 1e-3 * value : value;
    }
  }
  ADD_FAILURE() << dimension;
  return 1.0;
}

struct Case {
  Sex sex;
  double percentile;
};

class BodyOfPercentile : public testing::TestWithParam<Case> {
 protected:
  Sex sex() const { return GetParam().sex; }
  double of(const std::string& dimension) const { return survey(sex(), dimension, GetParam().percentile); }
  Person person() const { return {sex(), of("stature"), of("weightkg")}; }
  const Body& body() const { return bodyOf(person()); }
  Vec3d joint(const std::string& name) const {
    const auto found = body().skeleton.find(name);
    EXPECT_TRUE(found) << name;
    return body().skeleton.restPosition(*found);
  }
  double tolerance() const { return GetParam().percentile == 50.0 ? 0.03 : 0.06; }
  void expectNear(double measured, const std::string& dimension) const {
    EXPECT_NEAR(measured / of(dimension), 1.0, tolerance()) << dimension << " measured " << 1e3 * measured << " mm";
  }
  test::Reading level(const std::string& height) const {
    return test::tapeAt(body().skin, Vec3d(0.0, of(height), 0.0), Vec3d::UnitY());
  }

  void isAsTallAsThePerson() const;
  void weighsWhatThePersonWeighs() const;
  void hasTheSurveysTrunk() const;
  void hasTheSurveysLimbsNeckAndHead() const;
  void isOneClosedManifoldOfEvenTriangles() const;
  void holdsItsJoints() const;
};

void BodyOfPercentile::isAsTallAsThePerson() const {
  const auto box = geometry::bounds(body().skin.positions);
  EXPECT_NEAR(box.max().y(), of("stature"), 0.002);
  EXPECT_NEAR(box.min().y(), 0.0, 0.001);
}

void BodyOfPercentile::weighsWhatThePersonWeighs() const {
  // ICRP 89: 1.051 and 1.034 g/cm3 without the lungs' air, of which the reference lungs hold 2.0 and 1.56 l.
  const bool male = sex() == Sex::male;
  const double air = (male ? 2.00e-3 : 1.56e-3) * std::pow(of("stature") / (male ? 1.76 : 1.63), 3.0);
  const double mass = (geometry::signedVolume(body().skin) - air) * (male ? 1051.0 : 1034.0);
  EXPECT_NEAR(mass / of("weightkg"), 1.0, 0.03);
}

void BodyOfPercentile::hasTheSurveysTrunk() const {
  const test::Reading chest = level("chestheight");
  expectNear(chest.girth, "chestcircumference");
  expectNear(chest.breadth, "chestbreadth");
  expectNear(chest.depth, "chestdepth");
  const test::Reading waist = level("waistheightomphalion");
  expectNear(waist.girth, "waistcircumference");
  const test::Reading hip = level("buttockheight");
  expectNear(hip.girth, "buttockcircumference");
  expectNear(hip.breadth, "hipbreadth");
  expectNear(hip.depth, "buttockdepth");
}

void BodyOfPercentile::hasTheSurveysLimbsNeckAndHead() const {
  // The thigh is taped under the buttock, where the legs have just parted.
  double thigh = 0.0;
  double calf = 0.0;
  const double crotch = of("crotchheight");
  const Vec3d knee = joint("knee_L");
  const Vec3d ankle = joint("ankle_L");
  const double under = crotch - 0.0256 * of("stature");
  const Vec3d hip = joint("hip_L");
  const Vec3d thighPlace = hip + (hip.y() - under) / (hip.y() - knee.y()) * (knee - hip);
  thigh = test::tapeAt(body().skin, {thighPlace.x(), under, 0.0}, Vec3d::UnitY()).girth;
  for (int i = 0; i <= 20; ++i) {
    const Vec3d place = knee + (0.15 + 0.02 * i) * (ankle - knee);
    calf = std::max(calf, test::tapeAt(body().skin, place, Vec3d::UnitY()).girth);
  }
  expectNear(thigh, "thighcircumference");
  expectNear(calf, "calfcircumference");

  const Vec3d shoulder = joint("glenohumeral_L");
  const Vec3d elbow = joint("elbow_L");
  double biceps = 0.0;
  for (int i = 0; i <= 8; ++i) {
    const Vec3d place = shoulder + (0.46 + 0.02 * i) * (elbow - shoulder);
    biceps = std::max(biceps, test::tapeAt(body().skin, place, elbow - shoulder, Vec3d::UnitZ()).girth);
  }
  expectNear(biceps, "bicepscircumferenceflexed");

  const Vec3d low = joint("spine_C7T1");
  const Vec3d high = joint("head_C0C1");
  const Vec3d throat = low + 0.45 * (high - low) + Vec3d(0.0, 0.0, 0.012);
  expectNear(test::tapeAt(body().skin, throat, high - low).girth, "neckcircumference");

  double head = 0.0;
  const double eye = joint("eye_L").y();
  for (int i = 0; i <= 10; ++i) {
    const double y = eye + (0.20 + 0.02 * i) * (of("stature") - eye);
    head = std::max(head, test::tapeAt(body().skin, {0.0, y, 0.0}, Vec3d::UnitY()).girth);
  }
  expectNear(head, "headcircumference");
}

void BodyOfPercentile::isOneClosedManifoldOfEvenTriangles() const {
  const auto& skin = body().skin;
  const geometry::MeshAudit audit = geometry::audit(skin);
  EXPECT_EQ(audit.components.size(), 1u);
  EXPECT_TRUE(audit.closed());
  EXPECT_EQ(audit.oddEdges, 0u);
  EXPECT_EQ(audit.degenerateTriangles, 0u);
  EXPECT_GT(geometry::signedVolume(skin), 0.0);
  EXPECT_TRUE(geometry::selfIntersections(skin, {}).empty());
  // Euler characteristic 2: no arm is fused to the trunk, no finger to another, no thigh to the other.
  const auto vertices = static_cast<long>(skin.positions.size());
  const auto faces = static_cast<long>(skin.triangles.size());
  EXPECT_EQ(vertices - 3 * faces / 2 + faces, 2);
  EXPECT_GE(faces, 20000);
  EXPECT_LE(faces, 60000);
  long slivers = 0;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    double smallest = 180.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3d u = skin.corner(t, (k + 1) % 3) - skin.corner(t, k);
      const Vec3d v = skin.corner(t, (k + 2) % 3) - skin.corner(t, k);
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi);
    }
    slivers += smallest < 20.0 ? 1 : 0;
  }
  EXPECT_LT(slivers, faces / 1000);
}

void BodyOfPercentile::holdsItsJoints() const {
  EXPECT_EQ(body().skeleton.size(), 55u);
  for (std::size_t j = 0; j < body().skeleton.size(); ++j) {
    const human::JointIndex index{j};
    EXPECT_NEAR(geometry::windingNumber(body().skin, body().skeleton.restPosition(index)), 1.0, 1e-6)
        << body().skeleton.joint(index).name;
  }
}

// One test for all of it: a body takes seconds to make.
TEST_P(BodyOfPercentile, MeasuresUp) {
  isAsTallAsThePerson();
  weighsWhatThePersonWeighs();
  hasTheSurveysTrunk();
  hasTheSurveysLimbsNeckAndHead();
  isOneClosedManifoldOfEvenTriangles();
  holdsItsJoints();
}

INSTANTIATE_TEST_SUITE_P(Adults, BodyOfPercentile,
                         testing::Values(Case{Sex::male, 50.0}, Case{Sex::female, 50.0}, Case{Sex::male, 5.0},
                                         Case{Sex::female, 5.0}, Case{Sex::male, 95.0}, Case{Sex::female, 95.0}),
                         [](const auto& chosen) {
                           return (chosen.param.sex == Sex::male ? "Man" : "Woman") +
                                  std::to_string(static_cast<int>(chosen.param.percentile));
                         });

TEST(Body, FacesForwardAndIsTheSameOnBothSides) {
  const Body& body = bodyOf({});
  const auto box = geometry::bounds(body.skin.positions);
  EXPECT_NEAR(box.max().x(), -box.min().x(), 5e-4);
  const auto at = [&](const char* name) { return body.skeleton.restPosition(*body.skeleton.find(name)); };
  EXPECT_GT(at("toe_MTP_L").z(), at("ankle_L").z() + 0.05);
  EXPECT_GT(at("eye_L").z(), at("head_C0C1").z() + 0.03);
  for (const char* name : {"eye", "glenohumeral", "wrist", "thumb_CMC", "little_PIP", "hip", "toe_MTP"}) {
    const Vec3d left = at((std::string(name) + "_L").c_str());
    EXPECT_GT(left.x(), 0.0) << name;
    EXPECT_TRUE(at((std::string(name) + "_R").c_str()).isApprox(left.cwiseProduct(Vec3d(-1.0, 1.0, 1.0)), 1e-12));
  }
}

TEST(Body, IsTheSameBytesAtAnyNumberOfThreads) {
  const Person person{Sex::female, 1.70, 62.0};
  const Body one = makeBody(person, {1});
  const Body three = makeBody(person, {3});
  EXPECT_TRUE(one.skin.positions == three.skin.positions);
  EXPECT_TRUE(one.skin.triangles == three.skin.triangles);
  EXPECT_TRUE(one.weights.joints == three.weights.joints);
  EXPECT_TRUE(one.weights.weights == three.weights.weights);
}

TEST(Body, WeightsSumToOneAndNothingOfOneLimbMovesWithAnother) {
  const Body& body = bodyOf({});
  const auto limbOf = [&](std::uint32_t joint) {
    const std::string& name = body.skeleton.joints()[joint].name;
    for (const char* part :
         {"glenohumeral", "elbow", "radioulnar", "wrist", "thumb", "index", "middle", "ring", "little"}) {
      if (name.find(part) == 0) {
        return std::string("arm") + name.back();
      }
    }
    for (const char* part : {"hip", "knee", "ankle", "subtalar", "toe"}) {
      if (name.find(part) == 0) {
        return std::string("leg") + name.back();
      }
    }
    return std::string("trunk");
  };
  EXPECT_LE(body.weights.influences, 4u);
  std::map<std::string, std::size_t> counts;
  for (std::size_t v = 0; v < body.skin.positions.size(); ++v) {
    double sum = 0.0;
    std::string limb = "trunk";
    for (std::size_t k = 0; k < body.weights.influences; ++k) {
      const std::size_t i = v * body.weights.influences + k;
      if (body.weights.weights[i] <= 0.0F) {
        continue;
      }
      sum += static_cast<double>(body.weights.weights[i]);
      const std::string one = limbOf(body.weights.joints[i]);
      EXPECT_TRUE(one == "trunk" || limb == "trunk" || one == limb) << v << ' ' << one << ' ' << limb;
      limb = one == "trunk" ? limb : one;
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    ++counts[limb];
    // The hand below the other side's hip would betray a limb that crosses over.
    if (limb.back() == 'L') {
      EXPECT_GT(body.skin.positions[v].x(), 0.0F) << limb;
    } else if (limb.back() == 'R') {
      EXPECT_LT(body.skin.positions[v].x(), 0.0F) << limb;
    }
  }
  EXPECT_EQ(counts.size(), 5u);
}

TEST(Body, OfEveryJointMovesSomethingButTheEyes) {
  const Body& body = bodyOf({});
  std::vector<bool> moves(body.skeleton.size(), false);
  for (std::size_t i = 0; i < body.weights.joints.size(); ++i) {
    if (body.weights.weights[i] > 0.1F) {
      moves[body.weights.joints[i]] = true;
    }
  }
  for (std::size_t j = 0; j < moves.size(); ++j) {
    const std::string& name = body.skeleton.joints()[j].name;
    if (name.find("eye") == std::string::npos && name != "jaw") {
      EXPECT_TRUE(moves[j]) << name;
    }
  }
}

TEST(Person, AtAPercentileHasTheSurveysSize) {
  for (const Sex sex : {Sex::male, Sex::female}) {
    for (const double percentile : {5.0, 50.0, 95.0}) {
      const Person person = personAtPercentile(sex, percentile);
      EXPECT_NEAR(person.stature, survey(sex, "stature", percentile), 1e-6);
      EXPECT_NEAR(person.mass, survey(sex, "weightkg", percentile), 1e-6);
    }
    EXPECT_LT(personAtPercentile(sex, 40.0).stature, personAtPercentile(sex, 60.0).stature);
  }
}

TEST(Person, OutsideTheLimitsIsNamed) {
  const auto complaint = [](const Person& person) {
    try {
      checkPerson(person);
    } catch (const base::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint({Sex::male, 1.755, 84.6}), "");
  EXPECT_NE(complaint({Sex::male, 17.55, 84.6}).find("stature"), std::string::npos);
  EXPECT_NE(complaint({Sex::female, 1.60, 20.0}).find("mass"), std::string::npos);
  EXPECT_NE(complaint({Sex::female, 1.60, 20.0}).find("expected 44 to 115 kg for a woman of 1.60 m, found 20 kg"),
            std::string::npos);
  // The tall need more than the short of the same mass index.
  EXPECT_EQ(complaint({Sex::male, 1.60, 19.0 * 1.60 * 1.60}), "");
  EXPECT_NE(complaint({Sex::male, 1.95, 19.0 * 1.95 * 1.95}).find("mass"), std::string::npos);
  EXPECT_NE(complaint({Sex::female, std::nan(""), 60.0}).find("stature"), std::string::npos);
  EXPECT_NE(complaint({Sex::female, 1.6, std::nan("")}).find("mass"), std::string::npos);
}

}  // namespace
}  // namespace lorica::manikin
