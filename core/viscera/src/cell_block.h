#pragma once

#include <array>

#include "soft_body_parts.h"

namespace lorica::viscera {

using Edges = Eigen::Matrix<float, 4, 3>;  // a row of zeros below

/// Cells side by side: a component of all of them stands together, so that several are reckoned at once.
struct CellBlock {
  static constexpr std::size_t size = 16;
  using Lane = Eigen::Array<float, size, 1>;
  std::array<Lane, 4> turn;         ///< quaternion x, y, z, w; of any length
  std::array<Lane, 9> deformation;  ///< column by column
  std::array<Lane, 9> rotation;     ///< of the turn, column by column

  /// \param corners offsets of the cell's corners \param cell edge length, metres
  void setDeformation(std::size_t lane, const std::array<geometry::Vec3f, 8>& corners, float cell);
  void setTurn(std::size_t lane, const Vec4f& quaternion);
  Vec4f turnOf(std::size_t lane) const;
  /// What the cell's edges along x, y, z should do so that it only turns, times `strength`.
  Edges wanted(std::size_t lane, float strength) const;

  /// Sets `rotation` from `turn`.
  void rotate();
  /// Brings the turns nearer to the rotations of the deformations (Müller et al. 2016, "A robust method to extract the
  /// rotational part of deformations"). Defined, and continuous, for cells turned inside out too. \pre rotate()
  void follow();
};

}  // namespace lorica::viscera
