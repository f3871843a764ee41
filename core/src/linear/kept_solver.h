// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "linear/linear_solver.h"

namespace nscdd {

/// A linear solver that keeps its symbolic factorisation while the pattern stays, and its numeric one while the values stay too
/// (until it is told to forget them). It judges both libraries alike: it refuses numbers that are not finite, and a
/// factorisation that leaves |A x - b| > 1e-6 |b| (largest components) on a probe b after one step of refinement.
class KeptSolver {
 public:
  /// `communicator`: of the ranks that share the solver's matrix.
  KeptSolver(std::unique_ptr<LinearSolver> solver, Communicator* communicator)
      : solver_(std::move(solver)), communicator_(communicator) {}

  /// The matrix for the Solve() calls that follow; factorised only if it is another one than before.
  void Set(int n, std::vector<std::int32_t> row, std::vector<std::int32_t> column, std::vector<double> values);
  /// The same with the pattern of before.
  void SetValues(std::vector<double> values);
  /// The next Set() factorises whatever its values are. On all ranks that share the matrix.
  void ForgetValues() { values_.clear(); }
  void Solve(std::span<double> x) { solver_->Solve(x); }

  bool is_distributed() const { return solver_->is_distributed(); }
  const LinearCounters& counters() const { return solver_->counters(); }

 private:
  bool SolvesAProbe();
  /// b - A x, complete on every rank that shares the matrix.
  std::vector<double> Defect(const std::vector<double>& x, const std::vector<double>& b) const;
  /// The same answer on all ranks that share the matrix.
  bool OnAll(bool mine) const;

  std::unique_ptr<LinearSolver> solver_;
  Communicator* communicator_;
  int n_ = -1;
  std::vector<std::int32_t> row_, column_;
  std::vector<double> values_;
};

}  // namespace nscdd
