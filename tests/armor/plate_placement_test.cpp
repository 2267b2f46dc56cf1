#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lorica/base/error.h"
#include "lorica/geometry/primitives.h"
#include "lorica/geometry/transform.h"
#include "lorica/manikin/human.h"
#include "plate_checks.h"

namespace lorica::armor {
namespace {

const manikin::Body& person() {
  static const manikin::Body body = manikin::keptHuman({}, {}).body;
  return body;
}

bool hasSeverity(const base::Issues& issues, base::Severity severity) {
  return std::any_of(issues.begin(), issues.end(),
                     [&](const base::Issue& issue) { return issue.severity == severity; });
}

/// The suprasternal notch: 0.0029 of stature above the sternoclavicular joint.
double notchOfPerson() {
  return person().skeleton.restPosition(*person().skeleton.find("sternoclavicular_L")).y() + 0.0029 * 1.755;
}

class PlateOnTheBuiltInHuman : public testing::TestWithParam<PlateSide> {
 protected:
  PlacedPlate placed_ = placePlate(person().skin, &person().skeleton, GetParam(), mediumSapi());
};
INSTANTIATE_TEST_SUITE_P(Sides, PlateOnTheBuiltInHuman, testing::Values(PlateSide::front, PlateSide::back),
                         [](const auto& name) { return name.param == PlateSide::front ? "Front" : "Back"; });

TEST_P(PlateOnTheBuiltInHuman, RaisesNoIssue) {
  EXPECT_TRUE(placed_.issues.empty()) << placed_.issues.front().line();
}

TEST_P(PlateOnTheBuiltInHuman, LeavesTheSkinFree) {
  expectOutside(placed_.mesh, person().skin);
}

TEST_P(PlateOnTheBuiltInHuman, KeepsItsClearanceAndLiesFlat) {
  const Gaps gaps = gapsBehind(placed_.mesh, person().skin, GetParam());
  EXPECT_GT(gaps.smallest, 0.0075);
  EXPECT_LT(gaps.smallest, 0.015);
  EXPECT_LT(gaps.largest, 0.080);
}

TEST_P(PlateOnTheBuiltInHuman, HasItsTopEdgeTwentyMillimetresBelowTheNotch) {
  EXPECT_NEAR(topY(placed_.mesh), notchOfPerson() - 0.020, 0.001);
}

TEST_P(PlateOnTheBuiltInHuman, IsCentredOnTheMidline) {
  EXPECT_NEAR(middleX(placed_.mesh), 0.0, 0.002);
}

TEST_P(PlateOnTheBuiltInHuman, FacesAwayFromTheBody) {
  EXPECT_GT((GetParam() == PlateSide::front ? 1.0 : -1.0) * meanOutwardZ(placed_.mesh, GetParam()), 0.9);
  const double z = geometry::centroid(placed_.mesh).z();
  EXPECT_GT(GetParam() == PlateSide::front ? z : -z, 0.08);
}

TEST_P(PlateOnTheBuiltInHuman, IsTheSpecsPlateMovedRigidly) {
  const geometry::TriangleMesh own = plate(mediumSapi());
  ASSERT_EQ(own.triangles, placed_.mesh.triangles);
  const auto distance = [](const geometry::TriangleMesh& mesh, std::size_t a, std::size_t b) {
    return (mesh.positions[a] - mesh.positions[b]).cast<double>().norm();
  };
  for (std::size_t v = 1; v < own.positions.size(); v += 37) {
    EXPECT_NEAR(distance(placed_.mesh, 0, v), distance(own, 0, v), 1e-6);
  }
  EXPECT_NEAR(geometry::signedVolume(placed_.mesh), geometry::signedVolume(own), 1e-8);
}

TEST_P(PlateOnTheBuiltInHuman, MovesWithTheBody) {
  const Vec3d move(0.3, -0.9, 0.2);
  geometry::TriangleMesh moved = person().skin;
  for (auto& p : moved.positions) {
    p += move.cast<float>();
  }
  const PlacedPlate without = placePlate(person().skin, nullptr, GetParam(), mediumSapi());
  const PlacedPlate there = placePlate(moved, nullptr, GetParam(), mediumSapi());
  for (std::size_t v = 0; v < there.mesh.positions.size(); ++v) {
    ASSERT_LT((there.mesh.positions[v] - without.mesh.positions[v] - move.cast<float>()).norm(), 0.003F);
  }
}

TEST_P(PlateOnTheBuiltInHuman, KeepsALargerClearanceWhenAsked) {
  PlatePlacement loose;
  loose.clearance = 0.020;
  const PlacedPlate placed = placePlate(person().skin, &person().skeleton, GetParam(), mediumSapi(), loose);
  const Gaps gaps = gapsBehind(placed.mesh, person().skin, GetParam());
  EXPECT_GT(gaps.smallest, 0.0195);
  EXPECT_LT(gaps.smallest, 0.030);
}

TEST(PlateLandmarks, WithoutASkeletonComeFromStatureAndSaySo) {
  const PlacedPlate placed = placePlate(person().skin, nullptr, PlateSide::front, mediumSapi());
  ASSERT_EQ(placed.issues.size(), 1u);
  EXPECT_EQ(placed.issues[0].severity, base::Severity::note);
  EXPECT_NE(placed.issues[0].text.find("0.8191"), std::string::npos);
  EXPECT_NEAR(topY(placed.mesh), 0.8191 * 1.755 - 0.020, 0.001);
}

human::Skeleton oneJoint(const std::string& name, const Vec3d& place) {
  human::Joint joint;
  joint.name = name;
  joint.rest.translation = place;
  return human::Skeleton({joint});
}

TEST(PlateLandmarks, ComeFromCollarBoneAndNeckJointsOfOtherSkeletons) {
  for (const char* name : {"clavicle.L", "LeftShoulder", "l_collar", "sternoclavicular_R"}) {
    const human::Skeleton skeleton = oneJoint(name, {0.02, 1.44, 0.0});
    const PlacedPlate placed = placePlate(person().skin, &skeleton, PlateSide::front, mediumSapi());
    EXPECT_TRUE(placed.issues.empty()) << name;
    EXPECT_NEAR(topY(placed.mesh), 1.44 + 0.0029 * 1.755 - 0.020, 0.001) << name;
  }
  for (const char* name : {"neck01", "Neck", "spine_C7T1"}) {
    const human::Skeleton skeleton = oneJoint(name, {0.0, 1.49, -0.03});
    const PlacedPlate placed = placePlate(person().skin, &skeleton, PlateSide::front, mediumSapi());
    EXPECT_TRUE(placed.issues.empty()) << name;
    EXPECT_NEAR(topY(placed.mesh), 1.49 - 0.0238 * 1.755 - 0.020, 0.001) << name;
  }
}

TEST(PlateLandmarks, IgnoreJointsThatAreNotPlausible) {
  // An arm's shoulder joint, a collar bone at hip height, a name nobody knows.
  for (const human::Skeleton& skeleton :
       {oneJoint("shoulder01.L", {0.18, 1.43, 0.0}), oneJoint("clavicle.L", {0.02, 0.9, 0.0}),
        oneJoint("Bone.007", {0.02, 1.43, 0.0})}) {
    const PlacedPlate placed = placePlate(person().skin, &skeleton, PlateSide::front, mediumSapi());
    EXPECT_TRUE(hasSeverity(placed.issues, base::Severity::note)) << skeleton.joints()[0].name;
    EXPECT_NEAR(topY(placed.mesh), 0.8191 * 1.755 - 0.020, 0.001) << skeleton.joints()[0].name;
  }
}

/// A slab 1.755 m tall that leans: its front is the plane z = 0.12 + slope * (y - 1.2).
geometry::TriangleMesh slab(double slope) {
  geometry::TriangleMesh mesh = geometry::box({-0.2, 0.0, -0.12}, {0.2, 1.755, 0.12});
  for (auto& p : mesh.positions) {
    p.z() += static_cast<float>(slope * (static_cast<double>(p.y()) - 1.2));
  }
  return mesh;
}

/// The plate bent about one axis only.
PlateSpec singleCurve() {
  PlateSpec spec = mediumSapi();
  spec.verticalCurvature = 0.0;
  return spec;
}

/// Where the plate's own y axis points: along the middle of its front face.
Vec3d uprightOf(const geometry::TriangleMesh& placed) {
  const geometry::TriangleMesh own = plate(singleCurve());
  std::vector<std::size_t> middle;
  for (std::size_t v = 0; v < own.positions.size(); ++v) {
    if (std::abs(own.positions[v].x()) < 1e-6F && own.positions[v].z() > 0.0F) {
      middle.push_back(v);
    }
  }
  return (placed.positions[middle.back()] - placed.positions[middle.front()]).cast<double>();
}

TEST(PlateFit, OnAFlatUprightChestStandsUprightAtItsClearance) {
  const PlacedPlate placed = placePlate(slab(0.0), nullptr, PlateSide::front, singleCurve());
  const auto box = geometry::bounds(placed.mesh.positions);
  EXPECT_NEAR(box.min().z(), 0.128, 1e-5);  // the side edges of the bent plate touch first
  EXPECT_NEAR(box.sizes().y(), singleCurve().height, 1e-5);
}

TEST(PlateFit, OnALeaningChestLeansWithIt) {
  for (const double slope : {-0.3, -0.1, 0.15, 0.3}) {
    for (const PlateSide side : {PlateSide::front, PlateSide::back}) {
      const geometry::TriangleMesh skin = slab(slope);
      const PlacedPlate placed = placePlate(skin, nullptr, side, singleCurve());
      const Vec3d up = uprightOf(placed.mesh);
      EXPECT_NEAR(up.z() / up.y(), slope, 0.01) << slope;
      EXPECT_NEAR(gapsBehind(placed.mesh, skin, side).smallest, 0.008, 0.0015) << slope;
    }
  }
}

TEST(PlateOnUnfitBodies, WarnsAboutTheSizeAndStillPlaces) {
  geometry::TriangleMesh small = person().skin;
  for (auto& p : small.positions) {
    p *= 0.5F;
  }
  const PlacedPlate placed = placePlate(small, nullptr, PlateSide::front, mediumSapi());
  EXPECT_TRUE(hasSeverity(placed.issues, base::Severity::warning));
  EXPECT_NEAR(topY(placed.mesh), 0.8191 * 0.5 * 1.755 - 0.020, 0.001);
  expectOutside(placed.mesh, small);
}

TEST(PlateOnUnfitBodies, WarnsAboutALyingBody) {
  geometry::TriangleMesh lying = person().skin;
  for (auto& p : lying.positions) {
    p = {p.x(), -p.z(), p.y()};
  }
  const PlacedPlate placed = placePlate(lying, nullptr, PlateSide::front, mediumSapi());
  EXPECT_TRUE(hasSeverity(placed.issues, base::Severity::warning));
  for (const auto& p : placed.mesh.positions) {
    ASSERT_TRUE(p.allFinite());
  }
}

TEST(PlateOnUnfitBodies, WarnsWhenThereIsNoSkinBehindThePlate) {
  geometry::TriangleMesh gap = geometry::box({-0.2, 0.0, -0.1}, {0.2, 0.4, 0.1});
  geometry::append(gap, geometry::box({-0.1, 1.6, -0.1}, {0.1, 1.755, 0.1}));
  for (const PlateSide side : {PlateSide::front, PlateSide::back}) {
    const PlacedPlate placed = placePlate(gap, nullptr, side, mediumSapi());
    EXPECT_TRUE(hasSeverity(placed.issues, base::Severity::warning));
    const auto box = geometry::bounds(placed.mesh.positions);
    EXPECT_GT(side == PlateSide::front ? box.min().z() : -box.max().z(), 0.1);
    EXPECT_NEAR(box.max().y(), 0.8191 * 1.755 - 0.020, 0.001);
  }
}

TEST(PlateOnUnfitBodies, RefusesASkinWithoutTriangles) {
  EXPECT_THROW(placePlate({}, nullptr, PlateSide::front, mediumSapi()), base::CallerError);
}

/// A trunk without arms: an ellipsoid wider than deep, of a person's height.
geometry::TriangleMesh column() {
  return geometry::ellipsoid(Vec3d(0.01, 0.9, -0.02), Vec3d(0.18, 0.9, 0.12), 5);
}

TEST(PlateBeside, LiesOnEachSideWithItsTopWhereItIsAsked) {
  PlateSpec spec = mediumSapi();
  spec.width = 0.152;
  spec.height = 0.203;
  spec.topWidth = 0.12;
  spec.cornerHeight = 0.015;
  spec.curvatureRadius = 0.22;
  PlatePlacement placement;
  placement.clearance = 0.003;
  placement.top = 1.1;
  const PlacedPlate left = placePlate(column(), nullptr, PlateSide::left, spec, placement);
  const PlacedPlate right = placePlate(column(), nullptr, PlateSide::right, spec, placement);
  EXPECT_TRUE(left.issues.empty());
  for (const PlacedPlate* placed : {&left, &right}) {
    EXPECT_NEAR(topY(placed->mesh), 1.1, 1e-6);
    expectOutside(placed->mesh, column());
    EXPECT_GT(distanceTo(column(), placed->mesh.positions.front().cast<double>()), 0.0025);
  }
  EXPECT_GT(middleX(left.mesh), 0.18);
  EXPECT_LT(middleX(right.mesh), -0.16);
  EXPECT_NEAR(geometry::bounds(left.mesh.positions).center().z(), -0.02, 0.003);
  EXPECT_NEAR(middleX(left.mesh) - 0.01, 0.01 - middleX(right.mesh), 0.002);
}

TEST(PlateBeside, TellsHowThePlateWasMoved) {
  const PlateSpec spec = mediumSapi();
  for (const PlateSide side : {PlateSide::front, PlateSide::back, PlateSide::left, PlateSide::right}) {
    const PlacedPlate placed = placePlate(column(), nullptr, side, spec);
    const auto moved = geometry::transformed(plate(spec).positions, placed.place);
    for (std::size_t v = 0; v < moved.size(); v += 50) {
      EXPECT_LT((moved[v] - placed.mesh.positions[v]).norm(), 1e-6F);
    }
  }
}

}  // namespace
}  // namespace lorica::armor
