#include "lorica/manikin/organs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "lorica/base/error.h"
#include "lorica/base/table.h"
#include "lorica/geometry/closest_point.h"
#include "lorica/geometry/measures.h"
#include "lorica/manikin/human.h"
#include "organ_checks.h"

namespace lorica::manikin {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;
using human::Person;
using human::Sex;

constexpr double kPound = 0.45359237;
constexpr double kInch = 0.0254;

base::Table tableFile(const std::string& name) {
  std::ifstream file(LORICA_SOURCE_DIR "/resources/tables/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return {text.str(), name};
}

// Sizes

TEST(HeartDiameter, IsThatOfUngerleiderAndClarkInMillimetres) {
  // 25 mm per pound and inch plus 70 mm for men, 62 mm for women.
  for (double pounds = 120.0; pounds <= 270.0; pounds += 15.0) {
    for (double inches = 62.0; inches <= 78.0; inches += 2.0) {
      if (pounds / inches < 1.7 || pounds / inches > 3.8) {
        continue;  // outside the rule's table
      }
      const Person man{Sex::male, inches * kInch, pounds * kPound};
      const Person woman{Sex::female, inches * kInch, pounds * kPound};
      const double rule = 1e-3 * (25.0 * pounds / inches + 70.0);
      EXPECT_GT(heartTransverseDiameter(man) / rule, 1.0 - 0.015) << pounds << " lb " << inches << " in";
      EXPECT_LT(heartTransverseDiameter(man) / rule, 1.0 + 0.025) << pounds << " lb " << inches << " in";
      EXPECT_NEAR(heartTransverseDiameter(woman), rule - 0.008, 0.028 * rule);
    }
  }
  // 170 lb and 70 in: the centimetre reading gives 133.7 mm, the rule 130.7 mm; inches would give 340 mm.
  EXPECT_NEAR(heartTransverseDiameter({Sex::male, 70 * kInch, 170 * kPound}), 0.1337, 0.0001);
}

TEST(LungWidth, ReadsTheFormulaInTheUnitAskedForAndStaysInTheChest) {
  const Person man{Sex::male, 69 * kInch, 175 * kPound};
  EXPECT_NEAR(lungWidth(man, LungFormulaUnit::inches, 1.0), 0.304, 0.001);
  EXPECT_NEAR(lungWidth(man, LungFormulaUnit::centimetres, 1.0), 0.329, 0.001);
  EXPECT_EQ(lungWidth(man, LungFormulaUnit::inches, 0.25), 0.25);
}

TEST(OrganTargets, OfTheReferenceAdultsAreThoseOfIcrp89) {
  const base::Table table = tableFile("organs.csv");
  for (const Sex sex : {Sex::male, Sex::female}) {
    const Person adult = sex == Sex::male ? Person{sex, 1.76, 73.0} : Person{sex, 1.63, 60.0};
    std::map<std::string, double> volumes;
    std::map<std::string, double> masses;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (table.text(row, "sex") == (sex == Sex::male ? "male" : "female")) {
        const double grams = table.number(row, "count") * table.number(row, "mass_g");
        masses[table.text(row, "structure")] += 1e-3 * grams;
        volumes[table.text(row, "structure")] += 1e-6 * grams / table.number(row, "density_g_cm3");
      }
    }
    EXPECT_EQ(volumes.size(), 16U);  // windpipe, arteries and veins have none
    for (const OrganScaling scaling : {OrganScaling::referenceMass, OrganScaling::thesis}) {
      OrganOptions options;
      options.scaling = scaling;
      for (const OrganTarget& target : organTargets(adult, options, 0.25)) {
        EXPECT_NEAR(target.volume, volumes[target.name], 1e-12) << target.name;
        EXPECT_NEAR(target.mass(), masses[target.name], 1e-9) << target.name;
        EXPECT_FALSE(target.source.empty()) << target.name;
      }
    }
  }
}

TEST(OrganTargets, GrowWithThePerson) {
  const std::vector<OrganTarget> small = organTargets({Sex::male, 1.65, 60.0}, {}, 0.25);
  const std::vector<OrganTarget> large = organTargets({Sex::male, 1.90, 100.0}, {}, 0.25);
  for (std::size_t i = 0; i < small.size(); ++i) {
    const std::string& name = small[i].name;
    if (name == "brain" || name == "eyes" || name == "bladder" || small[i].volume == 0.0) {
      EXPECT_EQ(small[i].volume, large[i].volume) << name;
    } else {
      EXPECT_LT(small[i].volume, large[i].volume) << name;
    }
  }
}

TEST(OrganTargets, OfTheThesisFollowHeartAndLungs) {
  OrganOptions options;
  options.scaling = OrganScaling::thesis;
  const Person adult{Sex::male, 1.76, 73.0};
  const Person heavy{Sex::male, 1.76, 95.0};
  const auto volume = [&](const Person& person, const std::string& name) {
    const std::vector<OrganTarget> targets = organTargets(person, options, 1.0);
    return std::find_if(targets.begin(), targets.end(), [&](const OrganTarget& t) { return t.name == name; })->volume;
  };
  const double heart = heartTransverseDiameter(heavy) / heartTransverseDiameter(adult);
  EXPECT_NEAR(volume(heavy, "heart") / volume(adult, "heart"), std::pow(heart, 3.0), 1e-9);
  const double lungs = std::pow(heart, 1.083);
  for (const char* name : {"lung_left", "lung_right", "liver", "spleen"}) {
    EXPECT_NEAR(volume(heavy, name) / volume(adult, name), std::pow(lungs, 3.0), 1e-9) << name;
  }
}

// Meshes

struct Made {
  Body body;
  std::vector<Organ> organs;

