#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lorica/analysis/deformation.h"
#include "lorica/geometry/measures.h"
#include "lorica/study/study_file.h"

// What the thesis shows in pictures, in numbers: Test Cases 1 and 2 (section 2.4), Table 1, Figures 33 to 38.

namespace lorica::analysis {
namespace {

using geometry::Positions;
using geometry::RigidTransform;
using geometry::Vec3d;
using geometry::Vec3f;
using viscera::OrganModel;

const std::vector<OrganModel> allModels = {OrganModel::staticJoint, OrganModel::staticSkin, OrganModel::dynamicThesis,
                                           OrganModel::dynamic};
constexpr std::size_t joint = 0;
constexpr std::size_t skin = 1;

LoadedStudy loaded(study::Study study) {
  LoadOptions options;
  options.allModels = true;
  return load(std::move(study), "study", {}, {}, options);
}

study::Study templateNamed(const std::string& name) {
  return study::parseStudy(study::templateText(name), name);
}

/// The rigid motion that carries one set of points nearest to another (Kabsch 1976).
RigidTransform motionOf(const std::vector<Vec3d>& from, const std::vector<Vec3d>& to) {
  Vec3d a = Vec3d::Zero();
  Vec3d b = Vec3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    a += from[i] / static_cast<double>(from.size());
    b += to[i] / static_cast<double>(from.size());
  }
  geometry::Mat3d covariance = geometry::Mat3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    covariance += (to[i] - b) * (from[i] - a).transpose();
  }
  const Eigen::JacobiSVD<geometry::Mat3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const geometry::Mat3d turn = svd.matrixU() * svd.matrixV().transpose();
  return {geometry::Quatd(turn), b - turn * a};
}

/// What a test case's model and the skin around it did.
struct Placement {
  double turned = 0.0;        ///< degrees
  double moved = 0.0;         ///< mm, of its centroid
  double turnedInSkin = 0.0;  ///< degrees, against the skin nearest to it
  double movedInSkin = 0.0;   ///< mm, against the place that skin would carry it to
  double outside = 0.0;       ///< % of its volume outside the skin
  double protrusion = 0.0;    ///< mm
};

class TestCase {
 public:
  explicit TestCase(study::Study study) : study_(loaded(std::move(study))), audit_(study_, {}) {}

  Placement placement(const std::string& pose, std::size_t model) const {
    const PosedScene scene(study_, allModels, resolvePose(study_, pose).pose, raycast::SceneUse::manyRays, {});
    const Positions& rest = study_.organs[0]->rig.rest.positions;
    const RigidTransform own = motionOf(points(rest), points(scene.organ(0, model)));
    const RigidTransform around = skinMotion(scene.body().skin);
    const Vec3d centre = geometry::centroid(study_.organs[0]->rig.rest);
    const viscera::OrganAudit organ = audit_.measure(scene, model, {}).audit.organs[0];
    Placement made;
    made.turned = degrees(own.rotation);
    made.moved = 1e3 * (own * centre - centre).norm();
    made.turnedInSkin = degrees(around.rotation.conjugate() * own.rotation);
    made.movedInSkin = 1e3 * (own * centre - around * centre).norm();
    made.outside = 100.0 * organ.outsideShare->value;
    made.protrusion = 1e3 * *organ.protrusion;
    fmt::print(
        "{:<12} {:<13} turned {:5.1f} deg, moved {:6.1f} mm; against the skin around it {:5.1f} deg, {:5.1f} mm; "
        "outside {:5.2f} %, by {:5.2f} mm\n",
        pose, viscera::name(allModels[model]), made.turned, made.moved, made.turnedInSkin, made.movedInSkin,
        made.outside, made.protrusion);
    return made;
  }
  const LoadedStudy& study() const { return study_; }

