#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "lorica/armor/plates.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/geometry/closest_point.h"
#include "lorica/geometry/intersections.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"

namespace lorica::armor {
namespace {

using geometry::Vec3d;

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

/// A number of the table by item, size, quantity and unit.
class PlateTable : public testing::Test {
 protected:
  static std::vector<std::string> row(const std::string& item, const std::string& size, const std::string& quantity,
                                      const std::string& unit) {
    std::istringstream table(base::readFile(std::string(LORICA_SOURCE_DIR) + "/resources/tables/plates.csv"));
    for (std::string line; std::getline(table, line);) {
      const auto cells = cellsOf(line);
      if (cells.size() == 8 && cells[0] == item && cells[1] == size && cells[2].starts_with(quantity) &&
          cells[4] == unit) {
        return cells;
      }
    }
    ADD_FAILURE() << "no row " << item << ", " << size << ", " << quantity << ", " << unit;
    return std::vector<std::string>(8, "0");
  }
  static double number(const std::string& item, const std::string& size, const std::string& quantity,
                       const std::string& unit) {
    return std::stod(row(item, size, quantity, unit)[3]);
  }
};

/// The plate bent about one axis only.
PlateSpec singleCurve() {
  PlateSpec spec = mediumSapi();
  spec.verticalCurvature = 0.0;
  return spec;
}

constexpr const char* kAnyPlate = "SAPI/ESAPI front or rear plate";

TEST_F(PlateTable, HoldsTheNumbersOfTheMediumPlate) {
  const PlateSpec spec = mediumSapi();
  EXPECT_DOUBLE_EQ(spec.width, number(kAnyPlate, "M", "width", "mm") / 1000.0);
  EXPECT_DOUBLE_EQ(spec.height, number(kAnyPlate, "M", "height", "mm") / 1000.0);
  EXPECT_DOUBLE_EQ(spec.thickness, number("SAPI plate", "all", "thickness", "mm") / 1000.0);
  EXPECT_DOUBLE_EQ(spec.mass, number("SAPI plate", "M", "mass", "kg"));
  EXPECT_DOUBLE_EQ(spec.curvatureRadius,
                   number("SAPI/ESAPI plate", "all", "curvature radius horizontal", "mm") / 1000.0);
  EXPECT_DOUBLE_EQ(1.0 / spec.verticalCurvature,
                   number("SAPI/ESAPI plate", "all", "curvature radius vertical", "mm") / 1000.0);
}

TEST_F(PlateTable, SaysThatMassAndThicknessAreFromMemoryAndSoDoesTheSpec) {
  EXPECT_NE(row("SAPI plate", "M", "mass", "kg")[6].find("unverified"), std::string::npos);
  EXPECT_NE(row("SAPI plate", "all", "thickness", "mm")[6].find("unverified"), std::string::npos);
  EXPECT_NE(mediumSapi().source.find("mass from memory, unverified"), std::string::npos);
}

TEST_F(PlateTable, AreaOfTheOutlineIsWithinFivePerCentOfTheTable) {
  const double table = number(kAnyPlate, "M", "area", "cm2") * 1e-4;
  EXPECT_NEAR(frontalArea(mediumSapi()), table, 0.05 * table);
}

TEST_F(PlateTable, CornersAreCutAsTheTableNotes) {
  // "upper corners cut 45 deg; top edge about 60-65 % of width; cut about 50-60 mm high"
  const PlateSpec spec = mediumSapi();
  EXPECT_GE(spec.topWidth / spec.width, 0.60 - 1e-12);
  EXPECT_LE(spec.topWidth / spec.width, 0.65);
  EXPECT_GE(spec.cornerHeight, 0.050);
  EXPECT_LE(spec.cornerHeight, 0.060);
  const double angle = std::atan2(spec.cornerHeight, 0.5 * (spec.width - spec.topWidth)) * 180.0 / 3.14159265358979;
  EXPECT_NEAR(angle, 45.0, 3.0);
}

TEST(Plate, IsOneClosedManifoldOutwardPieceOfAboutTwoThousandEvenTriangles) {
  const geometry::TriangleMesh mesh = plate(mediumSapi());
  const geometry::MeshAudit audit = geometry::audit(mesh);
  EXPECT_EQ(audit.components.size(), 1u);
  EXPECT_TRUE(audit.closed());
  EXPECT_EQ(audit.oddEdges, 0u);
  EXPECT_EQ(audit.degenerateTriangles, 0u);
  EXPECT_GT(geometry::signedVolume(mesh), 0.0);
  EXPECT_GE(mesh.triangles.size(), 1000u);
  EXPECT_LE(mesh.triangles.size(), 3000u);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const double edge = (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).norm();
      ASSERT_GT(edge, 0.006);
      ASSERT_LT(edge, 0.030);
    }
  }
}

