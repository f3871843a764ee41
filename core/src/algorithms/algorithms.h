#pragma once

#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// NonSmooth Contact Dynamics, the paper's reference: NLGS sweeps of the one subdomain until the criterion holds.
SolveReport Solve(const PartitionedProblem& problem, const NscdOptions& options, Communicator* communicator,
                  PartitionedState* state);

/// NonSmooth Contact Domain Decomposition, the paper's Algorithm 1.
SolveReport Solve(const PartitionedProblem& problem, const NscddOptions& options, Communicator* communicator,
                  PartitionedState* state);

}  // namespace nscdd
