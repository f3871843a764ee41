// SPDX-License-Identifier: Apache-2.0
#include "algorithms/algorithms.h"
#include "algorithms/anderson.h"
#include "algorithms/monitor.h"
#include "nlgs/sweep.h"

namespace nscdd {

SolveReport Solve(const PartitionedProblem& problem, const NscdOptions& options, Communicator* communicator,
                  InterfaceWorkspace*, PartitionedState* state) {
  Monitor monitor(problem, options.stopping, communicator, options.acceleration.method != Acceleration::kNone);
  const SubdomainProblem& sample = problem.subdomains.front();
  SubdomainState* iterate = &state->subdomains.front();
  Anderson anderson(problem, options.acceleration, nullptr, communicator, *state);
  int k = 1;
  for (;; ++k) {
    if (monitor.IsDue(k)) {
      const std::vector<SweepStatistics> statistics{SweepWithStatistics(sample, iterate)};
      if (monitor.Stops(k, statistics, {}, *state)) break;
    } else {
      Sweep(sample, iterate);
    }
    anderson.Extrapolate(k, state);
  }
  return anderson.Close(monitor.Finish(k, k, state));
}

}  // namespace nscdd
