// SPDX-License-Identifier: Apache-2.0
#include "linear/eigen_solver.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <type_traits>
#include <vector>

namespace nscdd {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Cholesky = Eigen::SimplicialLDLT<Matrix, Eigen::Lower>;
using Lu = Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>>;

bool IsSound(const Cholesky& factor) {
  return factor.info() == Eigen::Success && (factor.vectorD().array() > 0.0).all() && factor.vectorD().allFinite();
}

bool IsSound(const Lu& factor) { return factor.info() == Eigen::Success; }

template <class Factor>
class EigenSolver final : public LinearSolver {
 public:
  bool is_distributed() const override { return false; }
  Symmetry symmetry() const override {
    return std::is_same_v<Factor, Cholesky> ? Symmetry::kPositiveDefinite : Symmetry::kGeneral;
  }

  void Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) override {
    ++counters_.analyses;
    SetPattern(n, row, column);
    factor_.analyzePattern(matrix_);
  }

  void Factorise(std::span<const double> values) override {
    ++counters_.factorisations;
    double* out = matrix_.valuePtr();
    std::fill_n(out, matrix_.nonZeros(), 0.0);
    for (std::size_t k = 0; k < values.size(); ++k) out[place_[k]] += values[k];
    factor_.factorize(matrix_);
    if (!IsSound(factor_)) RefuseMatrix(symmetry());
  }

  void Solve(std::span<double> x) override {
    ++counters_.solves;
    Eigen::Map<Eigen::VectorXd> vector(x.data(), static_cast<Eigen::Index>(x.size()));
    vector = factor_.solve(vector).eval();
  }

 private:
  void SetPattern(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(row.size());
    for (std::size_t k = 0; k < row.size(); ++k) triplets.emplace_back(row[k], column[k], 1.0);
    matrix_.resize(n, n);
    matrix_.setFromTriplets(triplets.begin(), triplets.end());
    matrix_.makeCompressed();
    place_.resize(row.size());
    for (std::size_t k = 0; k < row.size(); ++k) {
      const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column[k]];
      const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column[k] + 1];
      place_[k] = static_cast<std::int32_t>(std::lower_bound(begin, end, row[k]) - matrix_.innerIndexPtr());
    }
  }

  Matrix matrix_;
  std::vector<std::int32_t> place_;  // of each triplet among the values of matrix_
  Factor factor_;
};

}  // namespace

std::unique_ptr<LinearSolver> MakeEigenSolver(Symmetry symmetry) {
  if (symmetry == Symmetry::kGeneral) return std::make_unique<EigenSolver<Lu>>();
  return std::make_unique<EigenSolver<Cholesky>>();
}

}  // namespace nscdd
