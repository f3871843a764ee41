// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "nscdd/communicator.h"
#include "nscdd/options.h"

namespace nscdd {

/// Work of a solver since it was made.
struct LinearCounters {
  std::int64_t analyses = 0;        ///< symbolic factorisations
  std::int64_t factorisations = 0;  ///< numeric ones
  std::int64_t solves = 0;
};

enum class Symmetry {
  kPositiveDefinite,  ///< the lower triangle is given, row >= column
  kGeneral,           ///< the whole matrix is given
};

/// Sparse systems A x = b. The entries are given as triplets whose pattern stays while their values change; entries at the same
/// place are added.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// True if the matrix is shared by the ranks of a communicator: each gives its own entries, calls are collective, right-hand
  /// sides and solutions are complete on every rank. False: this process gives all of it.
  virtual bool is_distributed() const = 0;
  virtual Symmetry symmetry() const = 0;

  /// New pattern of an n x n matrix; rows and columns count from 0.
  virtual void Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) = 0;
  /// Numbers for the triplets of Analyse(), finite. Refuses a matrix whose factors have pivots that are not positive
  /// (kPositiveDefinite) or vanish; throws Error if memory runs out.
  virtual void Factorise(std::span<const double> values) = 0;
  /// x := A^-1 x.
  virtual void Solve(std::span<double> x) = 0;

  const LinearCounters& counters() const { return counters_; }

 protected:
  LinearCounters counters_;
};

/// Throws the Error for a matrix that cannot be factorised: not finite, singular, or not positive definite where it has to be,
/// to working precision.
[[noreturn]] void RefuseMatrix(Symmetry symmetry);

/// A solver for this process alone. MUMPS needs MPI to be initialised; throws Error with the mend if it is not.
/// kAuto is Eigen, whoever started the program: results must not depend on the launcher.
std::unique_ptr<LinearSolver> MakeLocalSolver(LinearLibrary library, Symmetry symmetry = Symmetry::kPositiveDefinite);

/// A solver for a positive definite matrix that belongs to all ranks: MUMPS over the ranks, or Eigen with the whole matrix on
/// each of them.
std::unique_ptr<LinearSolver> MakeSharedSolver(LinearLibrary library, Communicator* communicator);

}  // namespace nscdd
