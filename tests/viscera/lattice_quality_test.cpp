#include "lorica/viscera/lattice_quality.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>

#include "lorica/geometry/primitives.h"

namespace lorica::viscera {
namespace {

using geometry::Mat3d;
using geometry::Vec3d;
using geometry::Vec3f;

Lattice latticeOf(const std::array<int, 3>& cells) {
  LatticeOptions options;
  options.layout = LatticeOptions::Layout::perAxis;
  options.cells = cells;
  options.prune = false;
  return makeLattice(geometry::ellipsoid({0.1, 1.2, -0.03}, {0.1, 0.15, 0.05}, 4).positions, options);
}

std::vector<Vec3f> offsetsOf(const Lattice& lattice, const std::function<Vec3d(const Vec3d&)>& map) {
  std::vector<Vec3f> offsets;
  for (const Vec3d& c : lattice.controlPoints) {
    offsets.emplace_back((map(c) - c).cast<float>());
  }
  return offsets;
}

TEST(LatticeQuality, AtRestEveryJacobianIsOne) {
  const Lattice lattice = latticeOf({4, 3, 2});
  const LatticeQuality quality =
      latticeQuality(lattice, std::vector<Vec3f>(lattice.controlPoints.size(), Vec3f::Zero()));
  EXPECT_EQ(quality.cells, lattice.cellCorners.size());
  EXPECT_EQ(quality.inverted, 0U);
  EXPECT_EQ(quality.smallestJacobian, 1.0);
}

RC_GTEST_PROP(LatticeQuality, OfAnAffineMapIsItsDeterminant, ()) {
  const Lattice lattice = latticeOf({3, 2, 2});
  Mat3d linear;
  for (int i = 0; i < 9; ++i) {
    linear(i / 3, i % 3) = static_cast<double>(*rc::gen::inRange(-200, 200)) / 100.0;
  }
  const LatticeQuality quality =
      latticeQuality(lattice, offsetsOf(lattice, [&](const Vec3d& p) -> Vec3d { return linear * p; }));
  const double determinant = linear.determinant();
  RC_PRE(std::abs(determinant) > 1e-2);
  RC_ASSERT(std::abs(quality.smallestJacobian - determinant) < 1e-4);
  RC_ASSERT(quality.inverted == (determinant > 0.0 ? 0 : quality.cells));
}

TEST(LatticeQuality, AShearKeepsVolume) {
  const Lattice lattice = latticeOf({4, 4, 4});
  const LatticeQuality quality =
      latticeQuality(lattice, offsetsOf(lattice, [](const Vec3d& p) -> Vec3d { return p + Vec3d(3.0 * p.y(), 0, 0); }));
  EXPECT_NEAR(quality.smallestJacobian, 1.0, 1e-5);
  EXPECT_EQ(quality.inverted, 0U);
}

TEST(LatticeQuality, ACornerPushedThroughItsCellInvertsIt) {
  const Lattice lattice = latticeOf({1, 1, 1});
  for (const double push : {0.5, 0.99, 1.5}) {
    std::vector<Vec3f> offsets(8, Vec3f::Zero());
    // V0 along x: at that corner the edge along x has 1 - push of its length, the other two keep theirs.
    offsets[lattice.cellCorners[0][0]] = Vec3f(static_cast<float>(push * lattice.cell.x()), 0, 0);
    const LatticeQuality quality = latticeQuality(lattice, offsets);
    EXPECT_NEAR(quality.smallestJacobian, 1.0 - push, 1e-6);
    EXPECT_EQ(quality.inverted, push > 1.0 ? 1U : 0U);
  }
}

TEST(LatticeQuality, OnlyCellsThatHoldVerticesAreLookedAt) {
  LatticeOptions options;
  options.layout = LatticeOptions::Layout::uniform;
  options.cells = {3, 1, 1};
  geometry::Positions everywhere;
  for (int i = 0; i < 27; ++i) {
    everywhere.emplace_back(static_cast<float>(i % 3) / 2.0F, static_cast<float>(i / 3 % 3) / 2.0F,
                            static_cast<float>(i / 9) / 2.0F);
  }
  // An inner control point belongs to eight cells; pushed by 1.5 cells along x, it passes through four of them.
  const auto pushed = [&](const Lattice& lattice) {
    std::vector<Vec3f> offsets(lattice.controlPoints.size(), Vec3f::Zero());
    for (std::size_t c = 0; c < lattice.controlPoints.size(); ++c) {
      if ((lattice.controlPoints[c] - lattice.origin - lattice.cell).norm() < 1e-9) {
        offsets[c] = Vec3f(static_cast<float>(1.5 * lattice.cell.x()), 0, 0);
      }
    }
    return latticeQuality(lattice, offsets);
  };
  EXPECT_EQ(pushed(makeLattice(everywhere, options)).cells, 27U);
  EXPECT_EQ(pushed(makeLattice(everywhere, options)).inverted, 4U);
  everywhere.erase(everywhere.begin() + 1);  // the only vertex of one of the four
  EXPECT_EQ(pushed(makeLattice(everywhere, options)).cells, 26U);
  EXPECT_EQ(pushed(makeLattice(everywhere, options)).inverted, 3U);
}

}  // namespace
}  // namespace lorica::viscera
