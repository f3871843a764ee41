// SPDX-License-Identifier: Apache-2.0
#include "newton/block_lu.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace nscdd {
namespace {

/// c -= a b. Nothing overlaps: rows of c stay in registers, which halves the time.
template <int B>
void SubtractProduct(const double* __restrict a, const double* __restrict b, double* __restrict c) {
  for (int i = 0; i < B; ++i) {
    double row[B];
    for (int j = 0; j < B; ++j) row[j] = c[B * i + j];
    for (int k = 0; k < B; ++k) {
      for (int j = 0; j < B; ++j) row[j] -= a[B * i + k] * b[B * k + j];
    }
    for (int j = 0; j < B; ++j) c[B * i + j] = row[j];
  }
}

/// a := a b.
template <int B>
void MultiplyRight(double* a, const double* b) {
  for (int i = 0; i < B; ++i) {
    double row[B] = {};
    for (int k = 0; k < B; ++k) {
      for (int j = 0; j < B; ++j) row[j] += a[B * i + k] * b[B * k + j];
    }
    std::copy_n(row, B, &a[B * i]);
  }
}

/// y -= a x; x is not y.
template <int B>
void SubtractVector(const double* a, const double* x, double* y) {
  for (int i = 0; i < B; ++i) {
    double sum = y[i];
    for (int j = 0; j < B; ++j) sum -= a[B * i + j] * x[j];
    y[i] = sum;
  }
}

/// a := a^-1 by Gauss-Jordan without pivoting; false if a pivot is zero or not finite.
template <int B>
bool Invert(double* a) {
  for (int k = 0; k < B; ++k) {
    const double pivot = 1.0 / a[B * k + k];
    if (!std::isfinite(pivot)) return false;
    a[B * k + k] = 1.0;
    for (int j = 0; j < B; ++j) a[B * k + j] *= pivot;
    for (int i = 0; i < B; ++i) {
      if (i == k) continue;
      const double factor = a[B * i + k];
      a[B * i + k] = 0.0;
      for (int j = 0; j < B; ++j) a[B * i + j] -= factor * a[B * k + j];
    }
  }
  return true;
}

/// Order of elimination -> row.
template <int B>
std::vector<std::int32_t> MinimumDegreeOrder(const BlockMatrix<B>& matrix) {
  const int n = matrix.rows();
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    for (std::int32_t k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k) entries.emplace_back(i, matrix.column[k], 1.0);
  }
  Eigen::SparseMatrix<double> pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  return {order.indices().data(), order.indices().data() + n};
}

}  // namespace

/// The row structure of L is what the elimination tree reaches from the entries of A (Liu 1990); that of U is its transpose.
template <int B>
void BlockLu<B>::Analyse(const BlockMatrix<B>& matrix) {
  const int n = matrix.rows();
  row_of_ = MinimumDegreeOrder(matrix);
  place_of_row_.resize(n);
  for (int i = 0; i < n; ++i) place_of_row_[row_of_[i]] = i;
  std::vector<std::int32_t> parent(n, -1), mark(n, -1);
  std::vector<std::vector<std::int32_t>> columns(n);  // of U
  lower_ = {};
  lower_.begin.push_back(0);
  for (int i = 0; i < n; ++i) {
    mark[i] = i;
    for (std::int32_t k = matrix.begin[row_of_[i]]; k < matrix.begin[row_of_[i] + 1]; ++k) {
      for (std::int32_t j = place_of_row_[matrix.column[k]]; j < i && mark[j] != i; j = parent[j]) {
        if (parent[j] == -1) parent[j] = i;
        mark[j] = i;
        lower_.column.push_back(j);
        columns[j].push_back(i);
      }
    }
    std::sort(lower_.column.begin() + lower_.begin.back(), lower_.column.end());
    lower_.begin.push_back(static_cast<std::int32_t>(lower_.column.size()));
  }
  upper_ = {};
  upper_.begin.push_back(0);
  for (const auto& row : columns) {
    upper_.column.insert(upper_.column.end(), row.begin(), row.end());
    upper_.begin.push_back(static_cast<std::int32_t>(upper_.column.size()));
  }
  lower_.values.resize(B * B * lower_.column.size());
  upper_.values.resize(B * B * upper_.column.size());
  diagonal_.resize(B * B * n);
  block_in_row_.assign(n, nullptr);
  scratch_.resize(B * n);
}

