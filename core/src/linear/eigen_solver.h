// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "linear/linear_solver.h"

namespace nscdd {

/// Eigen: simplicial LDL^T with AMD order for positive definite matrices, supernodal LU with partial pivoting and COLAMD order
/// for general ones.
std::unique_ptr<LinearSolver> MakeEigenSolver(Symmetry symmetry);

}  // namespace nscdd