 private:
  static double degrees(const geometry::Quatd& turn) {
    return turn.angularDistance(geometry::Quatd::Identity()) * 180.0 / M_PI;
  }
  static std::vector<Vec3d> points(const Positions& positions) {
    std::vector<Vec3d> result;
    for (const Vec3f& p : positions) {
      result.push_back(p.cast<double>());
    }
    return result;
  }
  /// Of the skin nearest to the model at rest: everything up to half again as far as the nearest place.
  RigidTransform skinMotion(const Positions& posed) const {
    const Vec3d centre = geometry::centroid(study_.organs[0]->rig.rest);
    const Positions& rest = study_.body->body().skin.positions;
    double nearest = 1e9;
    for (const Vec3f& p : rest) {
      nearest = std::min(nearest, (p.cast<double>() - centre).norm());
    }
    std::vector<Vec3d> from;
    std::vector<Vec3d> to;
    for (std::size_t v = 0; v < rest.size(); ++v) {
      if ((rest[v].cast<double>() - centre).norm() < 1.5 * nearest) {
        from.push_back(rest[v].cast<double>());
        to.push_back(posed[v].cast<double>());
      }
    }
    return motionOf(from, to);
  }

  LoadedStudy study_;
  StudyAudit audit_;
};

const TestCase& shoulder() {
  static const TestCase made(templateNamed("test_case_1"));
  return made;
}

const TestCase& forearm() {
  static const TestCase made(templateNamed("test_case_2"));
  return made;
}

TEST(ThesisTestCase1, CarriedByTheShoulderJointTheCubeGoesWithTheArmAndOutOfTheBack) {
  EXPECT_EQ(shoulder().study().body->body().skeleton->joints()[shoulder().study().organs[0]->rig.joint->value].name,
            "glenohumeral_L")
      << "the nearest joint, as in the thesis";
  const Placement lowered = shoulder().placement("arm_lowered", joint);
  EXPECT_NEAR(lowered.turned, 25.0, 0.1) << "the whole turn of the arm";
  EXPECT_GT(lowered.movedInSkin, 20.0);
  const Placement raised = shoulder().placement("arm_raised", joint);
  EXPECT_NEAR(raised.turned, 60.0, 0.1);
  EXPECT_GT(raised.outside, 30.0);
  EXPECT_GT(raised.protrusion, 10.0);
}

TEST(ThesisTestCase1, ParentedToTheSkinTheCubeStaysInTheBackAndKeepsItsPlaceInTheSkin) {
  for (const std::string pose : {"arm_lowered", "arm_raised"}) {
    const Placement byJoint = shoulder().placement(pose, joint);
    const Placement bySkin = shoulder().placement(pose, skin);
    EXPECT_EQ(bySkin.outside, 0.0);
    EXPECT_EQ(bySkin.protrusion, 0.0);
    EXPECT_LT(bySkin.moved, 0.5 * byJoint.moved);
    EXPECT_LT(bySkin.movedInSkin, 10.0);
    EXPECT_LT(bySkin.movedInSkin, 0.4 * byJoint.movedInSkin);
  }
}

TEST(ThesisTestCase2, CarriedByTheWristTheBoxCopiesItsTurnAndComesOutOfTheForearm) {
  const Placement turned = forearm().placement("wrist_turned", joint);
  EXPECT_NEAR(turned.turned, 80.0, 0.1) << "the exact turn of the wrist (Figure 17)";
  EXPECT_GT(turned.turnedInSkin, 20.0) << "farther than the skin";
  EXPECT_GT(turned.protrusion, 0.5) << "Figure 18";
  const Placement bent = forearm().placement("wrist_bent", joint);
  EXPECT_NEAR(bent.turned, 40.0, 0.1);
  EXPECT_GT(bent.outside, 50.0);
}

TEST(ThesisTestCase2, ParentedToTheSkinTheBoxTurnsWithTheForearmAndStaysInside) {
  const Placement turned = forearm().placement("wrist_turned", skin);
  EXPECT_GT(turned.turned, 20.0);
  EXPECT_LT(turned.turned, 70.0) << "between elbow and wrist";
  EXPECT_LT(turned.turnedInSkin, 10.0);
  EXPECT_LT(turned.movedInSkin, 5.0);
  EXPECT_EQ(turned.outside, 0.0);
  EXPECT_EQ(turned.protrusion, 0.0);
  const Placement bent = forearm().placement("wrist_bent", skin);
  EXPECT_LT(bent.moved, 5.0) << "a wrist that bends leaves the forearm where it is";
  EXPECT_EQ(bent.outside, 0.0);
}