  const Organ& organ(const std::string& name) const {
    return *std::find_if(organs.begin(), organs.end(), [&](const Organ& o) { return o.name == name; });
  }
  Vec3d centre(const std::string& name) const { return geometry::centroid(organ(name).mesh); }
  geometry::Box3d box(const std::string& name) const { return geometry::bounds(organ(name).mesh.positions); }
  Vec3d joint(const std::string& name) const { return body.skeleton.restPosition(*body.skeleton.find(name)); }
};

Made made(const Person& person) {
  Made result{makeBody(person, {}), {}};
  result.organs = organsOf(result.body);
  return result;
}

struct Case {
  Sex sex;
  double percentile;
};

class OrgansOfPercentile : public testing::TestWithParam<Case> {};

TEST_P(OrgansOfPercentile, AreSoundOfTheirVolumeInsideTheSkinAndApart) {
  const Made who = made(personAtPercentile(GetParam().sex, GetParam().percentile));
  test::expectSoundOrgans(who.body, who.organs);
}

INSTANTIATE_TEST_SUITE_P(MenAndWomen, OrgansOfPercentile,
                         testing::Values(Case{Sex::male, 5}, Case{Sex::male, 50}, Case{Sex::male, 95},
                                         Case{Sex::female, 5}, Case{Sex::female, 50}, Case{Sex::female, 95}),
                         [](const auto& test) {
                           return std::string(test.param.sex == Sex::male ? "Man" : "Woman") +
                                  std::to_string(static_cast<int>(test.param.percentile));
                         });

TEST(OrgansOfAHeavyMan, AreSoundOfTheirVolumeInsideTheSkinAndApart) {
  const Made who = made({Sex::male, 1.72, 115.0});
  test::expectSoundOrgans(who.body, who.organs);
}

TEST(OrgansOfASlimWoman, AreSoundOfTheirVolumeInsideTheSkinAndApart) {
  const Made who = made({Sex::female, 1.72, 60.0});
  test::expectSoundOrgans(who.body, who.organs);
}

/// Area of the part of a mesh's level section to the left of the middle, m2.
double leftSection(const TriangleMesh& mesh, double height) {
  double twice = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::vector<Vec3d> ends;
    std::vector<bool> rising;
    for (int k = 0; k < 3; ++k) {
      const Vec3d a = mesh.corner(t, k);
      const Vec3d b = mesh.corner(t, (k + 1) % 3);
      if ((a.y() < height) != (b.y() < height)) {
        ends.emplace_back(a + (height - a.y()) / (b.y() - a.y()) * (b - a));
        rising.push_back(a.y() < height);
      }
    }
    if (ends.size() == 2 && ends[0].x() > 0.0) {
      const Vec3d& from = rising[0] ? ends[1] : ends[0];
      const Vec3d& to = rising[0] ? ends[0] : ends[1];
      twice += from.z() * to.x() - from.x() * to.z();
    }
  }
  return std::abs(0.5 * twice);
}

