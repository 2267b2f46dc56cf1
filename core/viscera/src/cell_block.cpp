#include "cell_block.h"

namespace lorica::viscera {

using geometry::Vec3f;

void CellBlock::setDeformation(std::size_t lane, const std::array<Vec3f, 8>& corners, float cell) {
  const std::array<Vec3f, 8>& u = corners;
  const std::array<Vec3f, 3> along{u[1] - u[0] + u[3] - u[2] + u[5] - u[4] + u[7] - u[6],
                                   u[4] - u[0] + u[5] - u[1] + u[6] - u[2] + u[7] - u[3],
                                   u[2] - u[0] + u[3] - u[1] + u[6] - u[4] + u[7] - u[5]};
  const float scale = 1.0F / (4.0F * cell);
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      deformation[3 * column + row][static_cast<Eigen::Index>(lane)] =
          (row == column ? 1.0F : 0.0F) + scale * along[column][static_cast<Eigen::Index>(row)];
    }
  }
}

void CellBlock::setTurn(std::size_t lane, const Vec4f& quaternion) {
  for (std::size_t c = 0; c < 4; ++c) {
    turn[c][static_cast<Eigen::Index>(lane)] = quaternion[static_cast<Eigen::Index>(c)];
  }
}

Vec4f CellBlock::turnOf(std::size_t lane) const {
  const auto i = static_cast<Eigen::Index>(lane);
  return Vec4f(turn[0][i], turn[1][i], turn[2][i], turn[3][i]).normalized();
}

Edges CellBlock::wanted(std::size_t lane, float strength) const {
  const auto i = static_cast<Eigen::Index>(lane);
  Edges edges;
  for (std::size_t column = 0; column < 3; ++column) {
    const std::size_t at = 3 * column;
    edges.col(static_cast<Eigen::Index>(column)) << strength * (rotation[at][i] - (column == 0 ? 1.0F : 0.0F)),
        strength * (rotation[at + 1][i] - (column == 1 ? 1.0F : 0.0F)),
        strength * (rotation[at + 2][i] - (column == 2 ? 1.0F : 0.0F)), 0.0F;
  }
  return edges;
}

void CellBlock::rotate() {
  const auto& [x, y, z, w] = turn;
  // Twice over the squared length: turns need not be of unit length.
  const Lane s = 2.0F / (x * x + y * y + z * z + w * w);
  const Lane sx = s * x;
  const Lane sy = s * y;
  const Lane sz = s * z;
  rotation[0] = 1.0F - (sy * y + sz * z);
  rotation[1] = sx * y + sz * w;
  rotation[2] = sx * z - sy * w;
  rotation[3] = sx * y - sz * w;
  rotation[4] = 1.0F - (sx * x + sz * z);
  rotation[5] = sy * z + sx * w;
  rotation[6] = sx * z + sy * w;
  rotation[7] = sy * z - sx * w;
  rotation[8] = 1.0F - (sx * x + sy * y);
}

void CellBlock::follow() {
  const std::array<Lane, 9>& r = rotation;
  const std::array<Lane, 9>& f = deformation;
  Lane agreement = r[0] * f[0];
  for (std::size_t i = 1; i < 9; ++i) {
    agreement += r[i] * f[i];
  }
  const Lane scale = 0.5F / (agreement.abs() + 1e-3F);
  // Half the small turn that the crossed columns ask for.
  const Lane hx = scale * ((r[1] * f[2] - r[2] * f[1]) + (r[4] * f[5] - r[5] * f[4]) + (r[7] * f[8] - r[8] * f[7]));
  const Lane hy = scale * ((r[2] * f[0] - r[0] * f[2]) + (r[5] * f[3] - r[3] * f[5]) + (r[8] * f[6] - r[6] * f[8]));
  const Lane hz = scale * ((r[0] * f[1] - r[1] * f[0]) + (r[3] * f[4] - r[4] * f[3]) + (r[6] * f[7] - r[7] * f[6]));
  const auto [x, y, z, w] = turn;
  turn[0] = x + w * hx + (hy * z - hz * y);
  turn[1] = y + w * hy + (hz * x - hx * z);
  turn[2] = z + w * hz + (hx * y - hy * x);
  turn[3] = w - (hx * x + hy * y + hz * z);
  rotate();
}

}  // namespace lorica::viscera