TEST(Plate, HasTheWidthHeightAndTopEdgeOfItsSpecAboutItsOrigin) {
  const PlateSpec spec = singleCurve();
  const geometry::TriangleMesh mesh = plate(spec);
  const auto box = geometry::bounds(mesh.positions);
  EXPECT_NEAR(box.sizes().x(), spec.width, 1e-6);
  EXPECT_NEAR(box.sizes().y(), spec.height, 1e-6);
  EXPECT_NEAR(box.center().norm(), 0.0, 1e-6);
  double top = 0.0;
  double atCorner = 0.0;
  for (const auto& p : mesh.positions) {
    if (static_cast<double>(p.y()) > 0.5 * spec.height - 1e-6) {
      top = std::max(top, static_cast<double>(p.x()));
    }
    if (std::abs(static_cast<double>(p.y()) - (0.5 * spec.height - spec.cornerHeight)) < 1e-6) {
      atCorner = std::max(atCorner, static_cast<double>(p.x()));
    }
  }
  EXPECT_NEAR(2.0 * top, spec.topWidth, 1e-6);
  EXPECT_NEAR(2.0 * atCorner, spec.width, 1e-6);
}

TEST(Plate, SeenFromTheFrontCoversTheFrontalArea) {
  const PlateSpec spec = singleCurve();
  const geometry::TriangleMesh mesh = plate(spec);
  double seen = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d normal = (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
    seen += 0.5 * std::max(normal.z(), 0.0);
  }
  EXPECT_NEAR(seen, frontalArea(spec), 1e-4 * frontalArea(spec));
}

TEST(Plate, HasTheVolumeOfABentSlab) {
  // Sum over heights of the ring sector between the two radii, by Simpson's rule on the trapezoid above the corners.
  const PlateSpec spec = singleCurve();
  const double r = spec.curvatureRadius;
  const auto section = [&](double width) {
    return std::asin(0.5 * width / r) * (r * r - (r - spec.thickness) * (r - spec.thickness));
  };
  const double expected =
      section(spec.width) * (spec.height - spec.cornerHeight) +
      spec.cornerHeight / 6.0 *
          (section(spec.width) + 4.0 * section(0.5 * (spec.width + spec.topWidth)) + section(spec.topWidth));
  EXPECT_NEAR(geometry::signedVolume(plate(spec)), expected, 2e-3 * expected);
}

TEST(Plate, FrontFaceIsConvexTowardsPlusZWithTheSpecsRadius) {
  const PlateSpec spec = singleCurve();
  const geometry::TriangleMesh mesh = plate(spec);
  const auto box = geometry::bounds(mesh.positions);
  const double axis = box.max().z() - spec.curvatureRadius;
  std::size_t onFront = 0;
  for (const auto& p : mesh.positions) {
    const double radius = std::hypot(static_cast<double>(p.x()), static_cast<double>(p.z()) - axis);
    const bool front = std::abs(radius - spec.curvatureRadius) < 1e-6;
    const bool back = std::abs(radius - spec.curvatureRadius + spec.thickness) < 1e-6;
    ASSERT_TRUE(front || back);
    onFront += front ? 1 : 0;
  }
  EXPECT_EQ(2 * onFront, mesh.positions.size());
}

