// SPDX-License-Identifier: Apache-2.0
#include "algorithms/algorithms.h"
#include "algorithms/stages.h"

namespace nscdd {

SolveReport Solve(const PartitionedProblem& problem, const ReaOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state) {
  Monitor monitor(problem, options.stopping, communicator);
  Stages stages(problem, options.interface, communicator, workspace, state);
  // Both stages until the interface converges: It2 iterations. The test sees the jump only.
  int it2 = 1;
  for (;; ++it2) {
    stages.SweepSubdomains(options.sweeps_per_stage);
    stages.MeasureJump();
    if (it2 % options.stopping.test_every == 0) {
      stages.SwapMeans();
      const double eta = monitor.Measure(stages.statistics(), stages.jumps(), *state).relative_jump;
      stages.SwapMeans();
      if (eta <= options.stopping.tolerance || monitor.RunsAway()) break;
    }
    stages.UpdateInterface();
    if (it2 >= options.max_interface_updates) break;
  }
  // Then the subdomains by themselves: It3 iterations.
  const Stages::LocalResult local = stages.SolveSubdomains(options.stopping);
  stages.MeasureJump();
  stages.SwapMeans();
  monitor.Measure(stages.statistics(), stages.jumps(), *state);
  monitor.Conclude(local.converged);
  const std::int64_t sweeps = static_cast<std::int64_t>(it2) * options.sweeps_per_stage + local.sweeps;
  return stages.Close(monitor.Finish(it2 + local.sweeps, sweeps, state));
}

}  // namespace nscdd
