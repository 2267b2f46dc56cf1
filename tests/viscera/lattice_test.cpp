#include "lorica/viscera/lattice.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <set>

#include "lorica/base/error.h"
#include "lorica/geometry/primitives.h"

namespace lorica::viscera {
namespace {

using geometry::Positions;
using geometry::Vec3d;
using geometry::Vec3f;
using Layout = LatticeOptions::Layout;

LatticeOptions optionsOf(Layout layout) {
  LatticeOptions options;
  options.layout = layout;
  options.cells = {4, 3, 2};
  options.cellMetres = 0.05;
  return options;
}

class EveryLayout : public testing::TestWithParam<Layout> {};
INSTANTIATE_TEST_SUITE_P(Lattice, EveryLayout,
                         testing::Values(Layout::boundingBox, Layout::uniform, Layout::perAxis, Layout::cellSize));

TEST_P(EveryLayout, ZeroOffsetsLeaveEveryVertexBitForBit) {
  const auto organ = geometry::ellipsoid({0.1, 1.2, -0.03}, {0.1, 0.15, 0.05}, 4);
  const Lattice lattice = makeLattice(organ.positions, optionsOf(GetParam()));
  const std::vector<Vec3f> offsets(lattice.controlPoints.size(), Vec3f::Zero());
  Positions posed(organ.positions.size());
  deform(organ.positions, lattice, offsets, posed, {});
  EXPECT_EQ(std::memcmp(posed.data(), organ.positions.data(), posed.size() * sizeof(Vec3f)), 0);
}

TEST_P(EveryLayout, AffineMotionOfTheControlPointsGivesTheAffineMap) {
  const auto organ = geometry::ellipsoid({0.1, 1.2, -0.03}, {0.1, 0.15, 0.05}, 4);
  const Lattice lattice = makeLattice(organ.positions, optionsOf(GetParam()));
  geometry::Mat3d linear;
  linear << 1.1, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.3;
  const Vec3d shift(0.3, -0.2, 0.1);
  std::vector<Vec3f> offsets;
  for (const Vec3d& c : lattice.controlPoints) {
    offsets.emplace_back((linear * c + shift - c).cast<float>());
  }
  Positions posed(organ.positions.size());
  deform(organ.positions, lattice, offsets, posed, {});
  for (std::size_t v = 0; v < posed.size(); ++v) {
    const Vec3d expected = linear * organ.positions[v].cast<double>() + shift;
    ASSERT_LT((posed[v].cast<double>() - expected).norm(), 1e-6);
  }
}

TEST_P(EveryLayout, KeepsVerticesInTheirCellsAndWithinTheHullOfItsControlPoints) {
  const auto organ = geometry::ellipsoid({0.1, 1.2, -0.03}, {0.1, 0.15, 0.05}, 4);
  const Lattice lattice = makeLattice(organ.positions, optionsOf(GetParam()));
  for (std::size_t v = 0; v < organ.positions.size(); ++v) {
    const auto& corner = lattice.cellCorners[lattice.cellOf[v]];
    const Vec3d low = lattice.controlPoints[corner[0]];
    const Vec3d high = lattice.controlPoints[corner[7]];
    const Vec3d p = organ.positions[v].cast<double>();
    ASSERT_TRUE((p.array() >= low.array() - 1e-9).all() && (p.array() <= high.array() + 1e-9).all());
  }
}

TEST(Lattice, NumbersTheCornersOfACellAsEquation12Does) {
  const auto organ = geometry::box({0, 0, 0}, {1, 2, 3});
  const Lattice lattice = makeLattice(organ.positions, optionsOf(Layout::boundingBox));
  ASSERT_EQ(lattice.cellCorners.size(), 1U);
  const Vec3d digits[8] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}};
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec3d place = lattice.controlPoints[lattice.cellCorners[0][c]];
    EXPECT_LT((place - digits[c].cwiseProduct(Vec3d(1, 2, 3))).norm(), 1e-12);
  }
}

