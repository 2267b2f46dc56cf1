#include "lorica/threat/field_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fields.h"

namespace lorica::threat {
namespace {

using geometry::Vec3d;
using geometry::Vec3f;

double linear(const Vec3d& p, double t) {
  return 3.0 + 2.0 * p.x() - 5.0 * p.y() + 0.5 * p.z() + 7.0 * t;
}

FieldSampler samplerOf(ThreatField field, const SamplerOptions& options = {}) {
  return FieldSampler(std::make_shared<const ThreatField>(std::move(field)), options);
}

TEST(FieldSampler, MeetsWhatIsLinearInSpaceAndTimeOnALattice) {
  // Planes at uneven distances.
  const FieldSampler sampler =
      samplerOf(latticeField({{{{-1.0, -0.5, 0.75, 2.0}, {0.0, 1.0}, {3.0, 3.25, 4.0}}}}, {0.0, 0.5, 2.0}, linear));
  Numbers numbers;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d place(-1.0 + 3.0 * numbers.next(), numbers.next(), 3.0 + numbers.next());
    const double time = 2.0 * numbers.next();
    const std::optional<double> value = sampler.value(place, time, 0);
    ASSERT_TRUE(value);
    EXPECT_NEAR(*value, linear(place, time), 4e-6) << "floats of size 30 have steps of 2e-6";
  }
}

TEST(FieldSampler, HasTheLatticesOwnValuesAtItsPointsAndAtItsEnds) {
  const Lattice lattice{{planes(0.1, 0.1, 5), planes(-0.3, 0.15, 4), planes(1.7, 0.01, 3)}};
  const ThreatField field = latticeField(lattice, {0.0}, [](const Vec3d& p, double) { return p.x() * p.y() + p.z(); });
  const FieldSampler sampler = samplerOf(field);
  for (std::size_t p = 0; p < lattice.points(); ++p) {
    EXPECT_NEAR(sampler.value(lattice.place(p), 9.0, 0).value(), static_cast<double>(field.steps[0].values[0][p]),
                1e-7);
  }
}

TEST(FieldSampler, HasNoValueOutsideALatticeOrItsTimes) {
  const FieldSampler sampler =
      samplerOf(latticeField({{planes(0.0, 1.0, 3), planes(0.0, 1.0, 3), planes(0.0, 1.0, 3)}}, {1.0, 2.0}, linear));
  EXPECT_TRUE(sampler.value({0.0, 2.0, 1.0}, 1.0, 0));
  EXPECT_FALSE(sampler.value({-0.001, 2.0, 1.0}, 1.0, 0));
  EXPECT_FALSE(sampler.value({0.0, 2.001, 1.0}, 1.0, 0));
  EXPECT_FALSE(sampler.value({0.0, 2.0, 1.0}, 0.999, 0));
  EXPECT_FALSE(sampler.value({0.0, 2.0, 1.0}, 2.001, 0));
  EXPECT_TRUE(std::isnan(sampler.values(std::vector<Vec3f>{{5.0F, 0.0F, 0.0F}}, 1.0, 0)[0]));
}

TEST(FieldSampler, HasNoValueBesideALatticePointWithoutOne) {
  ThreatField field = latticeField({{planes(0.0, 1.0, 3), planes(0.0, 1.0, 3), planes(0.0, 1.0, 3)}}, {0.0}, linear);
  field.steps[0].values[0][0] = std::numeric_limits<float>::quiet_NaN();
  const FieldSampler sampler = samplerOf(std::move(field));
  EXPECT_FALSE(sampler.value({0.5, 0.5, 0.5}, 0.0, 0));
  EXPECT_TRUE(sampler.value({1.5, 0.5, 0.5}, 0.0, 0));
  EXPECT_TRUE(sampler.value({1.0, 0.0, 0.0}, 0.0, 0)) << "on the far side of the cell the lacking point weighs nothing";
}

TEST(FieldSampler, FollowsThePlacement) {
  ThreatField field = latticeField({{planes(0.0, 0.5, 5), planes(0.0, 0.5, 5), planes(0.0, 0.5, 5)}}, {0.0}, linear);
  field.attributes.push_back({"velocity", "m/s", 3});
  std::vector<float>& vectors = field.steps[0].values.emplace_back(3 * field.points(0), 0.0F);
  for (std::size_t p = 0; p < field.points(0); ++p) {
    vectors[3 * p] = 2.0F;
  }
  field.placement.rotation = Eigen::AngleAxisd(0.7, Vec3d(1.0, 2.0, -0.5).normalized());
  field.placement.translation = {10.0, -3.0, 2.0};
  const geometry::RigidTransform placement = field.placement;
  const FieldSampler sampler = samplerOf(std::move(field));
  const Vec3d own(0.3, 1.1, 1.9);
  EXPECT_NEAR(sampler.value(placement * own, 0.0, 0).value(), linear(own, 0.0), 2e-6);
  EXPECT_FALSE(sampler.value(own, 0.0, 0));
  EXPECT_NEAR(sampler.value(placement * own, 0.0, 1).value(), 2.0, 1e-12);
  const Vec3d turned = placement.rotation * Vec3d(2.0, 0.0, 0.0);
  EXPECT_LT((sampler.vector(placement * own, 0.0, 1).value() - turned).norm(), 1e-12);
}

/// The documented weights over neighbours found by looking at every point.
std::optional<double> bruteForce(const ThreatField& field, const Vec3d& place, std::size_t k, double radius) {
  std::vector<std::pair<double, double>> near;
  for (std::size_t p = 0; p < field.points(0); ++p) {
    near.emplace_back((field.place(0, p) - place).norm(), static_cast<double>(field.steps[0].values[0][p]));
  }
  std::sort(near.begin(), near.end());
  const double reach = near.size() > k ? std::min(radius, near[k].first) : radius;
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < std::min(k, near.size()) && near[i].first < reach; ++i) {
    const double weight = std::pow(1.0 / near[i].first - 1.0 / reach, 2);
    sum += weight * near[i].second;
    weights += weight;
  }
  return weights > 0.0 ? std::optional(sum / weights) : std::nullopt;
}

