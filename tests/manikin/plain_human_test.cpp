#include "lorica/manikin/plain_human.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/geometry/winding.h"

namespace lorica::manikin {
namespace {

using geometry::Vec3d;

const PlainHuman& sample() {
  static const PlainHuman human = plainHuman();
  return human;
}

double squaredDistanceToTriangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto toSegment = [&](const Vec3d& from, const Vec3d& to) {
    const double t = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    return (p - from - t * (to - from)).squaredNorm();
  };
  const Vec3d normal = (b - a).cross(c - a);
  const bool above = normal.dot((b - a).cross(p - a)) >= 0.0 && normal.dot((c - b).cross(p - b)) >= 0.0 &&
                     normal.dot((a - c).cross(p - c)) >= 0.0;
  if (above) {
    const double height = normal.dot(p - a);
    return height * height / normal.squaredNorm();
  }
  return std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
}

double distanceTo(const geometry::TriangleMesh& mesh, const Vec3d& p) {
  double nearest = 1e9;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    nearest = std::min(nearest, squaredDistanceToTriangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
  }
  return std::sqrt(nearest);
}

template <class Mesh>
bool sameMesh(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && a.triangles == b.triangles;
}

TEST(PlainHumanSkin, IsOneClosedManifoldOutwardPiece) {
  const geometry::MeshAudit audit = geometry::audit(sample().skin);
  EXPECT_EQ(audit.components.size(), 1u);
  EXPECT_TRUE(audit.closed());
  EXPECT_EQ(audit.oddEdges, 0u);
  EXPECT_EQ(audit.boundaryEdges, 0u);
  EXPECT_EQ(audit.degenerateTriangles, 0u);
  EXPECT_GT(geometry::signedVolume(sample().skin), 0.0);
}

TEST(PlainHumanSkin, HasNoHandleSoLimbsAreNotFusedToEachOtherOrTheTrunk) {
  // Euler characteristic 2: a fused arm or two fused legs would add a handle.
  const auto& skin = sample().skin;
  const auto vertices = static_cast<long>(skin.positions.size());
  const auto faces = static_cast<long>(skin.triangles.size());
  EXPECT_EQ(vertices - 3 * faces / 2 + faces, 2);
}

TEST(PlainHumanSkin, HasTwentyToFortyThousandTriangles) {
  EXPECT_GE(sample().skin.triangles.size(), 20000u);
  EXPECT_LE(sample().skin.triangles.size(), 40000u);
}

TEST(PlainHumanSkin, StandsOnTheFloorAndIsAsTallAsTheMedianMan) {
  const auto box = geometry::bounds(sample().skin.positions);
  EXPECT_NEAR(box.min().y(), 0.0, 0.0005);
  EXPECT_NEAR(box.max().y() - box.min().y(), 1.755, 0.002);
}

TEST(PlainHumanSkin, IsTheSameOnBothSidesAndFacesForward) {
  const auto box = geometry::bounds(sample().skin.positions);
  EXPECT_NEAR(box.max().x(), -box.min().x(), 1e-4);
  // The toes are further before the ankle than the heel is behind it.
  const double ankle = sample().skeleton.restPosition(*sample().skeleton.find("ankle_L")).z();
  double toe = -1.0;
  double heel = 1.0;
  for (const auto& p : sample().skin.positions) {
    if (p.y() < 0.03F) {
      toe = std::max(toe, static_cast<double>(p.z()));
      heel = std::min(heel, static_cast<double>(p.z()));
    }
  }
  EXPECT_GT(toe - ankle, 2.0 * (ankle - heel));
  EXPECT_NEAR(toe - heel, 0.271, 0.02);  // ANSUR II male median foot length
}

TEST(PlainHumanSkin, WeighsLikeAManAtTheDensityOfWater) {
  const double kilograms = 1000.0 * geometry::signedVolume(sample().skin);
  EXPECT_GT(kilograms, 65.0);
  EXPECT_LT(kilograms, 95.0);
}

TEST(PlainHumanSkeleton, HasTheJointNamesOfTheTableAndWorldAlignedRestFrames) {
  const human::Skeleton& skeleton = sample().skeleton;
  for (const char* name : {"pelvis_root", "spine_L5S1", "spine_L3L4", "spine_L1L2", "spine_T10T11", "spine_T6T7",
                           "spine_T2T3", "spine_C7T1", "head_C0C1"}) {
    EXPECT_TRUE(skeleton.find(name)) << name;
  }
  for (const char* name : {"sternoclavicular", "glenohumeral", "elbow", "wrist", "hip", "knee", "ankle", "toe_MTP"}) {
    const auto left = skeleton.find(std::string(name) + "_L");
    const auto right = skeleton.find(std::string(name) + "_R");
    ASSERT_TRUE(left && right) << name;
    EXPECT_GT(skeleton.restPosition(*left).x(), 0.0) << name;
    EXPECT_TRUE(
        skeleton.restPosition(*right).isApprox(skeleton.restPosition(*left).cwiseProduct(Vec3d(-1.0, 1.0, 1.0)), 1e-12))
        << name;
  }
  for (const human::Joint& joint : skeleton.joints()) {
    EXPECT_EQ(joint.rest.rotation.coeffs(), geometry::Quatd::Identity().coeffs()) << joint.name;
    EXPECT_EQ(joint.rest.scale, Vec3d::Ones()) << joint.name;
  }
}

TEST(PlainHumanSkeleton, LiesInsideTheSkin) {
  for (std::size_t j = 0; j < sample().skeleton.size(); ++j) {
    const human::JointIndex index{j};
    EXPECT_NEAR(geometry::windingNumber(sample().skin, sample().skeleton.restPosition(index)), 1.0, 1e-6)
        << sample().skeleton.joint(index).name;
  }
}

TEST(PlainHumanSkeleton, HoldsTheArmsThirtyDegreesFromTheTrunk) {
  const human::Skeleton& skeleton = sample().skeleton;
  const Vec3d arm =
      skeleton.restPosition(*skeleton.find("wrist_L")) - skeleton.restPosition(*skeleton.find("glenohumeral_L"));
  EXPECT_NEAR(std::atan2(arm.x(), -arm.y()) * 180.0 / 3.14159265358979, 30.0, 2.0);
}

class PlainHumanWeights : public testing::Test {
 protected:
  bool ties(std::size_t vertex, const std::string& part) const {
    const auto& weights = sample().weights;
    for (std::size_t i = vertex * weights.influences; i < (vertex + 1) * weights.influences; ++i) {
      if (weights.weights[i] > 0.0F &&
          sample().skeleton.joints()[weights.joints[i]].name.find(part) != std::string::npos) {
        return true;
      }
    }
    return false;
  }
};

TEST_F(PlainHumanWeights, FitTheSkinAndSumToOneOverAtMostFourJoints) {
  const auto& weights = sample().weights;
  ASSERT_EQ(weights.vertices(), sample().skin.positions.size());
  EXPECT_LE(weights.influences, 4u);
  for (std::size_t v = 0; v < weights.vertices(); ++v) {
    double sum = 0.0;
    for (std::size_t i = v * weights.influences; i < (v + 1) * weights.influences; ++i) {
      ASSERT_LT(weights.joints[i], sample().skeleton.size());
      ASSERT_GE(weights.weights[i], 0.0F);
      sum += static_cast<double>(weights.weights[i]);
    }
    ASSERT_NEAR(sum, 1.0, 1e-6) << "vertex " << v;
  }
}

TEST_F(PlainHumanWeights, NeverTieAnArmToALegOrTheLowerTrunkNorOneSideToTheOther) {
  for (std::size_t v = 0; v < sample().weights.vertices(); ++v) {
    const bool arm = ties(v, "glenohumeral") || ties(v, "elbow") || ties(v, "wrist");
    const bool leg = ties(v, "hip") || ties(v, "knee") || ties(v, "ankle") || ties(v, "toe");
    ASSERT_FALSE(arm && leg) << "vertex " << v;
    if (arm) {
      for (const char* low : {"pelvis", "L5S1", "L3L4", "L1L2"}) {
        ASSERT_FALSE(ties(v, low)) << "vertex " << v << " " << low;
      }
    }
    ASSERT_FALSE(ties(v, "_L") && ties(v, "_R") && !ties(v, "spine")) << "vertex " << v;
  }
}

TEST_F(PlainHumanWeights, GiveTheHandsToTheWristAndTheCrownToTheHead) {
  const auto& skin = sample().skin;
  const Vec3d wrist = sample().skeleton.restPosition(*sample().skeleton.find("wrist_R"));
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    const Vec3d p = skin.positions[v].cast<double>();
    const std::string& joint = sample().skeleton.joint(sample().weights.strongest(v)).name;
    if (p.x() < wrist.x() - 0.05) {
      EXPECT_EQ(joint, "wrist_R");
    }
    if (p.y() > 1.66) {
      EXPECT_EQ(joint, "head_C0C1");
    }
  }
}

