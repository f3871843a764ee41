// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "problem/subdomain_problem.h"

namespace nscdd {

/// What one sweep changed in one subdomain, after LMGC90: dv = W dr, rbar = (r_old + r_new) / 2, means of old and new of
/// r.Wr and |Wr|^2; W is the diagonal block with the subdomain's masses.
struct SweepStatistics {
  std::int64_t active = 0;  ///< contacts with rbar != 0
  double sum_dv2 = 0.0;
  double sum_dv2_r2 = 0.0;
  double sum_rwr = 0.0;
  double sum_wr2 = 0.0;
  double max_dv = 0.0;
  double max_dv_r = 0.0;
};

/// One nonlinear Gauss-Seidel sweep over the contacts in their order; keeps V_E = V_f + M~^-1 (H r - F).
void Sweep(const SubdomainProblem& problem, SubdomainState* state);

/// The same, with statistics.
SweepStatistics SweepWithStatistics(const SubdomainProblem& problem, SubdomainState* state);

/// The same; `left` gets the tangential velocity v_t that each local solve leaves (per contact).
SweepStatistics SweepRecording(const SubdomainProblem& problem, SubdomainState* state, std::vector<double>* left);

/// One sweep over the contacts with the given positions only, in their order.
void SweepSome(const SubdomainProblem& problem, const std::vector<std::int32_t>& positions, SubdomainState* state);

}  // namespace nscdd