TEST(FieldSampler, WeightsTheNearestOfScatteredPointsAsALookAtEveryPointDoes) {
  Numbers numbers;
  for (const std::size_t count : {1UL, 5UL, 40UL, 3000UL}) {
    // Half of the points in a lump: the tree must not be fooled by its bins.
    geometry::Positions points = numbers.places(count / 2 + 1, 0.0, 1.0);
    for (const Vec3f& place : numbers.places(count / 2, 0.4, 0.41)) {
      points.push_back(place);
    }
    const ThreatField field = pointField(points, {0.0}, linear);
    for (const std::size_t k : {1UL, 4UL, 8UL, 15UL}) {
      const FieldSampler sampler = samplerOf(field, {k, 0.15});
      for (int i = 0; i < 300; ++i) {
        const Vec3d place = i % 3 == 0 ? numbers.place(0.39, 0.42) : numbers.place(-0.2, 1.2);
        const std::optional<double> expected = bruteForce(field, place, k, 0.15);
        const std::optional<double> value = sampler.value(place, 0.0, 0);
        ASSERT_EQ(value.has_value(), expected.has_value()) << count << " points, " << k << " neighbours";
        if (value) {
          EXPECT_NEAR(*value, *expected, 1e-9);
        }
      }
    }
  }
}

