// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interface/augmented_interface.h"
#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

// Every solver starts from the impulses in `state` (V_E = V_f + M~_E^-1 (H_E r_E - F_E)) and ends with V_E = U, the mean over
// the copies. `workspace` keeps factorisations between solves; those that need none do not touch it. Collective.

/// NonSmooth Contact Dynamics, the paper's reference: NLGS sweeps of the one subdomain until the criterion holds.
SolveReport Solve(const PartitionedProblem& problem, const NscdOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state);

/// NonSmooth Contact Domain Decomposition, the paper's Algorithm 1.
SolveReport Solve(const PartitionedProblem& problem, const NscddOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state);

/// Fully enriched algorithm, the paper's Algorithm 2. lambda = 0 is NSCDD.
SolveReport Solve(const PartitionedProblem& problem, const FeaOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state);

/// Relaxed enriched algorithm, the paper's Algorithm 3.
SolveReport Solve(const PartitionedProblem& problem, const ReaOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state);

/// Incomplete enriched algorithm, the paper's Algorithm 4.
SolveReport Solve(const PartitionedProblem& problem, const IeaOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state);

/// Interior point iterations on one subdomain, which start cold whatever `state` says, and plain sweeps from it beside them.
/// Best tested iterate.
SolveReport Solve(const PartitionedProblem& problem, const NewtonOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state);

/// The algorithm that the options name. Without any contact: converged, at once.
SolveReport SolveAny(const PartitionedProblem& problem, const AlgorithmOptions& options, Communicator* communicator,
                     InterfaceWorkspace* workspace, PartitionedState* state);

}  // namespace nscdd
