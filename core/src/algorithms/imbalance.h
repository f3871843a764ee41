// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/communicator.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Momentum that the worst free body has out of nothing,
///     max over bodies of |M (V - V_f) - sum_E H_E r_E|_(M^-1) / max(velocity scale, |r_c| / M of its contacts)  [-],
/// spins in the energy norm, sqrt(I / M) w. Copies must agree (or carry their mean). Each copy lacks -F_E of its balance; what
/// is left is the sum over the copies. One pass over the contacts and one average; collective.
double WorstImbalance(const PartitionedProblem& problem, const PartitionedState& state, Communicator* communicator);

}  // namespace nscdd
