// SPDX-License-Identifier: Apache-2.0
// Algorithm 1, NonSmooth Contact Domain Decomposition: the loop of lines 4 to 14; the time stepper does the rest. (How lines
// are counted: core/README.md.)
#include "algorithms/algorithms.h"
#include "algorithms/anderson.h"
#include "algorithms/stages.h"

namespace nscdd {

SolveReport Solve(const PartitionedProblem& problem, const NscddOptions& options, Communicator* communicator,
                  InterfaceWorkspace*, PartitionedState* state) {
  Monitor monitor(problem, options.stopping, communicator, options.acceleration.method != Acceleration::kNone);
  monitor.Begin(*state);
  Stages stages(problem, communicator, state);
  Anderson anderson(problem, options.acceleration, stages.gluing(), communicator, *state);
  int k = 1;
  for (;; ++k) {
    const bool due = monitor.IsDue(k);
    // Stage 1, lines 5 to 10. V_E carries -M~_E^-1 F_E already (lines 6, 7), and the sweeps keep it (line 11).
    stages.SweepSubdomains(options.sweeps_per_stage, due);
    // Stage 2, lines 12 and 13:  X dF = [V],  F += dF, which amounts to the mean over the copies.
    stages.MeasureJump();
    stages.UpdateInterface();
    if (due && monitor.Stops(k, stages.statistics(), stages.jumps(), *state)) break;  // line 4
    anderson.Extrapolate(k, state, due ? monitor.LoadScale() : 1.0);                  // not in the paper
  }
  return stages.Close(anderson.Close(monitor.Finish(k, static_cast<std::int64_t>(k) * options.sweeps_per_stage, state)));
}

}  // namespace nscdd