TEST(Lattice, PruningKeepsExactlyTheCornersOfCellsWithVertices) {
  // Vertices only along the diagonal of a 6 x 6 x 6 lattice.
  Positions diagonal;
  for (int i = 0; i <= 60; ++i) {
    diagonal.push_back(Vec3f::Constant(static_cast<float>(i) / 60.0F));
  }
  LatticeOptions options;
  options.layout = Layout::uniform;
  options.cells = {6, 1, 1};
  const Lattice pruned = makeLattice(diagonal, options);
  options.prune = false;
  const Lattice full = makeLattice(diagonal, options);
  EXPECT_EQ(full.controlPoints.size(), 343U);
  EXPECT_EQ(full.pruned, 0U);
  std::set<std::uint32_t> used;
  for (const auto& corners : pruned.cellCorners) {
    used.insert(corners.begin(), corners.end());
  }
  EXPECT_EQ(pruned.cellCorners.size(), 6U);
  EXPECT_EQ(pruned.controlPoints.size(), used.size());
  EXPECT_EQ(pruned.controlPoints.size(), 6 * 8 - 5U) << "cells along the diagonal share one corner each";
  EXPECT_EQ(pruned.pruned, 343 - pruned.controlPoints.size());
}

TEST(Lattice, CellSizeIsNearTheOneAskedFor) {
  const auto organ = geometry::box({0, 0, 0}, {0.41, 0.12, 0.03});
  const Lattice lattice = makeLattice(organ.positions, {});
  EXPECT_EQ(lattice.cells, (std::array<int, 3>{10, 3, 1}));
}

TEST(Lattice, AFlatModelIsBoundToo) {
  const Positions sheet{Vec3f(0, 0, 0), Vec3f(0.1F, 0, 0), Vec3f(0, 0.1F, 0)};
  const Lattice lattice = makeLattice(sheet, {});
  EXPECT_EQ(lattice.cellOf.size(), 3U);
  EXPECT_GT(lattice.cell.z(), 0.0);
}

TEST(Lattice, RefusesCellCountsOutOfRange) {
  const auto organ = geometry::box({0, 0, 0}, {1, 1, 1});
  LatticeOptions options = optionsOf(Layout::uniform);
  options.cells = {0, 1, 1};
  EXPECT_THROW(makeLattice(organ.positions, options), base::CallerError);
}

RC_GTEST_PROP(Lattice, EveryVertexMovesByTheTrilinearBlendOfItsEightCorners, ()) {
  const auto random = [] { return static_cast<float>(*rc::gen::inRange(-1000, 1000)) / 1000.0F; };
  Positions points;
  for (int i = 0; i < 20; ++i) {
    points.emplace_back(random(), random(), random());
  }
  LatticeOptions options;
  options.layout = Layout::perAxis;
  options.cells = {*rc::gen::inRange(1, 6), *rc::gen::inRange(1, 6), *rc::gen::inRange(1, 6)};
  const Lattice lattice = makeLattice(points, options);
  std::vector<Vec3f> offsets;
  for (std::size_t c = 0; c < lattice.controlPoints.size(); ++c) {
    offsets.emplace_back(random(), random(), random());
  }
  Positions posed(points.size());
  deform(points, lattice, offsets, posed, {1});
  for (std::size_t v = 0; v < points.size(); ++v) {
    // Weights straight from the distances to the eight control points of the cell (Eq 11).
    Vec3d blend = Vec3d::Zero();
    double sum = 0.0;
    for (const std::uint32_t c : lattice.cellCorners[lattice.cellOf[v]]) {
      const Vec3d apart = (points[v].cast<double>() - lattice.controlPoints[c]).cwiseAbs().cwiseQuotient(lattice.cell);
      const double weight = (1 - apart.x()) * (1 - apart.y()) * (1 - apart.z());
      blend += weight * offsets[c].cast<double>();
      sum += weight;
    }
    RC_ASSERT(std::abs(sum - 1.0) < 1e-6);
    RC_ASSERT((posed[v].cast<double>() - points[v].cast<double>() - blend).norm() < 1e-5);
  }
}

}  // namespace
}  // namespace lorica::viscera