TEST_F(PlainHumanWeights, RunEvenlyAcrossTheSkin) {
  // Along an edge of about one cell no joint may gain or lose as much as half.
  const auto& weights = sample().weights;
  const auto of = [&](std::uint32_t vertex) {
    std::map<std::uint32_t, double> shares;
    for (std::size_t i = vertex * weights.influences; i < (vertex + 1) * weights.influences; ++i) {
      shares[weights.joints[i]] += static_cast<double>(weights.weights[i]);
    }
    return shares;
  };
  double worst = 0.0;
  for (const auto& triangle : sample().skin.triangles) {
    auto a = of(triangle[0]);
    auto b = of(triangle[1]);
    for (std::uint32_t joint = 0; joint < sample().skeleton.size(); ++joint) {
      worst = std::max(worst, std::abs(a[joint] - b[joint]));
    }
  }
  EXPECT_LT(worst, 0.45);
}

TEST(PlainHumanOrgans, AreTheBuiltinOnesInTheirOrder) {
  const std::vector<std::string> expected{"heart",           "lung_left",       "lung_right",  "liver",
                                          "spleen",          "stomach",         "kidney_left", "kidney_right",
                                          "small_intestine", "large_intestine", "spinal_cord"};
  EXPECT_EQ(builtinOrganNames(), expected);
  std::vector<std::string> names;
  for (const PlainOrgan& organ : sample().organs) {
    names.push_back(organ.name);
  }
  EXPECT_EQ(names, expected);
}

