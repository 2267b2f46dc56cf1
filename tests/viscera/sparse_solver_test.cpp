#include "sparse_solver.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <Eigen/Dense>

namespace {

using lorica::viscera::SparseSolver;
using lorica::viscera::Vec4f;
using Matrix = Eigen::SparseMatrix<double>;

/// Springs between unknowns, each also held in place: positive definite whatever the springs.
Matrix springs(std::size_t unknowns, const std::vector<std::array<std::size_t, 2>>& ends) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::size_t row, std::size_t column, double value) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  };
  for (std::size_t i = 0; i < unknowns; ++i) {
    add(i, i, 0.2);
  }
  for (const auto& [a, b] : ends) {
    add(a, a, 1.0);
    add(b, b, 1.0);
    add(a, b, -1.0);
    add(b, a, -1.0);
  }
  Matrix matrix(static_cast<Eigen::Index>(unknowns), static_cast<Eigen::Index>(unknowns));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Largest difference from a dense solution in double precision, as a share of the largest value.
double error(const Matrix& matrix, const std::vector<Vec4f>& right) {
  std::vector<Vec4f> found;
  SparseSolver(matrix).solve(right, found);
  Eigen::MatrixXd dense(matrix.rows(), 4);
  for (Eigen::Index i = 0; i < dense.rows(); ++i) {
    dense.row(i) = right[static_cast<std::size_t>(i)].cast<double>().transpose();
  }
  const Eigen::MatrixXd expected = Eigen::MatrixXd(matrix).ldlt().solve(dense);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < dense.rows(); ++i) {
    largest = std::max(
        largest,
        (found[static_cast<std::size_t>(i)].cast<double>().transpose() - expected.row(i)).cwiseAbs().maxCoeff());
  }
  return largest / std::max(1e-30, expected.cwiseAbs().maxCoeff());
}

RC_GTEST_PROP(SparseSolver, AgreesWithADenseSolutionOnAnyNetworkOfSprings, ()) {
  const auto unknowns = *rc::gen::inRange<std::size_t>(1, 60);
  const auto number = *rc::gen::inRange<std::size_t>(0, 4 * unknowns);
  std::vector<std::array<std::size_t, 2>> ends;
  for (std::size_t s = 0; s < number; ++s) {
    const auto a = *rc::gen::inRange<std::size_t>(0, unknowns);
    const auto b = *rc::gen::inRange<std::size_t>(0, unknowns);
    if (a != b) {
      ends.push_back({a, b});
    }
  }
  std::vector<Vec4f> right;
  for (std::size_t i = 0; i < unknowns; ++i) {
    right.emplace_back(static_cast<float>(*rc::gen::inRange(-9, 10)), static_cast<float>(*rc::gen::inRange(-9, 10)),
                       static_cast<float>(i), 1.0F);
  }
  RC_ASSERT(error(springs(unknowns, ends), right) < 1e-4);
}

TEST(SparseSolver, AgreesWithADenseSolutionOnASolid) {
  constexpr std::size_t n = 7;
  const auto at = [](std::size_t x, std::size_t y, std::size_t z) { return x + n * (y + n * z); };
  std::vector<std::array<std::size_t, 2>> ends;
  std::vector<Vec4f> right(n * n * n, Vec4f::Zero());
  for (std::size_t z = 0; z < n; ++z) {
    for (std::size_t y = 0; y < n; ++y) {
      for (std::size_t x = 0; x + 1 < n; ++x) {
        ends.push_back({at(x, y, z), at(x + 1, y, z)});
        ends.push_back({at(y, x, z), at(y, x + 1, z)});
        ends.push_back({at(y, z, x), at(y, z, x + 1)});
      }
    }
  }
  right[at(0, 0, 0)] = Vec4f(1.0F, 0.0F, -3.0F, 2.0F);
  right[at(6, 3, 5)] = Vec4f(0.0F, 5.0F, 1.0F, 0.5F);
  EXPECT_LT(error(springs(right.size(), ends), right), 1e-4);
}

TEST(SparseSolver, SolvesNothingForNothingExactly) {
  std::vector<Vec4f> found;
  SparseSolver(springs(5, {{0, 1}, {1, 4}, {2, 3}})).solve(std::vector<Vec4f>(5, Vec4f::Zero()), found);
  for (const Vec4f& x : found) {
    EXPECT_TRUE((x.array() == 0.0F).all());
  }
}

}  // namespace
