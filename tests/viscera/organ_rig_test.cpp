#include "lorica/viscera/organ_rig.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"

namespace lorica::viscera {
namespace {

using geometry::Positions;
using geometry::Vec3d;
using geometry::Vec3f;

constexpr std::array allModels = {OrganModel::staticJoint, OrganModel::staticSkin, OrganModel::dynamicThesis,
                                  OrganModel::dynamic};

/// A trunk that bends and twists in its middle, with an organ that spans the bend.
class Trunk : public testing::Test {
 protected:
  Trunk() : rig_(body(), {}, {}), organ_(bindOrgan(organMesh(), "gut", rig_, {}, {})) {}

  static parenting::Body body() {
    parenting::Body made;
    made.skin = geometry::ellipsoid({0, 1, 0}, {0.2, 0.8, 0.15}, 5);
    human::Joint pelvis{"pelvis", std::nullopt, {}};
    pelvis.rest.translation = {0, 0.8, 0};
    human::Joint chest{"chest", human::JointIndex{0}, {}};
    chest.rest.translation = {0, 0.2, 0};
    made.skeleton = human::Skeleton({pelvis, chest});
    std::vector<human::Influence> influences;
    for (const Vec3f& p : made.skin.positions) {
      const double w = std::clamp((static_cast<double>(p.y()) - 0.8) / 0.4, 0.0, 1.0);
      influences.push_back({0, 1 - w});
      influences.push_back({1, w});
    }
    made.weights = human::normaliseWeights(influences, 2).weights;
    made.regions = human::bodyRegions(made.skin, *made.weights, *made.skeleton);
    return made;
  }
  static geometry::TriangleMesh organMesh() { return geometry::ellipsoid({0.02, 1.0, 0.01}, {0.1, 0.3, 0.07}, 4); }

  human::Pose turned(const Vec3d& rootDegrees, const Vec3d& chestDegrees, const Vec3d& offset) const {
    return human::turnedPose(*rig_.body().skeleton,
                             {{human::JointIndex{0}, rootDegrees}, {human::JointIndex{1}, chestDegrees}}, offset);
  }
  Positions posedOrgan(OrganModel model, const std::optional<human::Pose>& pose) const {
    Positions posed(organ_.rest.positions.size());
    poseOrgan(organ_, model, rig_, rig_.pose(pose, {}), posed, {});
    return posed;
  }

