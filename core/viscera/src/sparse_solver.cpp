#include "sparse_solver.h"

#include <Eigen/SparseCholesky>

#include "lorica/base/error.h"

namespace lorica::viscera {

SparseSolver::SparseSolver(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factored(matrix);
  LORICA_CHECK(factored.info() == Eigen::Success && (factored.vectorD().array() > 0.0).all(),
               "a symmetric positive definite matrix");
  const Eigen::SparseMatrix<double> lower = factored.matrixL();
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    place_.push_back(static_cast<std::uint32_t>(factored.permutationP().indices()[column]));
    inverseDiagonal_.push_back(static_cast<float>(1.0 / factored.vectorD()[column]));
    start_.push_back(static_cast<std::uint32_t>(rows_.size()));
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      if (entry.row() > column) {
        rows_.push_back(static_cast<std::uint32_t>(entry.row()));
        values_.push_back(static_cast<float>(entry.value()));
      }
    }
  }
  start_.push_back(static_cast<std::uint32_t>(rows_.size()));
}

void SparseSolver::solve(const std::vector<Vec4f>& right, std::vector<Vec4f>& solution) const {
  const std::size_t unknowns = place_.size();
  LORICA_CHECK(right.size() == unknowns, "one row per unknown");
  std::vector<Vec4f> x(unknowns);
  for (std::size_t i = 0; i < unknowns; ++i) {
    x[place_[i]] = right[i];
  }
  for (std::size_t column = 0; column < unknowns; ++column) {
    const Vec4f here = x[column];
    for (std::uint32_t e = start_[column]; e < start_[column + 1]; ++e) {
      x[rows_[e]] -= values_[e] * here;
    }
  }
  for (std::size_t column = unknowns; column-- > 0;) {
    Vec4f here = inverseDiagonal_[column] * x[column];
    for (std::uint32_t e = start_[column]; e < start_[column + 1]; ++e) {
      here -= values_[e] * x[rows_[e]];
    }
    x[column] = here;
  }
  solution.resize(unknowns);
  for (std::size_t i = 0; i < unknowns; ++i) {
    solution[i] = x[place_[i]];
  }
}

}  // namespace lorica::viscera
