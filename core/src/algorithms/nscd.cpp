// SPDX-License-Identifier: Apache-2.0
// NonSmooth Contact Dynamics, the paper's reference: eq. (2) by nonlinear Gauss-Seidel, the whole sample in one subdomain.
#include "algorithms/algorithms.h"
#include "algorithms/anderson.h"
#include "algorithms/stages.h"

namespace nscdd {

SolveReport Solve(const PartitionedProblem& problem, const NscdOptions& options, Communicator* communicator,
                  InterfaceWorkspace*, PartitionedState* state) {
  Monitor monitor(problem, options.stopping, communicator, options.acceleration.method != Acceleration::kNone);
  monitor.Begin(*state);
  Stages stages(problem, communicator, state);
  Anderson anderson(problem, options.acceleration, stages.gluing(), communicator, *state);
  int k = 1;
  for (;; ++k) {
    const bool due = monitor.IsDue(k);
    stages.SweepSubdomains(1, due);
    if (due && monitor.Stops(k, stages.statistics(), {}, *state)) break;
    anderson.Extrapolate(k, state, due ? monitor.LoadScale() : 1.0);  // not in the paper
  }
  return stages.Close(anderson.Close(monitor.Finish(k, k, state)));
}

}  // namespace nscdd
