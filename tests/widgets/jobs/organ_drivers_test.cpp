#include "lorica/jobs/organ_drivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lorica/analysis/loaded_study.h"
#include "lorica/raycast/caster.h"
#include "lorica/study/study_file.h"

namespace lorica::jobs {
namespace {

using geometry::Vec3d;
using geometry::Vec3f;
using viscera::OrganModel;

analysis::LoadedStudy loaded(study::Deformer deformer) {
  study::Study study = study::parseStudy(study::templateText("sample"), "sample");
  study.deformer = deformer;
  analysis::LoadOptions options;
  options.allModels = true;
  return analysis::load(study, "sample.lorica.json", {}, {}, options);
}

/// Each organ deformed by a lattice of its own.
const analysis::LoadedStudy& sample() {
  static const analysis::LoadedStudy study = loaded(study::Deformer::lattice);
  return study;
}

std::size_t indexOf(const std::string& name) {
  const auto& organs = sample().organs;
  return static_cast<std::size_t>(
      std::find_if(organs.begin(), organs.end(), [&](const auto& one) { return one->name == name; }) - organs.begin());
}

const viscera::OrganRig& rigOfLiver() {
  return sample().organs[indexOf("liver")]->rig;
}

/// The drivers of the liver, and where its vertices are.
struct Driven {
  OrganDrivers drivers;
  geometry::Positions vertices;
  geometry::Positions skin;
};

Driven drivenLiver(OrganModel model, const std::string& pose) {
  const std::size_t liver = indexOf("liver");
  const analysis::PosedScene scene(sample(), {model}, analysis::resolvePose(sample(), pose).pose,
                                   raycast::SceneUse::manyFrames, {});
  return {poseDrivers(sample(), liver, std::make_shared<const DriverLayout>(driverLayout(sample(), liver, model)),
                      scene, {}),
          scene.organ(liver, 0), scene.body().skin};
}

TEST(CellEdges, OfOneCellAreTwelveAndOfTwoTimesTwoTimesTwoFiftyFour) {
  geometry::Positions points{{0, 0, 0}, {1, 1, 1}};
  viscera::Lattice lattice = viscera::makeLattice(points, {viscera::LatticeOptions::Layout::boundingBox});
  EXPECT_EQ(cellEdges(lattice.cellCorners).size(), 12U);
  for (const float x : {0.25F, 0.75F}) {
    for (const float y : {0.25F, 0.75F}) {
      for (const float z : {0.25F, 0.75F}) {
        points.emplace_back(x, y, z);
      }
    }
  }
  lattice = viscera::makeLattice(points, {viscera::LatticeOptions::Layout::uniform, {2, 2, 2}});
  const auto edges = cellEdges(lattice.cellCorners);
  EXPECT_EQ(edges.size(), 54U);
  for (const auto& [from, to] : edges) {
    const Vec3d along = lattice.controlPoints[to] - lattice.controlPoints[from];
    EXPECT_NEAR(along.cwiseAbs().maxCoeff(), along.norm(), 1e-12) << "an edge runs along an axis";
    EXPECT_NEAR(along.norm(), 0.5, 1e-6);
  }
}

TEST(OrganDrivers, ControlPointsAreThoseThatMoveTheOrgan) {
  for (const OrganModel model : {OrganModel::dynamicThesis, OrganModel::dynamic}) {
    const viscera::OrganRig& liver = rigOfLiver();
    const auto& [drivers, vertices, skin] = drivenLiver(model, "toe_touch@2");
    ASSERT_EQ(drivers.controlPoints.size(), liver.lattice.controlPoints.size());
    std::vector<Vec3f> offsets;
    for (std::size_t p = 0; p < drivers.controlPoints.size(); ++p) {
      offsets.push_back(drivers.controlPoints[p] - liver.lattice.controlPoints[p].cast<float>());
    }
    geometry::Positions again(vertices.size());
    viscera::deform(liver.rest.positions, liver.lattice, offsets, again, {});
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      ASSERT_LT((vertices[v] - again[v]).norm(), 1e-5F);
    }
  }
}

TEST(OrganDrivers, AtRestEverythingIsWhereItWasBound) {
  const viscera::OrganRig& liver = rigOfLiver();
  const OrganDrivers drivers = drivenLiver(OrganModel::dynamic, "rest").drivers;
  for (std::size_t p = 0; p < drivers.controlPoints.size(); ++p) {
    EXPECT_EQ(drivers.controlPoints[p], liver.lattice.controlPoints[p].cast<float>());
  }
  const auto& sites = sample().body->sites();
  ASSERT_EQ(drivers.sites.size(), drivers.layout->sites.size());
  for (std::size_t s = 0; s < drivers.sites.size(); ++s) {
    EXPECT_EQ(drivers.sites[s].frame.origin, sites[drivers.layout->sites[s]].rest.cast<float>());
  }
  EXPECT_EQ(drivers.sites.size() + drivers.otherSites.size(), sites.size());
}

TEST(OrganDrivers, AnchorsLieOnThePosedSkinAndFramesAreRightHanded) {
  const Driven driven = drivenLiver(OrganModel::dynamic, "belly_twist@1");
  const OrganDrivers& drivers = driven.drivers;
  raycast::Scene skin(raycast::SceneUse::manyRays);
  skin.add(driven.skin, sample().body->skinTopology());
  skin.build();
  ASSERT_FALSE(drivers.sites.empty());
  for (const DriverSite& site : drivers.sites) {
    for (const Vec3f& anchor : site.anchors) {
      const auto nearest = raycast::closestPoint(skin, anchor.cast<double>());
      ASSERT_TRUE(nearest);
      EXPECT_LT(nearest->distance, 1e-5);
    }
    const auto& [x, y, z] = site.frame.axes;
    EXPECT_NEAR(x.norm(), 1.0F, 1e-5F);
    EXPECT_NEAR(x.dot(y), 0.0F, 1e-5F);
    EXPECT_LT((x.cross(y) - z).norm(), 1e-5F);
  }
}

TEST(OrganDrivers, EverySiteThatCarriesAControlPointIsAmongThemOnce) {
  const viscera::OrganRig& liver = rigOfLiver();
  std::set<std::uint32_t> wanted;
  for (const viscera::SiteBlend& blend : liver.thesisDrivers) {
    wanted.insert(blend.site.begin(), blend.site.begin() + static_cast<std::ptrdiff_t>(blend.count));
  }
  const DriverLayout layout = driverLayout(sample(), indexOf("liver"), OrganModel::dynamicThesis);
  EXPECT_EQ(layout.sites, std::vector(wanted.begin(), wanted.end()));
}

TEST(OrganDrivers, OfASoftBodyAreTheCellsAroundTheOrganAndNoSite) {
  const analysis::LoadedStudy study = loaded(study::Deformer::softBody);
  ASSERT_NE(study.softBody, nullptr);
  const std::size_t liver = indexOf("liver");
  const auto layout = std::make_shared<const DriverLayout>(driverLayout(study, liver, OrganModel::dynamic));
  const viscera::Embedding& embedding = study.softBody->embedding(liver);
  for (const auto& [from, to] : layout->edges) {
    const Vec3d along = layout->softPlaces[to] - layout->softPlaces[from];
    ASSERT_NEAR(along.norm(), study.softBody->cell(), 1e-5);
    ASSERT_NEAR(along.cwiseAbs().maxCoeff(), along.norm(), 1e-5) << "an edge runs along an axis";
  }
  const analysis::PosedScene scene(study, {OrganModel::dynamic}, analysis::resolvePose(study, "toe_touch@2").pose,
                                   raycast::SceneUse::manyFrames, {});
  const OrganDrivers drivers = poseDrivers(study, liver, layout, scene, {});
  EXPECT_TRUE(drivers.sites.empty());
  EXPECT_EQ(drivers.otherSites.size(), study.body->sites().size());
  // The vertices, blended from the control points that are drawn, are where the organ is.
  for (std::size_t v = 0; v < scene.organ(liver, 0).size(); ++v) {
    Vec3d blend = Vec3d::Zero();
    for (std::size_t c = 0; c < 8; ++c) {
      const auto& corners = embedding.cellCorners[embedding.cellOf[v]];
      const auto local = std::lower_bound(layout->softPoints.begin(), layout->softPoints.end(), corners[c]) -
                         layout->softPoints.begin();
      double weight = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double share = embedding.fraction[v][axis];
        weight *= viscera::cornerDigits[c][static_cast<std::size_t>(axis)] == 1 ? share : 1.0 - share;
      }
      blend += weight * drivers.controlPoints[static_cast<std::size_t>(local)].cast<double>();
    }
    ASSERT_LT((blend - scene.organ(liver, 0)[v].cast<double>()).norm(), 1e-5);
  }
}

