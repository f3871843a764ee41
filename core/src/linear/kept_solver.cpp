// SPDX-License-Identifier: Apache-2.0
#include "linear/kept_solver.h"

#include <utility>

namespace nscdd {

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
  solver_->Factorise(values);
  values_ = std::move(values);
}

}  // namespace nscdd
