#include "algorithms/algorithms.h"
#include "algorithms/monitor.h"
#include "nlgs/sweep.h"

namespace nscdd {

SolveReport Solve(const PartitionedProblem& problem, const NscdOptions& options, Communicator* communicator,
                  InterfaceWorkspace*, PartitionedState* state) {
  Monitor monitor(problem, options.stopping, communicator);
  const SubdomainProblem& sample = problem.subdomains.front();
  SubdomainState* iterate = &state->subdomains.front();
  int k = 1;
  for (;; ++k) {
    if (!monitor.IsDue(k)) {
      Sweep(sample, iterate);
      continue;
    }
    const std::vector<SweepStatistics> statistics{SweepWithStatistics(sample, iterate)};
    if (monitor.Stops(k, statistics, {}, *state)) break;
  }
  return monitor.Finish(k, k, state);
}

}  // namespace nscdd