  parenting::BodyRig rig_;
  OrganRig organ_;
};

TEST_F(Trunk, AtRestReturnsEveryOrganVertexBitForBitInEveryModel) {
  for (const OrganModel model : allModels) {
    const Positions posed = posedOrgan(model, std::nullopt);
    EXPECT_EQ(std::memcmp(posed.data(), organ_.rest.positions.data(), posed.size() * sizeof(Vec3f)), 0) << name(model);
    const Positions restPose = posedOrgan(model, human::restPose(*rig_.body().skeleton));
    EXPECT_EQ(std::memcmp(restPose.data(), organ_.rest.positions.data(), posed.size() * sizeof(Vec3f)), 0)
        << name(model);
  }
}

TEST_F(Trunk, RigidMotionOfTheWholeBodyMovesTheOrganRigidlyInEveryModel) {
  const human::Pose pose = turned({30, 100, -20}, Vec3d::Zero(), {0.4, -0.3, 2.0});
  const geometry::Affine3d motion = human::carryTransforms(*rig_.body().skeleton, pose)[0];
  for (const OrganModel model : allModels) {
    const Positions posed = posedOrgan(model, pose);
    for (std::size_t v = 0; v < posed.size(); ++v) {
      const Vec3d expected = motion * organ_.rest.positions[v].cast<double>();
      ASSERT_LT((posed[v].cast<double>() - expected).norm(), 1e-5) << name(model);
    }
  }
}

TEST_F(Trunk, StaticModelsStayRigidAndDynamicOnesFollowTheBend) {
  const human::Pose pose = turned(Vec3d::Zero(), {60, 0, 0}, Vec3d::Zero());
  const auto tipDistance = [&](OrganModel model) {
    // Highest and lowest vertices of the organ.
    std::size_t top = 0;
    std::size_t bottom = 0;
    for (std::size_t v = 0; v < organ_.rest.positions.size(); ++v) {
      top = organ_.rest.positions[v].y() > organ_.rest.positions[top].y() ? v : top;
      bottom = organ_.rest.positions[v].y() < organ_.rest.positions[bottom].y() ? v : bottom;
    }
    const Positions posed = posedOrgan(model, pose);
    return static_cast<double>((posed[top] - posed[bottom]).norm());
  };
  EXPECT_NEAR(tipDistance(OrganModel::staticJoint), 0.6, 1e-5);
  EXPECT_NEAR(tipDistance(OrganModel::staticSkin), 0.6, 1e-5);
  EXPECT_LT(tipDistance(OrganModel::dynamicThesis), 0.58);
  EXPECT_LT(tipDistance(OrganModel::dynamic), 0.58);
}

TEST_F(Trunk, ADynamicOrganStaysInsideASkinThatARigidOneLeaves) {
  const human::Pose pose = turned(Vec3d::Zero(), {70, 0, 0}, Vec3d::Zero());
  const parenting::PosedBody posed = rig_.pose(pose, {});
  raycast::Scene scene(raycast::SceneUse::manyRays);
  const raycast::MeshIndex skin = scene.add(posed.skin, rig_.skinTopology());
  scene.build();
  raycast::Caster caster(scene);
  const auto outside = [&](OrganModel model) {
    std::size_t count = 0;
    for (const Vec3f& p : posedOrgan(model, pose)) {
      count += raycast::windingNumber(caster, skin, p.cast<double>()) < 1 ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(outside(OrganModel::staticJoint), 50U);
  EXPECT_EQ(outside(OrganModel::dynamic), 0U);
}

TEST_F(Trunk, TheSmoothModelHasNoJumpsBetweenNeighbouringVertices) {
  const human::Pose pose = turned(Vec3d::Zero(), {60, 20, 0}, Vec3d::Zero());
  const auto worstStretch = [&](OrganModel model) {
    const Positions posed = posedOrgan(model, pose);
    double worst = 0.0;
    for (const geometry::Triangle& t : organ_.rest.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double before =
            static_cast<double>((organ_.rest.positions[t[k]] - organ_.rest.positions[t[(k + 1) % 3]]).norm());
        worst = std::max(worst, static_cast<double>((posed[t[k]] - posed[t[(k + 1) % 3]]).norm()) / before);
      }
    }
    return worst;
  };
  EXPECT_LT(worstStretch(OrganModel::dynamic), worstStretch(OrganModel::dynamicThesis));
}

TEST_F(Trunk, AnOrganOutsideTheSkinIsCarriedByTheNearestSite) {
  const OrganRig outside =
      bindOrgan(geometry::ellipsoid({0.5, 1.0, 0}, {0.05, 0.05, 0.05}, 2), "outside", rig_, {}, {});
  ASSERT_TRUE(outside.site);
  EXPECT_LT(outside.reference.x(), 0.2) << "the reference point is an interior site, not the centroid outside";
}

TEST_F(Trunk, TheChosenJointCarriesTheStaticModel) {
  OrganOptions options;
  options.joint = human::JointIndex{0};
  const OrganRig low = bindOrgan(organMesh(), "gut", rig_, options, {});
  const human::Pose pose = turned(Vec3d::Zero(), {60, 0, 0}, Vec3d::Zero());
  Positions posed(low.rest.positions.size());
  poseOrgan(low, OrganModel::staticJoint, rig_, rig_.pose(pose, {}), posed, {});
  EXPECT_EQ(std::memcmp(posed.data(), low.rest.positions.data(), posed.size() * sizeof(Vec3f)), 0)
      << "the pelvis does not move";
}

TEST(SiteBlend, WeightsSumToOneAndTheNearestSiteWeighsMost) {
  std::vector<parenting::SkinSite> sites(40);
  for (std::size_t s = 0; s < sites.size(); ++s) {
    sites[s].rest = {0.04 * static_cast<double>(s % 4), 0.04 * static_cast<double>(s / 4), 0};
  }
  const std::vector<Vec3d> points{{0.01, 0.13, 0.0}, {0.09, 0.2, 0.03}};
  for (const SiteBlend& blend : bindToSites(points, sites, SiteBinding::smooth, {})) {
    float sum = 0.0F;
    for (std::size_t k = 0; k < blend.count; ++k) {
      sum += blend.weight[k];
      EXPECT_GE(blend.weight[0], blend.weight[k]);
    }
    EXPECT_NEAR(sum, 1.0F, 1e-6F);
  }
  for (const SiteBlend& blend : bindToSites(points, sites, SiteBinding::nearest, {})) {
    EXPECT_EQ(blend.count, 1U);
  }
}

}  // namespace
}  // namespace lorica::viscera
