#include "sparse_solver.h"

#include <Eigen/SparseCholesky>
#include <array>

#include "lorica/base/error.h"

namespace lorica::viscera {

namespace {

/// L x = right for a panel's columns; takes their share off the rows below.
template <std::size_t width>
void forward(const float* value, std::span<const std::uint32_t> rows, Vec4f* own, Vec4f* all) {
  std::array<Vec4f, width> x;
  for (std::size_t i = 0; i < width; ++i) {
    x[i] = own[i];
    for (std::size_t k = 0; k < i; ++k) {
      x[i] -= *value++ * x[k];
    }
    own[i] = x[i];
  }
  for (const std::uint32_t row : rows) {
    Vec4f below = all[row];
    for (std::size_t k = 0; k < width; ++k) {
      below -= *value++ * x[k];
    }
    all[row] = below;
  }
}

/// D L^T x = right for a panel's columns, once the rows below are known.
template <std::size_t width>
void backward(const float* value, std::span<const std::uint32_t> rows, const float* inverse, Vec4f* own,
              const Vec4f* all) {
  constexpr std::size_t between = width * (width - 1) / 2;
  std::array<Vec4f, width> x;
  for (std::size_t k = 0; k < width; ++k) {
    x[k] = inverse[k] * own[k];
  }
  const float* below = value + between;
  for (const std::uint32_t row : rows) {
    const Vec4f& known = all[row];
    for (std::size_t k = 0; k < width; ++k) {
      x[k] -= *below++ * known;
    }
  }
  const float* last = value + between;
  for (std::size_t i = width; i-- > 0;) {
    last -= i;
    for (std::size_t k = 0; k < i; ++k) {
      x[k] -= last[k] * x[i];
    }
    own[i] = x[i];
  }
}

}  // namespace

SparseSolver::SparseSolver(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factored(matrix);
  LORICA_CHECK(factored.info() == Eigen::Success && (factored.vectorD().array() > 0.0).all(),
               "a symmetric positive definite matrix");
  const Eigen::SparseMatrix<double> lower = factored.matrixL();
  std::vector<Column> columns(static_cast<std::size_t>(matrix.cols()));
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    place_.push_back(static_cast<std::uint32_t>(factored.permutationP().indices()[column]));
    inverseDiagonal_.push_back(static_cast<float>(1.0 / factored.vectorD()[column]));
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      if (entry.row() > column) {
        columns[static_cast<std::size_t>(column)].emplace_back(static_cast<std::uint32_t>(entry.row()),
                                                               static_cast<float>(entry.value()));
      }
    }
  }
  for (std::uint32_t column = 0; column < columns.size(); column += panels_.back().width) {
    addPanel(column, widthAt(column, columns), columns);
  }
}

/// How many columns from this one on share a panel. What lies below a column's first entry lies in that entry's column
/// too: a chain of first entries has the rows of its last column.
std::uint32_t SparseSolver::widthAt(std::uint32_t column, const std::vector<Column>& columns) const {
  constexpr double mostFill = 1.3;
  std::uint32_t width = 1;
  std::size_t entries = columns[column].size();
  while (width < kWidest && !columns[column + width - 1].empty() &&
         columns[column + width - 1].front().first == column + width) {
    const std::size_t rows = columns[column + width].size();
    entries += rows;
    const std::size_t stored = (width + 1) * rows + width * (width + 1) / 2;
    if (static_cast<double>(stored) > mostFill * static_cast<double>(entries)) {
      break;
    }
    ++width;
  }
  return width;
}

void SparseSolver::addPanel(std::uint32_t column, std::uint32_t width, const std::vector<Column>& columns) {
  const Column& rows = columns[column + width - 1];
  const std::size_t between = width * (width - 1) / 2;
  panels_.push_back({column, width, static_cast<std::uint32_t>(rows_.size()), static_cast<std::uint32_t>(rows.size()),
                     values_.size()});
  values_.resize(values_.size() + between + width * rows.size(), 0.0F);
  float* const own = values_.data() + panels_.back().value;
  for (const auto& row : rows) {
    rows_.push_back(row.first);
  }
  for (std::uint32_t k = 0; k < width; ++k) {
    std::size_t at = 0;
    for (const auto& [row, value] : columns[column + k]) {
      if (row < column + width) {
        const std::size_t i = row - column;
        own[i * (i - 1) / 2 + k] = value;
        continue;
      }
      while (rows[at].first != row) {
        ++at;
      }
      own[between + at * width + k] = value;
    }
  }
}

void SparseSolver::solve(const std::vector<Vec4f>& right, std::vector<Vec4f>& solution) const {
  const std::size_t unknowns = place_.size();
  LORICA_CHECK(right.size() == unknowns, "one row per unknown");
  std::vector<Vec4f> x(unknowns);
  for (std::size_t i = 0; i < unknowns; ++i) {
    x[place_[i]] = right[i];
  }
  const auto rowsOf = [&](const Panel& panel) { return std::span(rows_).subspan(panel.row, panel.rows); };
  for (const Panel& panel : panels_) {
    constexpr std::array kernels{forward<1>, forward<2>, forward<3>, forward<4>};
    kernels[panel.width - 1](values_.data() + panel.value, rowsOf(panel), &x[panel.column], x.data());
  }
  for (std::size_t p = panels_.size(); p-- > 0;) {
    const Panel& panel = panels_[p];
    constexpr std::array kernels{backward<1>, backward<2>, backward<3>, backward<4>};
    kernels[panel.width - 1](values_.data() + panel.value, rowsOf(panel), &inverseDiagonal_[panel.column],
                             &x[panel.column], x.data());
  }
  solution.resize(unknowns);
  for (std::size_t i = 0; i < unknowns; ++i) {
    solution[i] = x[place_[i]];
  }
}

}  // namespace lorica::viscera
