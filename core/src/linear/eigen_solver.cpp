#include "linear/eigen_solver.h"

#include <algorithm>

#include "nscdd/error.h"

namespace nscdd {

void TripletMatrix::SetPattern(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) {
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

void TripletMatrix::SetValues(std::span<const double> values) {
  double* out = matrix_.valuePtr();
  std::fill_n(out, matrix_.nonZeros(), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) out[place_[k]] += values[k];
}

void EigenSolver::Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) {
  ++counters_.analyses;
  matrix_.SetPattern(n, row, column);
  factor_.analyzePattern(matrix_.matrix());
}

void EigenSolver::Factorise(std::span<const double> values) {
  ++counters_.factorisations;
  matrix_.SetValues(values);
  factor_.factorize(matrix_.matrix());
  if (factor_.info() != Eigen::Success || !(factor_.vectorD().minCoeff() > 0.0)) {
    throw Error("the augmented interface matrix is not positive definite to working precision; choose a smaller lambda");
  }
}

void EigenSolver::Solve(std::span<double> x) {
  ++counters_.solves;
  Eigen::Map<Eigen::VectorXd> vector(x.data(), static_cast<Eigen::Index>(x.size()));
  vector = factor_.solve(vector).eval();
}

void EigenLuSolver::Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) {
  ++counters_.analyses;
  matrix_.SetPattern(n, row, column);
  factor_.analyzePattern(matrix_.matrix());
}

void EigenLuSolver::Factorise(std::span<const double> values) {
  ++counters_.factorisations;
  matrix_.SetValues(values);
  factor_.factorize(matrix_.matrix());
  if (factor_.info() != Eigen::Success) throw Error("the matrix is singular to working precision");
}

void EigenLuSolver::Solve(std::span<double> x) {
  ++counters_.solves;
  Eigen::Map<Eigen::VectorXd> vector(x.data(), static_cast<Eigen::Index>(x.size()));
  vector = factor_.solve(vector).eval();
}

}  // namespace nscdd
