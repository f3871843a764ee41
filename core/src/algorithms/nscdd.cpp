// SPDX-License-Identifier: Apache-2.0
#include "algorithms/algorithms.h"
#include "algorithms/anderson.h"
#include "algorithms/monitor.h"
#include "interface/gluing.h"
#include "nlgs/sweep.h"

namespace nscdd {

SolveReport Solve(const PartitionedProblem& problem, const NscddOptions& options, Communicator* communicator,
                  InterfaceWorkspace*, PartitionedState* state) {
  Monitor monitor(problem, options.stopping, communicator, options.acceleration.method != Acceleration::kNone);
  Gluing gluing(problem.subdomains, problem.interface, communicator);
  Anderson anderson(problem, options.acceleration, &gluing, communicator, *state);
  std::vector<SweepStatistics> statistics(problem.subdomains.size());
  std::vector<JumpPart> jumps;
  const int n_gs = options.sweeps_per_stage;
  int k = 1;
  for (;; ++k) {
    const bool due = monitor.IsDue(k);
    // Stage 1, in every subdomain: n_GS sweeps with the interface impulses F_E fixed.
    for (std::size_t e = 0; e < problem.subdomains.size(); ++e) {
      for (int s = 1; s < n_gs; ++s) Sweep(problem.subdomains[e], &state->subdomains[e]);
      if (due) {
        statistics[e] = SweepWithStatistics(problem.subdomains[e], &state->subdomains[e]);
      } else {
        Sweep(problem.subdomains[e], &state->subdomains[e]);
      }
    }
    // Stage 2, on the interface:  X dF = [V],  F += dF.
    gluing.Measure(state->subdomains, &jumps);
    gluing.Glue(&state->subdomains, &state->interface);
    if (due && monitor.Stops(k, statistics, jumps, *state)) break;
    anderson.Extrapolate(k, state);
  }
  SolveReport report = anderson.Close(monitor.Finish(k, static_cast<std::int64_t>(k) * n_gs, state));
  report.interface_updates = k;
  return report;
}

}  // namespace nscdd
