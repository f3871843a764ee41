// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/communicator.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Ids, ascending and at most 64, of the bodies at the contacts that violate most: those whose p_c (residual.h) is at least a
/// thousandth of the largest. Where no solution exists it is there that impulses grow. The same on all ranks; collective.
std::vector<std::int64_t> SqueezedBodies(const PartitionedProblem& problem, const PartitionedState& state,
                                         Communicator* communicator);

}  // namespace nscdd
