#include "lorica/threat/field_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fields.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"

namespace lorica::threat {
namespace {

using geometry::Vec3d;

constexpr double radius = 0.4;

/// Greater than 0 inside a ball of 0.4 m around (0.05, 1, -0.02).
double ball(const Vec3d& p, double) {
  return radius - (p - Vec3d(0.05, 1.0, -0.02)).norm();
}

double ballVolume() {
  return 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
}

FieldSampler ballOnLattice(double spacing) {
  const auto count = static_cast<std::size_t>(std::ceil(1.2 / spacing)) + 1;
  return FieldSampler(std::make_shared<const ThreatField>(latticeField(
      {{planes(-0.6, spacing, count), planes(0.4, spacing, count), planes(-0.6, spacing, count)}}, {0.0}, ball)));
}

TEST(LevelSurface, OfABallIsClosedFacesOutwardsAndHasItsVolume) {
  const FieldSampler sampler = ballOnLattice(0.03);
  LevelOptions plain;
  plain.smoothing.rounds = 0;
  for (const LevelOptions& options : {plain, LevelOptions()}) {
    const ColouredSurface surface = levelSurface(sampler, 0, 0.0, 0.0, options);
    EXPECT_TRUE(geometry::audit(surface.mesh).closed());
    // A flat triangle cuts off a cap: its height is a cell squared over eight radii, 0.3 mm.
    EXPECT_NEAR(geometry::signedVolume(surface.mesh) / ballVolume(), 1.0, 0.005);
    for (const geometry::Vec3f& place : surface.mesh.positions) {
      EXPECT_NEAR(ball(place.cast<double>(), 0.0), 0.0, 0.001);
    }
    ASSERT_EQ(surface.values.size(), surface.mesh.positions.size());
    for (const float value : surface.values) {
      EXPECT_NEAR(value, 0.0F, 0.001F);
    }
  }
}

TEST(LevelSurface, ShrinksByLessThanAHundredthWhenSmoothed) {
  // A rough ball: noise of half a cell on the values.
  Numbers numbers;
  const auto rough = [&](const Vec3d& p, double t) { return ball(p, t) + 0.02 * (numbers.next() - 0.5); };
  const FieldSampler sampler(std::make_shared<const ThreatField>(
      latticeField({{planes(-0.6, 0.04, 31), planes(0.4, 0.04, 31), planes(-0.6, 0.04, 31)}}, {0.0}, rough)));
  LevelOptions options;
  options.smoothing.rounds = 0;
  const geometry::TriangleMesh before = levelSurface(sampler, 0, 0.0, 0.0, options).mesh;
  options.smoothing.rounds = 50;
  const geometry::TriangleMesh after = levelSurface(sampler, 0, 0.0, 0.0, options).mesh;
  EXPECT_NEAR(geometry::signedVolume(after) / geometry::signedVolume(before), 1.0, 0.01);
  const double smooth = 4.0 * std::numbers::pi * radius * radius;
  EXPECT_LT(std::abs(geometry::area(after) - smooth), 0.3 * (geometry::area(before) - smooth)) << "and it is smoother";
}

TEST(LevelSurface, IsClosedAlongTheEndOfTheData) {
  const FieldSampler sampler(std::make_shared<const ThreatField>(
      latticeField({{planes(0.0, 0.1, 11), planes(0.0, 0.1, 11), planes(0.0, 0.1, 11)}}, {0.0},
                   [](const Vec3d& p, double) { return p.x(); })));
  LevelOptions options;
  options.smoothing.rounds = 0;
  const geometry::TriangleMesh mesh = levelSurface(sampler, 0, 0.0, 0.25, options).mesh;
  EXPECT_TRUE(geometry::audit(mesh).closed());
  EXPECT_NEAR(geometry::signedVolume(mesh), 0.75, 0.75 * 0.06) << "a tenth of a cell at each of the five ends at most";
}

TEST(LevelSurface, OfScatteredPointsIsNearTheBall) {
  Numbers numbers;
  geometry::Positions points;
  for (const geometry::Vec3f& p : numbers.places(20000, -0.6, 0.6)) {
    points.emplace_back(p + geometry::Vec3f(0.0F, 1.0F, 0.0F));
  }
  ThreatField field = pointField(points, {0.0}, ball);
  field.attributes.push_back({"height", "m"});
  std::vector<float>& heights = field.steps[0].values.emplace_back();
  for (const geometry::Vec3f& p : points) {
    heights.push_back(p.y());
  }
  const FieldSampler sampler(std::make_shared<const ThreatField>(std::move(field)));
  LevelOptions options;
  options.spacing = 0.05;
  options.colour = 1;
  const ColouredSurface surface = levelSurface(sampler, 0, 0.0, 0.0, options);
  EXPECT_TRUE(geometry::audit(surface.mesh).closed());
  EXPECT_NEAR(geometry::signedVolume(surface.mesh) / ballVolume(), 1.0, 0.03);
  for (std::size_t v = 0; v < surface.values.size(); ++v) {
    EXPECT_NEAR(surface.values[v], surface.mesh.positions[v].y(), 0.05F) << "coloured by the other attribute";
  }
}

TEST(LevelSurface, WhereNothingExceedsTheLevelThereIsNone) {
  EXPECT_TRUE(levelSurface(ballOnLattice(0.1), 0, 0.0, 5.0).mesh.triangles.empty());
}

TEST(LevelSurface, RefusesASpacingThatIsTooFine) {
  LevelOptions options;
  options.spacing = 1e-4;
  EXPECT_THROW(levelSurface(ballOnLattice(0.1), 0, 0.0, 0.0, options), base::InputError);
  EXPECT_THROW(slice(ballOnLattice(0.1), 0, 0.0, {Vec3d(0.0, 1.0, 0.0), Vec3d::UnitY()}, 1e-5), base::InputError);
}

TEST(Slice, HasTheFieldsValuesOnThePlaneAndCoversTheBox) {
  const FieldSampler sampler = ballOnLattice(0.1);
  for (const Vec3d& normal : {Vec3d(0.0, 2.0, 0.0), Vec3d(1.0, 0.0, 0.0), Vec3d(0.3, -0.5, 0.8)}) {
    const Plane plane{{0.02, 0.97, 0.05}, normal};
    const ColouredSurface cut = slice(sampler, 0, 0.0, plane, 0.03);
    ASSERT_FALSE(cut.mesh.triangles.empty());
    for (std::size_t v = 0; v < cut.values.size(); ++v) {
      const Vec3d place = cut.mesh.positions[v].cast<double>();
      EXPECT_NEAR((place - plane.point).dot(normal.normalized()), 0.0, 1e-6);
      EXPECT_EQ(cut.values[v], static_cast<float>(sampler.value(place, 0.0, 0).value()));
    }
    if (normal.cwiseAbs().maxCoeff() > 0.9) {
      EXPECT_NEAR(geometry::area(cut.mesh), 1.44, 1e-4);
      EXPECT_GT(geometry::vertexNormals(cut.mesh.positions, cut.mesh.triangles)[0].cast<double>().dot(normal), 0.9);
    }
  }
}

TEST(Slice, MissesWhatIsElsewhere) {
  EXPECT_TRUE(slice(ballOnLattice(0.1), 0, 0.0, {Vec3d(0.0, 5.0, 0.0), Vec3d::UnitY()}, 0.05).mesh.triangles.empty());
  const FieldSampler timed(std::make_shared<const ThreatField>(
      latticeField({{planes(0.0, 1.0, 2), planes(0.0, 1.0, 2), planes(0.0, 1.0, 2)}}, {0.0, 1.0}, ball)));
  EXPECT_TRUE(slice(timed, 0, 2.0, {Vec3d(0.5, 0.5, 0.5), Vec3d::UnitY()}, 0.1).mesh.triangles.empty());
}

}  // namespace
}  // namespace lorica::threat