TEST(PlainHumanOrgans, AreSingleClosedOutwardSurfacesOfOneToFiveThousandTriangles) {
  for (const PlainOrgan& organ : sample().organs) {
    const geometry::MeshAudit audit = geometry::audit(organ.mesh);
    EXPECT_EQ(audit.components.size(), 1u) << organ.name;
    EXPECT_TRUE(audit.closed()) << organ.name;
    EXPECT_EQ(audit.oddEdges, 0u) << organ.name;
    EXPECT_GE(organ.mesh.triangles.size(), 1000u) << organ.name;
    EXPECT_LE(organ.mesh.triangles.size(), 5000u) << organ.name;
  }
}

TEST(PlainHumanOrgans, HaveTheVolumesOfTheReferenceMan) {
  // ICRP 89 adult male masses over densities, cm3; hollow organs with their contents, kidneys half of the pair.
  const std::map<std::string, double> reference{
      {"heart", 796.2},      {"lung_left", 1460.7},      {"lung_right", 1680.6},    {"liver", 1714.3},
      {"spleen", 144.2},     {"stomach", 384.6},         {"kidney_left", 147.6},    {"kidney_right", 147.6},
      {"spinal_cord", 28.8}, {"small_intestine", 961.5}, {"large_intestine", 644.1}};
  for (const PlainOrgan& organ : sample().organs) {
    const double volume = 1e6 * geometry::signedVolume(organ.mesh);
    EXPECT_NEAR(volume, reference.at(organ.name), 0.15 * reference.at(organ.name)) << organ.name;
  }
}

