#include "lorica/viscera/lattice_quality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lorica/base/error.h"

namespace lorica::viscera {

using geometry::Mat3d;
using geometry::Vec3d;
using geometry::Vec3f;

namespace {

/// Where x_d, y_d, z_d are looked at: corners, then Gauss points.
std::array<Vec3d, 16> pointsOfACell() {
  std::array<Vec3d, 16> points;
  const double gauss = 0.5 / std::sqrt(3.0);
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec3d corner(static_cast<double>(c & 1U), static_cast<double>(c >> 1U & 1U),
                       static_cast<double>(c >> 2U & 1U));
    points[c] = corner;
    points[8 + c] = Vec3d::Constant(0.5) + 2.0 * gauss * (corner - Vec3d::Constant(0.5));
  }
  return points;
}

/// Determinant of d(posed)/d(rest) at one point of a cell whose control points moved by the offsets of Eq 10, in the
/// order of Eq 12.
double jacobian(const std::array<Vec3d, 8>& offset, const Vec3d& at, const Vec3d& cell) {
  constexpr std::array<std::array<int, 3>, 8> digits = {
      {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}}};
  Mat3d gradient = Mat3d::Identity();
  for (std::size_t c = 0; c < 8; ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      double slope = digits[c][static_cast<std::size_t>(axis)] == 1 ? 1.0 : -1.0;
      for (int other = 0; other < 3; ++other) {
        if (other != axis) {
          slope *= digits[c][static_cast<std::size_t>(other)] == 1 ? at[other] : 1.0 - at[other];
        }
      }
      gradient.col(axis) += slope / cell[axis] * offset[c];
    }
  }
  return gradient.determinant();
}

}  // namespace

LatticeQuality latticeQuality(const Embedding& lattice, std::span<const Vec3f> offsets) {
  static const std::array<Vec3d, 16> points = pointsOfACell();
  LatticeQuality quality;
  for (const std::array<std::uint32_t, 8>& corners : lattice.cellCorners) {
    std::array<Vec3d, 8> offset;
    for (std::size_t c = 0; c < 8; ++c) {
      offset[c] = offsets[corners[c]].cast<double>();
    }
    double smallest = jacobian(offset, points[0], lattice.cell);
    for (const Vec3d& at : points) {
      smallest = std::min(smallest, jacobian(offset, at, lattice.cell));
    }
    ++quality.cells;
    quality.inverted += smallest > 0.0 ? 0 : 1;
    quality.smallestJacobian = quality.cells == 1 ? smallest : std::min(quality.smallestJacobian, smallest);
  }
  return quality;
}

LatticeQuality latticeQuality(const OrganRig& organ, OrganModel model, const parenting::PosedBody& pose,
                              base::Threads threads) {
  const bool thesis = model == OrganModel::dynamicThesis;
  const std::vector<SiteBlend>& drivers = thesis ? organ.thesisDrivers : organ.drivers;
  if ((!thesis && model != OrganModel::dynamic) || drivers.empty()) {
    return {};
  }
  const parenting::SiteMotion& motion = thesis ? pose.thesisSites : pose.sites;
  return latticeQuality(organ.lattice, offsets(organ.lattice.controlPoints, drivers, motion.carry, threads));
}

}  // namespace lorica::viscera