TEST(OrganDrivers, RigidOrgansHaveTheSiteOrTheJointThatCarriesThem) {
  const viscera::OrganRig& liver = rigOfLiver();
  const auto& [bySkin, bySkinVertices, skin] = drivenLiver(OrganModel::staticSkin, "toe_touch@2");
  EXPECT_TRUE(bySkin.controlPoints.empty());
  ASSERT_EQ(bySkin.sites.size(), 1U);
  EXPECT_NEAR((bySkin.sites[0].frame.origin - bySkinVertices[0]).norm(),
              (liver.reference.cast<float>() - liver.rest.positions[0]).norm(), 1e-4F)
      << "carried rigidly with the organ";

  const auto& [byJoint, byJointVertices, sameSkin] = drivenLiver(OrganModel::staticJoint, "toe_touch@2");
  EXPECT_TRUE(byJoint.sites.empty());
  ASSERT_TRUE(byJoint.joint);
  const human::Skeleton& skeleton = *sample().body->body().skeleton;
  EXPECT_EQ(byJoint.jointName, skeleton.joint(*liver.joint).name);
  EXPECT_NEAR((byJoint.joint->origin - byJointVertices[0]).norm(),
              (skeleton.restPosition(*liver.joint).cast<float>() - liver.rest.positions[0]).norm(), 1e-4F);
}

}  // namespace
}  // namespace lorica::jobs
