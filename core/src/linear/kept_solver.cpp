// SPDX-License-Identifier: Apache-2.0
#include "linear/kept_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nscdd {
namespace {

double LargestOf(const std::vector<double>& v) {
  double largest = 0.0;
  for (const double e : v) largest = std::abs(e) <= largest ? largest : std::abs(e);  // not a number stays
  return largest;
}

}  // namespace

bool KeptSolver::OnAll(bool mine) const {
  if (!solver_->is_distributed()) return mine;
  double all = mine ? 1.0 : 0.0;
  communicator_->AllReduceMin({&all, 1});
  return all > 0.0;
}

void KeptSolver::Set(int n, std::vector<std::int32_t> row, std::vector<std::int32_t> column, std::vector<double> values) {
  if (!OnAll(n == n_ && row == row_ && column == column_)) {
    n_ = -1;  // until the analysis has succeeded
    row_ = std::move(row);
    column_ = std::move(column);
    values_.clear();
    solver_->Analyse(n, row_, column_);
    n_ = n;
  }
  SetValues(std::move(values));
}

void KeptSolver::SetValues(std::vector<double> values) {
  if (OnAll(!values_.empty() && values == values_)) return;
  values_.clear();  // until the factorisation has succeeded
  if (!OnAll(std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))) {
    RefuseMatrix(solver_->symmetry());
  }
  solver_->Factorise(values);
  values_ = std::move(values);
  if (SolvesAProbe()) return;
  values_.clear();
  RefuseMatrix(solver_->symmetry());
}

bool KeptSolver::SolvesAProbe() {
  std::vector<double> b(n_);
  for (int i = 0; i < n_; ++i) b[i] = std::sin(1.0 + i);
  std::vector<double> x = b;
  solver_->Solve(x);
  std::vector<double> defect = Defect(x, b);
  if (LargestOf(defect) <= 1e-6 * LargestOf(b)) return true;
  solver_->Solve(defect);
  for (int i = 0; i < n_; ++i) x[i] += defect[i];
  return LargestOf(Defect(x, b)) <= 1e-6 * LargestOf(b);
}

std::vector<double> KeptSolver::Defect(const std::vector<double>& x, const std::vector<double>& b) const {
  const bool is_half = solver_->symmetry() == Symmetry::kPositiveDefinite;
  std::vector<double> product(b.size(), 0.0), defect = b;
  for (std::size_t k = 0; k < row_.size(); ++k) {
    product[row_[k]] += values_[k] * x[column_[k]];
    if (is_half && row_[k] != column_[k]) product[column_[k]] += values_[k] * x[row_[k]];
  }
  if (solver_->is_distributed()) product = communicator_->AllGather(product);
  for (std::size_t i = 0; i < product.size(); ++i) defect[i % b.size()] -= product[i];
  return defect;
}

}  // namespace nscdd
