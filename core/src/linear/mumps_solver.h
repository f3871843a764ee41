// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "linear/linear_solver.h"

namespace nscdd {

/// MUMPS, SYM = 1 (positive definite) or 0 (general), on the communicator with the given Fortran handle. `distributed`: the
/// ranks of the communicator share the matrix (ICNTL(18) = 3). Throws Error with MUMPS's error code as a sentence.
std::unique_ptr<LinearSolver> MakeMumpsSolver(int fortran_communicator, bool distributed, Symmetry symmetry);

}  // namespace nscdd
