#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lorica/io/import.h"
#include "plate_checks.h"
#include "real_data.h"

namespace lorica::armor {
namespace {

struct Body {
  const char* file;
  const char* left;  ///< collar-bone joints: the midline runs between them, the notch lies just above
  const char* right;
};

class PlateOnARealBody : public testing::TestWithParam<Body> {};
INSTANTIATE_TEST_SUITE_P(Bodies, PlateOnARealBody,
                         testing::Values(Body{"visible-human-male/body.glb", "sternoclavicular_L",
                                              "sternoclavicular_R"},
                                         Body{"makehuman-male/body.glb", "clavicle.L", "clavicle.R"}));

/// The largest part is the body; eyes, teeth and lashes may stand beside it.
const geometry::TriangleMesh& largestPart(const io::Model& model) {
  return std::max_element(
             model.parts.begin(), model.parts.end(),
             [](const auto& a, const auto& b) { return a.mesh.triangles.size() < b.mesh.triangles.size(); })
      ->mesh;
}

TEST_P(PlateOnARealBody, LiesOutsideNearTheSkinBelowTheNotchOnTheMidline) {
  LORICA_NEEDS_REAL_DATA(GetParam().file);
  const io::Model model = io::importModel(test::realData() / GetParam().file);
  const geometry::TriangleMesh& skin = largestPart(model);
  ASSERT_TRUE(model.skeleton);
  const Vec3d collar = 0.5 * (model.skeleton->restPosition(*model.skeleton->find(GetParam().left)) +
                              model.skeleton->restPosition(*model.skeleton->find(GetParam().right)));
  const auto box = geometry::bounds(skin.positions);
  const double notch = collar.y() + 0.0029 * box.sizes().y();
  for (const PlateSide side : {PlateSide::front, PlateSide::back}) {
    SCOPED_TRACE(side == PlateSide::front ? "front" : "back");
    const PlacedPlate placed = placePlate(skin, &*model.skeleton, side, mediumSapi());
    EXPECT_TRUE(placed.issues.empty());
    expectOutside(placed.mesh, skin);
    const Gaps gaps = gapsBehind(placed.mesh, skin, side);
    EXPECT_GT(gaps.smallest, 0.002);
    EXPECT_LT(gaps.smallest, 0.030);
    EXPECT_LT(gaps.largest, 0.080);
    EXPECT_LT(topY(placed.mesh), notch - 0.015);
    EXPECT_GT(topY(placed.mesh), notch - 0.035);
    EXPECT_NEAR(middleX(placed.mesh), collar.x(), 0.010);
    EXPECT_GT((side == PlateSide::front ? 1.0 : -1.0) * meanOutwardZ(placed.mesh, side), 0.85);
  }
}

}  // namespace
}  // namespace lorica::armor