/// Table 1. The text says that skin-based parenting requires neither knowledge of the skeleton nor a chosen joint; the
/// table's marks in those columns stand for "not required".
struct Features {
  bool needsKnowledge = false;
  bool needsChosenJoint = false;
  bool jointControls = false;
  bool testCase1 = false;
  bool testCase2 = false;
  bool operator==(const Features&) const = default;
};

Positions posed(const LoadedStudy& study, const std::string& pose, std::size_t model) {
  return PosedScene(study, allModels, resolvePose(study, pose).pose, raycast::SceneUse::manyRays, {}).organ(0, model);
}

Features featuresOf(std::size_t model) {
  Features made;
  // Another joint in charge: does the motion depend on it?
  study::Study other = templateNamed("test_case_1");
  other.organs[0].joint = "spine_T6T7";
  const LoadedStudy otherJoint = loaded(other);
  made.jointControls = posed(otherJoint, "arm_raised", model) != posed(shoulder().study(), "arm_raised", model);
  const auto emulates = [&](const TestCase& testCase, const std::vector<std::string>& poses) {
    return std::all_of(poses.begin(), poses.end(), [&](const std::string& pose) {
      const Placement placed = testCase.placement(pose, model);
      return placed.protrusion == 0.0 && placed.movedInSkin < 10.0 && placed.turnedInSkin < 15.0;
    });
  };
  made.testCase1 = emulates(shoulder(), {"arm_lowered", "arm_raised"});
  made.testCase2 = emulates(forearm(), {"wrist_turned", "wrist_bent"});
  // The nearest joint, which nobody has to know or choose, is not enough.
  made.needsChosenJoint = !made.testCase1;
  made.needsKnowledge = made.needsChosenJoint && made.jointControls;
  return made;
}

TEST(ThesisTable1, IsReproduced) {
  EXPECT_EQ(featuresOf(joint), (Features{true, true, true, false, false}));
  EXPECT_EQ(featuresOf(skin), (Features{false, false, false, true, true}));
}

TEST(ThesisTable1, NoSingleJointTurnsTheBoxOfTestCase2AsTheSkinDoes) {
  const human::Skeleton& skeleton = *forearm().study().body->body().skeleton;
  const human::Pose pose = *resolvePose(forearm().study(), "wrist_turned").pose;
  const std::vector<RigidTransform> carry = parenting::carryJoints(skeleton, pose);
  const double bySkin = forearm().placement("wrist_turned", skin).turned;
  for (const RigidTransform& motion : carry) {
    const double turned = motion.rotation.angularDistance(geometry::Quatd::Identity()) * 180.0 / M_PI;
    EXPECT_GT(std::abs(turned - bySkin), 20.0);
  }
}

