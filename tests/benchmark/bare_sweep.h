// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "problem/subdomain_problem.h"

namespace nscdd::benchmark {

/// One Gauss-Seidel sweep written down plainly: the product's arrays, law and contact order, and nothing else. `velocity`,
/// `inverse_mass` and `impulse` as in SubdomainProblem and SubdomainState.
void BareSweep(const std::vector<NormalRow>& rows, const double* inverse_mass, double* velocity, double* impulse);
void BareSweep(const std::vector<FrictionRow>& rows, const double* inverse_mass, double* velocity, double* impulse);

}  // namespace nscdd::benchmark