TEST(Plate, BentBothWaysHasItsRadiiOnItsMiddleLinesAndItsThicknessEverywhere) {
  const PlateSpec spec = mediumSapi();
  ASSERT_GT(spec.verticalCurvature, 0.0);
  const geometry::TriangleMesh mesh = plate(spec);
  // No row of vertices lies at half the height, so the box ends some micrometres before the face does.
  const double foremost = geometry::bounds(mesh.positions).max().z();
  const double axis = foremost - 1.0 / spec.verticalCurvature;
  // A torus: the points of a face are equally far from the circle that the middles of its horizontal arcs run on.
  const double ring = 1.0 / spec.verticalCurvature - spec.curvatureRadius;
  std::size_t onFront = 0;
  for (const auto& p : mesh.positions) {
    const double around = std::hypot(static_cast<double>(p.y()), static_cast<double>(p.z()) - axis);
    const double radius = std::hypot(static_cast<double>(p.x()), around - ring);
    const bool front = std::abs(radius - spec.curvatureRadius) < 1e-5;
    ASSERT_TRUE(front || std::abs(radius - spec.curvatureRadius + spec.thickness) < 1e-5);
    onFront += front ? 1 : 0;
  }
  EXPECT_EQ(2 * onFront, mesh.positions.size());
}

TEST(Plate, IsItsOwnMirrorImage) {
  const geometry::TriangleMesh mesh = plate(mediumSapi());
  EXPECT_NEAR(geometry::centroid(mesh).x(), 0.0, 1e-7);
}

TEST(Plate, RefusesSpecsThatAreNoPlate) {
  PlateSpec flat = mediumSapi();
  flat.thickness = 0.0;
  EXPECT_THROW(plate(flat), base::CallerError);
  PlateSpec wideTop = mediumSapi();
  wideTop.topWidth = 2.0 * wideTop.width;
  EXPECT_THROW(plate(wideTop), base::CallerError);
  PlateSpec tube = mediumSapi();
  tube.curvatureRadius = 0.1;
  EXPECT_THROW(plate(tube), base::CallerError);
}

void expectSound(const geometry::TriangleMesh& mesh) {
  const geometry::MeshAudit audit = geometry::audit(mesh);
  EXPECT_TRUE(audit.closed());
  EXPECT_EQ(audit.components.size(), 1U);
  EXPECT_EQ(audit.oddEdges, 0U);
  EXPECT_EQ(audit.degenerateTriangles, 0U);
  EXPECT_GT(geometry::signedVolume(mesh), 0.0);
  EXPECT_TRUE(geometry::selfIntersections(mesh, base::Threads{2}).empty());
}

TEST(PlateCover, IsAShellAroundThePlateThatLeavesItFree) {
  const PlateSpec spec = mediumSapi();
  const geometry::TriangleMesh inside = plate(spec);
  const geometry::TriangleMesh cover = plateCover(spec, 0.002, 0.003);
  expectSound(cover);
  EXPECT_TRUE(geometry::intersections(cover, inside, base::Threads{2}).empty());
  // Front face and edges, 3 mm thick.
  const double faces = frontalArea(spec) * 1.016 + 2.0 * (spec.width + spec.height) * 0.9 * spec.thickness;
  EXPECT_NEAR(geometry::signedVolume(cover), 0.003 * faces, 0.1 * 0.003 * faces);
  const geometry::ClosestPointTree shell(cover);
  for (const geometry::Vec3f& position : inside.positions) {
    const double distance = shell.signedDistance(position.cast<double>());
    EXPECT_GT(distance, 0.0014);  // 2 mm; a little less along chords of the bent face
  }
  EXPECT_GT(geometry::bounds(cover.positions).max().z(), geometry::bounds(inside.positions).max().z() + 0.0049);
}

TEST(BoxOnPlate, LiesOnTheFrontFaceAndIsBentWithIt) {
  const PlateSpec spec = singleCurve();
  const geometry::TriangleMesh box = boxOnPlate(spec, -0.04, 0.03, 0.02, 0.145, 0.004, 0.034);
  expectSound(box);
  EXPECT_TRUE(geometry::intersections(box, plate(spec), base::Threads{2}).empty());
  const double middleRadius = spec.curvatureRadius + 0.019;
  EXPECT_NEAR(geometry::signedVolume(box), 0.07 * middleRadius / spec.curvatureRadius * 0.125 * 0.03, 1e-6);
  EXPECT_NEAR(geometry::bounds(box.positions).min().y(), 0.02 - 0.5 * spec.height, 1e-6);
}

}  // namespace
}  // namespace lorica::armor