/// Audit rows of the built-in human's trunk in the twists.
class ThesisFigures : public testing::Test {
 protected:
  struct Twist {
    std::string pose;
    ModelDeformation deformation;
  };
  /// The sample with its lungs on the nearest joint, or on one that the whole chest hangs on: a skeleton with few
  /// joints in its spine, as the thesis', has no nearer one.
  static LoadedStudy sample(bool lungsOnLumbarSpine) {
    study::Study made = templateNamed("sample");
    for (study::Organ& organ : made.organs) {
      if (lungsOnLumbarSpine && organ.name.starts_with("lung")) {
        organ.joint = "spine_L1L2";
      }
    }
    return loaded(made);
  }
  static const LoadedStudy& study() {
    static const LoadedStudy made = sample(false);
    return made;
  }
  static std::vector<std::vector<Twist>> twistsOf(const LoadedStudy& study) {
    const StudyAudit audit(study, {});
    std::vector<std::vector<Twist>> made(allModels.size());
    for (const std::string pose : {"belly_twist@1", "belly_twist@3", "lateral_twist@1", "lateral_twist@3"}) {
      const PosedScene scene(study, allModels, resolvePose(study, pose).pose, raycast::SceneUse::manyRays, {});
      for (std::size_t m = 0; m < allModels.size(); ++m) {
        made[m].push_back({pose, audit.measure(scene, m, {})});
      }
    }
    return made;
  }
  static const std::vector<Twist>& twists(std::size_t model) {
    static const std::vector<std::vector<Twist>> all = twistsOf(study());
    return all[model];
  }
  static std::size_t organ(const std::string& name) {
    const auto found =
        std::find_if(study().organs.begin(), study().organs.end(), [&](const auto& o) { return o->name == name; });
    return static_cast<std::size_t>(found - study().organs.begin());
  }
  /// The largest of a number over the twists, printed.
  template <class Number>
  static double worst(const std::string& what, std::size_t model, const std::vector<Twist>& rows,
                      const Number& number) {
    double largest = 0.0;
    for (const Twist& twist : rows) {
      const double value = number(twist.deformation.audit);
      fmt::print("{:<15} {:<15} {:<45} {:8.2f}\n", viscera::name(allModels[model]), twist.pose, what, value);
      largest = std::max(largest, value);
    }
    return largest;
  }
  static const viscera::ContactAudit* contact(const viscera::PoseAudit& audit, const std::string& a,
                                              const std::string& b) {
    const std::size_t low = std::min(organ(a), organ(b));
    const std::size_t high = std::max(organ(a), organ(b));
    for (const viscera::ContactAudit& c : audit.contacts) {
      if (c.first == low && c.second == high) {
        return &c;
      }
    }
    return nullptr;
  }
  static double lungOutside(std::size_t model) {
    static const std::vector<std::vector<Twist>> all = twistsOf(sample(true));
    return worst("lungs outside the skin, mm", model, all[model], [](const viscera::PoseAudit& audit) {
      return 1e3 *
             std::max(*audit.organs[organ("lung_left")].protrusion, *audit.organs[organ("lung_right")].protrusion);
    });
  }
  static double lungInLiver(std::size_t model) {
    return worst("right lung in the liver beyond rest, cm3", model, twists(model), [](const viscera::PoseAudit& audit) {
      const auto* found = contact(audit, "lung_right", "liver");
      return found != nullptr ? 1e6 * *found->overlapBeyondRest : 0.0;
    });
  }
  static double gapAtColon(std::size_t model) {
    return worst("largest gap, small to large intestine, mm", model, twists(model),
                 [](const viscera::PoseAudit& audit) {
                   return 1e3 * contact(audit, "small_intestine", "large_intestine")->gap->largest;
                 });
  }
};

TEST_F(ThesisFigures, Figures33And34AStaticLungLeavesTheSkinInATwistAndADynamicOneDoesNot) {
  EXPECT_GT(lungOutside(0), 1.0);
  EXPECT_EQ(lungOutside(2), 0.0);
  EXPECT_EQ(lungOutside(3), 0.0);
}

TEST_F(ThesisFigures, Figures35And36AStaticLungCutsTheLiverInATwistAndADynamicOneDoesNot) {
  EXPECT_GT(lungInLiver(0), 10.0);
  EXPECT_LT(lungInLiver(2), 1.0);
  EXPECT_LT(lungInLiver(3), 1.0);
}

TEST_F(ThesisFigures, Figures37And38StaticOrgansPartAboveTheColonAndDynamicOnesKeepTheirSeal) {
  const double rigid = gapAtColon(0);
  EXPECT_GT(rigid, 10.0);
  EXPECT_LT(gapAtColon(2), 0.5 * rigid);
  EXPECT_LT(gapAtColon(3), 0.2 * rigid);
}

}  // namespace
}  // namespace lorica::analysis