template <int B>
void BlockLu<B>::Scatter(const BlockMatrix<B>& matrix) {
  std::fill(lower_.values.begin(), lower_.values.end(), 0.0);
  std::fill(upper_.values.begin(), upper_.values.end(), 0.0);
  const auto block = [](Triangle& t, int i, std::int32_t j) {
    const auto first = t.column.begin() + t.begin[i];
    return &t.values[B * B * (std::lower_bound(first, t.column.begin() + t.begin[i + 1], j) - t.column.begin())];
  };
  for (int row = 0; row < matrix.rows(); ++row) {
    const int i = place_of_row_[row];
    for (std::int32_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k) {
      const std::int32_t j = place_of_row_[matrix.column[k]];
      double* to = j == i ? &diagonal_[B * B * i] : j < i ? block(lower_, i, j) : block(upper_, i, j);
      std::copy_n(matrix.Block(k), B * B, to);
    }
  }
}

/// L_ik := A_ik U_kk^-1 and A_ij -= L_ik U_kj for k ascending.
template <int B>
bool BlockLu<B>::EliminateRow(int i) {
  constexpr int kSize = B * B;
  for (std::int32_t k = lower_.begin[i]; k < lower_.begin[i + 1]; ++k)
    block_in_row_[lower_.column[k]] = &lower_.values[kSize * k];
  block_in_row_[i] = &diagonal_[kSize * i];
  for (std::int32_t k = upper_.begin[i]; k < upper_.begin[i + 1]; ++k)
    block_in_row_[upper_.column[k]] = &upper_.values[kSize * k];
  for (std::int32_t k = lower_.begin[i]; k < lower_.begin[i + 1]; ++k) {
    const std::int32_t pivot = lower_.column[k];
    double* l = &lower_.values[kSize * k];
    MultiplyRight<B>(l, &diagonal_[kSize * pivot]);
    for (std::int32_t u = upper_.begin[pivot]; u < upper_.begin[pivot + 1]; ++u) {
      SubtractProduct<B>(l, &upper_.values[kSize * u], block_in_row_[upper_.column[u]]);
    }
  }
  return Invert<B>(&diagonal_[kSize * i]);
}

template <int B>
bool BlockLu<B>::Factorise(const BlockMatrix<B>& matrix) {
  Scatter(matrix);
  for (int i = 0; i < matrix.rows(); ++i) {
    if (!EliminateRow(i)) return false;
  }
  return true;
}

template <int B>
void BlockLu<B>::Solve(double* x) {
  const int n = static_cast<int>(row_of_.size());
  double* y = scratch_.data();
  for (int i = 0; i < n; ++i) {
    std::copy_n(&x[B * row_of_[i]], B, &y[B * i]);
    for (std::int32_t k = lower_.begin[i]; k < lower_.begin[i + 1]; ++k) {
      SubtractVector<B>(&lower_.values[B * B * k], &y[B * lower_.column[k]], &y[B * i]);
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    for (std::int32_t k = upper_.begin[i]; k < upper_.begin[i + 1]; ++k) {
      SubtractVector<B>(&upper_.values[B * B * k], &y[B * upper_.column[k]], &y[B * i]);
    }
    double* out = &x[B * row_of_[i]];
    std::fill_n(out, B, 0.0);
    for (int r = 0; r < B; ++r) {
      for (int c = 0; c < B; ++c) out[r] += diagonal_[B * B * i + B * r + c] * y[B * i + c];
    }
    std::copy_n(out, B, &y[B * i]);
  }
}

template class BlockLu<2>;
template class BlockLu<3>;

}  // namespace nscdd