TEST(FieldSampler, ScatteredPointsKeepConstantsOwnValuesAndRange) {
  Numbers numbers;
  const ThreatField field = pointField(numbers.places(500, 0.0, 1.0), {0.0}, linear);
  const FieldSampler sampler = samplerOf(field);
  const FieldSampler constant =
      samplerOf(pointField(*field.steps[0].points, {0.0}, [](auto&&, double) { return 4.0; }));
  const auto [low, high] = std::minmax_element(field.steps[0].values[0].begin(), field.steps[0].values[0].end());
  for (std::size_t p = 0; p < field.points(0); ++p) {
    EXPECT_EQ(sampler.value(field.place(0, p), 0.0, 0).value(), static_cast<double>(field.steps[0].values[0][p]));
  }
  for (int i = 0; i < 500; ++i) {
    const Vec3d place = numbers.place(0.0, 1.0);
    EXPECT_NEAR(constant.value(place, 0.0, 0).value(), 4.0, 1e-12);
    const double value = sampler.value(place, 0.0, 0).value();
    EXPECT_GE(value, static_cast<double>(*low) - 1e-9);
    EXPECT_LE(value, static_cast<double>(*high) + 1e-9);
    // The stated bound: the gradient's size is 5.41, and no neighbour is farther than the radius.
    EXPECT_LE(std::abs(value - linear(place, 0.0)), 5.41 * sampler.radius());
  }
}

TEST(FieldSampler, ScatteredValuesChangeContinuously) {
  Numbers numbers;
  const FieldSampler sampler = samplerOf(pointField(numbers.places(400, 0.0, 1.0), {0.0}, linear), {6, 5.0});
  double before = sampler.value({0.1, 0.5, 0.5}, 0.0, 0).value();
  for (int i = 1; i <= 40000; ++i) {
    const double value = sampler.value({0.1 + 0.8 * i / 40000.0, 0.5, 0.5}, 0.0, 0).value();
    ASSERT_LT(std::abs(value - before), 0.02) << "at step " << i;
    before = value;
  }
}

TEST(FieldSampler, EquallyFarPointsCountAlike) {
  // Nine points at distance 1 with k of 8: all of them count, whatever order they are found in.
  geometry::Positions circle;
  for (int i = 0; i < 4; ++i) {
    circle.emplace_back(i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0, 0);
  }
  const FieldSampler sampler =
      samplerOf(pointField(circle, {0.0}, [](const Vec3d& p, double) { return p.x() == 1.0 ? 8.0 : 0.0; }), {3, 5.0});
  EXPECT_DOUBLE_EQ(sampler.value({0.0, 0.0, 0.0}, 0.0, 0).value(), 2.0);
}

TEST(FieldSampler, PointsAtOnePlaceGiveTheirMean) {
  geometry::Positions points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  ThreatField field = pointField(points, {0.0}, linear);
  field.steps[0].values[0] = {2.0F, 9.0F, 4.0F};
  EXPECT_DOUBLE_EQ(samplerOf(field, {1, 5.0}).value({0.0, 0.0, 0.0}, 0.0, 0).value(), 3.0);
}

TEST(FieldSampler, InterpolatesInTimeBetweenPointsThatMove) {
  ThreatField field = pointField({{0, 0, 0}}, {1.0, 3.0}, [](auto&&, double t) { return t; });
  field.steps[1].points = std::make_shared<const geometry::Positions>(geometry::Positions{{0.5F, 0, 0}});
  const FieldSampler sampler = samplerOf(field, {1, 1.0});
  EXPECT_NEAR(sampler.value({0.25, 0.0, 0.0}, 1.5, 0).value(), 1.5, 1e-12);
  EXPECT_FALSE(sampler.value({1.2, 0.0, 0.0}, 1.5, 0)) << "out of reach at the first of the two times";
}

TEST(FieldSampler, TypicalSpacingIsThatOfAGrid) {
  geometry::Positions grid;
  for (int i = 0; i < 1000; ++i) {
    grid.emplace_back(0.25F * static_cast<float>(i % 10), 0.25F * static_cast<float>(i / 10 % 10),
                      0.25F * static_cast<float>(i / 100));
  }
  const ThreatField field = pointField(grid, {0.0}, linear);
  EXPECT_NEAR(typicalSpacing(field), 0.25, 1e-6);
  EXPECT_NEAR(samplerOf(field).radius(), 0.75, 1e-5);
  EXPECT_EQ(typicalSpacing(pointField({{1, 1, 1}}, {0.0}, linear)), 0.0);
}

}  // namespace
}  // namespace lorica::threat
