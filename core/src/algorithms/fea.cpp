#include "algorithms/algorithms.h"
#include "algorithms/stages.h"

namespace nscdd {

SolveReport Solve(const PartitionedProblem& problem, const FeaOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state) {
  if (options.interface.lambda == 0.0) {
    return Solve(problem, NscddOptions{options.stopping, options.partition, options.sweeps_per_stage}, communicator, workspace, state);
  }
  Monitor monitor(problem, options.stopping, communicator, /*keep_best=*/true);
  Stages stages(problem, options.interface, communicator, workspace, state);
  int k = 1;
  for (;; ++k) {
    stages.SweepSubdomains(options.sweeps_per_stage);  // stage 1
    stages.MeasureJump();
    if (monitor.IsDue(k)) {
      // Copies do not agree after an augmented stage 2, but their mean U = V_f + M^-1 sum_E H_E r_E is what is solved for.
      stages.SwapMeans();
      if (monitor.Stops(k, stages.statistics(), stages.jumps(), *state)) break;
      stages.SwapMeans();
    }
    stages.UpdateInterface();  // stage 2
  }
  return stages.Close(monitor.Finish(k, static_cast<std::int64_t>(k) * options.sweeps_per_stage, state));
}

}  // namespace nscdd
