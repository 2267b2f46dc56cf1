#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
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
  /// the factor, half a millisecond for half a million entries.
  void solve(const std::vector<Vec4f>& right, std::vector<Vec4f>& solution) const;

 private:
  /// Neighbouring columns of L that reach the same rows below them: a row is fetched once for all of them. Where they
  /// differ by few rows, zeros fill up.
  struct Panel {
    std::uint32_t column = 0;  ///< the first one
    std::uint32_t width = 0;   ///< 1 to kWidest columns
    std::uint32_t row = 0;     ///< where its rows start in rows_
    std::uint32_t rows = 0;
    std::size_t value = 0;  ///< where its values start in values_: those between its columns, then row by row
  };
  static constexpr std::uint32_t kWidest = 4;

  using Column = std::vector<std::pair<std::uint32_t, float>>;
  std::uint32_t widthAt(std::uint32_t column, const std::vector<Column>& columns) const;
  void addPanel(std::uint32_t column, std::uint32_t width, const std::vector<Column>& columns);

  std::vector<std::uint32_t> place_;  ///< of each unknown in the factor's order
  std::vector<Panel> panels_;
  std::vector<std::uint32_t> rows_;
  std::vector<float> values_;           ///< of L below its diagonal of ones
  std::vector<float> inverseDiagonal_;  ///< 1 / D
};

}  // namespace lorica::viscera