TEST(PlainHumanOrgans, LieAtLeastFiveMillimetresInsideTheSkin) {
  for (const PlainOrgan& organ : sample().organs) {
    for (std::size_t v = 0; v < organ.mesh.positions.size(); v += 29) {
      const Vec3d p = organ.mesh.positions[v].cast<double>();
      ASSERT_NEAR(geometry::windingNumber(sample().skin, p), 1.0, 1e-6) << organ.name;
      ASSERT_GT(distanceTo(sample().skin, p), 0.005) << organ.name << " at " << p.transpose();
    }
  }
}

TEST(PlainHumanOrgans, DoNotOverlapByMoreThanTwoCubicCentimetres) {
  constexpr double step = 0.009;
  for (std::size_t a = 0; a < sample().organs.size(); ++a) {
    for (std::size_t b = a + 1; b < sample().organs.size(); ++b) {
      const auto& first = sample().organs[a].mesh;
      const auto& second = sample().organs[b].mesh;
      const auto common = geometry::bounds(first.positions).intersection(geometry::bounds(second.positions));
      if (common.isEmpty()) {
        continue;
      }
      double overlap = 0.0;
      for (double x = common.min().x(); x < common.max().x(); x += step) {
        for (double y = common.min().y(); y < common.max().y(); y += step) {
          for (double z = common.min().z(); z < common.max().z(); z += step) {
            const Vec3d p(x, y, z);
            if (geometry::windingNumber(first, p) > 0.5 && geometry::windingNumber(second, p) > 0.5) {
              overlap += step * step * step * 1e6;
            }
          }
        }
      }
      EXPECT_LT(overlap, 2.0) << sample().organs[a].name << " and " << sample().organs[b].name;
    }
  }
}

TEST(PlainHumanOrgans, LieOnTheirSideOfTheBody) {
  std::map<std::string, Vec3d> centre;
  for (const PlainOrgan& organ : sample().organs) {
    centre[organ.name] = geometry::centroid(organ.mesh);
  }
  EXPECT_GT(centre["heart"].x(), 0.0);
  EXPECT_LT(centre["liver"].x(), 0.0);
  EXPECT_GT(centre["spleen"].x(), 0.0);
  EXPECT_GT(centre["stomach"].x(), 0.0);
  EXPECT_GT(centre["lung_left"].x(), 0.0);
  EXPECT_GT(centre["kidney_left"].x(), 0.0);
  EXPECT_LT(centre["kidney_left"].z(), centre["stomach"].z());
  EXPECT_GT(centre["heart"].y(), centre["liver"].y());
  EXPECT_GT(centre["liver"].y(), centre["small_intestine"].y());
}

TEST(PlainHuman, HasTheSameBytesEachTime) {
  const PlainHuman again = plainHuman();
  EXPECT_TRUE(sameMesh(again.skin, sample().skin));
  EXPECT_EQ(again.weights.joints, sample().weights.joints);
  EXPECT_EQ(again.weights.weights, sample().weights.weights);
  ASSERT_EQ(again.organs.size(), sample().organs.size());
  for (std::size_t i = 0; i < again.organs.size(); ++i) {
    EXPECT_TRUE(sameMesh(again.organs[i].mesh, sample().organs[i].mesh)) << again.organs[i].name;
  }
  ASSERT_EQ(again.clips.size(), sample().clips.size());
  for (std::size_t c = 0; c < again.clips.size(); ++c) {
    ASSERT_EQ(again.clips[c].channels.size(), sample().clips[c].channels.size());
    for (std::size_t i = 0; i < again.clips[c].channels.size(); ++i) {
      EXPECT_EQ(again.clips[c].channels[i].values, sample().clips[c].channels[i].values);
    }
  }
}

}  // namespace
}  // namespace lorica::manikin