TEST(OrgansOfTheMedianMan, LieWhereAnAnatomistLooksForThem) {
  const Made man = made(personAtPercentile(Sex::male, 50));
  // Left is positive x.
  EXPECT_GT(man.centre("stomach").x(), 0.03);
  EXPECT_GT(man.centre("spleen").x(), 0.06);
  EXPECT_LT(man.centre("liver").x(), -0.03);
  EXPECT_GT(man.centre("heart").x(), 0.0);
  EXPECT_GT(man.centre("kidney_left").y(), man.centre("kidney_right").y() + 0.008);
  // The apices of the lungs stand above the collar bones, the base of the right one above that of the left's dome.
  EXPECT_GT(man.box("lung_left").max().y(), man.joint("sternoclavicular_L").y());
  EXPECT_GT(man.box("lung_right").max().y(), man.joint("sternoclavicular_R").y());
  EXPECT_GT(man.box("liver").max().y(), man.box("stomach").max().y());
  EXPECT_GT(man.organ("lung_right").targetVolume, man.organ("lung_left").targetVolume);
  // Kidneys and spinal cord lie behind, bladder and bowel before; the cord ends at the first lumbar disc.
  const double disc = man.joint("spine_L1L2").z();
  EXPECT_LT(man.centre("kidney_left").z(), disc);
  EXPECT_GT(man.centre("small_intestine").z(), disc + 0.05);
  EXPECT_GT(man.centre("bladder").z(), man.centre("large_intestine").z());
  EXPECT_NEAR(man.box("spinal_cord").min().y(), man.joint("spine_L1L2").y(), 0.015);
  EXPECT_NEAR(man.box("spinal_cord").max().y(), man.joint("head_C0C1").y(), 0.02);
  EXPECT_LT(man.box("spinal_cord").max().z(), man.joint("head_C0C1").z());
  // The colon frames the bowel.
  EXPECT_LT(man.box("large_intestine").min().x(), man.box("small_intestine").min().x());
  EXPECT_GT(man.box("large_intestine").max().x(), man.box("small_intestine").max().x());
  EXPECT_GT(man.box("large_intestine").max().y(), man.box("small_intestine").max().y());
  // The heart's shadow is about as wide as the rule says.
  EXPECT_NEAR(man.box("heart").sizes().x() / heartTransverseDiameter(man.body.person), 1.0, 0.10);
  EXPECT_GT(cardiothoracicRatio(man.body, man.organs), 0.40);
  EXPECT_LT(cardiothoracicRatio(man.body, man.organs), 0.56);
  // Eyes at their joints.
  EXPECT_NEAR(man.box("eyes").center().y(), man.joint("eye_L").y(), 0.004);
  EXPECT_NEAR(man.box("eyes").max().x(), man.joint("eye_L").x() + 0.012, 0.004);
  // Vessels run into the limbs with the table's calibres.
  for (const char* name : {"arteries", "veins"}) {
    const geometry::ClosestPointTree tree(man.organ(name).mesh);
    for (const char* place : {"elbow", "wrist", "hip", "knee", "ankle", "glenohumeral"}) {
      for (const char* side : {"_L", "_R"}) {
        EXPECT_LT(tree.closest(man.joint(std::string(place) + side))->distance, 0.06) << name << " " << place << side;
      }
    }
  }
  // Half way down the thigh: superficial and deep femoral artery of the table.
  const double knee = man.joint("knee_L").y();
  const double hip = man.joint("hip_L").y();
  const double square = std::numbers::pi / 4.0 * (std::pow(5.8e-3, 2.0) + std::pow(4.29e-3, 2.0));
  const double share = 0.62;
  EXPECT_NEAR(leftSection(man.organ("arteries").mesh, knee + share * (hip - knee)) / square, 1.0, 0.12);
}

TEST(Organs, AreTheSameAtAnyNumberOfThreads) {
  const Body body = keptHuman({}, {}).body;
  OrganOptions one;
  one.threads.count = 1;
  OrganOptions three;
  three.threads.count = 3;
  const std::vector<Organ> a = organsOf(body, one);
  const std::vector<Organ> b = organsOf(body, three);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(a[i].mesh.positions == b[i].mesh.positions) << a[i].name;
    EXPECT_TRUE(a[i].mesh.triangles == b[i].mesh.triangles) << a[i].name;
  }
}

TEST(Organs, CanBeCancelled) {
  const Body body = keptHuman({}, {}).body;
  base::Task task;
  task.cancel();
  EXPECT_THROW(organsOf(body, {}, base::Progress(task)), base::Cancelled);
}

}  // namespace
}  // namespace lorica::manikin
