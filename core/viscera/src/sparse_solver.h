#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace lorica::viscera {

using Vec4f = Eigen::Vector4f;

/// A sparse symmetric positive definite matrix, factored once (L D L^T with a fill-reducing order) and solved for four
/// right-hand sides at a time. Factored in double precision, solved in single.
class SparseSolver {
 public:
  SparseSolver() = default;
  /// \pre matrix is symmetric and positive definite. Cost: some tenths of a second for 10,000 unknowns of a solid.
  explicit SparseSolver(const Eigen::SparseMatrix<double>& matrix);

  /// Solution for `right`, one row per unknown. The same bits whatever the number of threads. Cost: two passes over
  /// the factor, a millisecond for half a million entries.
  void solve(const std::vector<Vec4f>& right, std::vector<Vec4f>& solution) const;

 private:
  std::vector<std::uint32_t> place_;  ///< of each unknown in the factor's order
  std::vector<std::uint32_t> start_;  ///< of each column in rows_, and the end
  std::vector<std::uint32_t> rows_;
  std::vector<float> values_;           ///< of L below its diagonal of ones
  std::vector<float> inverseDiagonal_;  ///< 1 / D
};

}  // namespace lorica::viscera
