// SPDX-License-Identifier: Apache-2.0
// Algorithm 3, the relaxed enriched algorithm: both stages until the interface has converged, then each subdomain by itself.
#include "algorithms/algorithms.h"
#include "algorithms/stages.h"

namespace nscdd {

SolveReport Solve(const PartitionedProblem& problem, const ReaOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state) {
  Monitor monitor(problem, options.stopping, communicator);
  Stages stages(problem, options.interface, communicator, workspace, state);
  // Lines 1 to 9, It2 iterations. The test of line 6 sees the jump only.
  int it2 = 1;
  for (;; ++it2) {
    stages.SweepSubdomains(options.sweeps_per_stage);  // lines 2, 3
    stages.MeasureJump();
    if (it2 % options.stopping.test_every == 0) {
      stages.SwapMeans();
      const double eta = monitor.Measure(stages.statistics(), stages.jumps(), *state).relative_jump;
      stages.SwapMeans();
      if (eta <= options.stopping.tolerance || monitor.RunsAway()) break;
    }
    stages.UpdateInterface();  // lines 4, 5
    if (it2 >= options.max_interface_updates) break;
  }
  // Lines 10 to 16, It3 iterations: the interface impulses stay as they are.
  const Stages::LocalResult local = stages.SolveSubdomains(options.stopping);
  stages.MeasureJump();
  stages.SwapMeans();
  monitor.Measure(stages.statistics(), stages.jumps(), *state);
  monitor.Conclude(local.converged);
  const std::int64_t sweeps = static_cast<std::int64_t>(it2) * options.sweeps_per_stage + local.sweeps;
  return stages.Close(monitor.Finish(it2 + local.sweeps, sweeps, state));
}

}  // namespace nscdd
