// SPDX-License-Identifier: Apache-2.0
// Algorithm 2, the fully enriched algorithm, in the form of Algorithm 5: NSCDD whose stage 2 is the augmented interface
// problem. n_GS > 1 is Algorithm 5's; the paper measures n_GS = 1. Lines below are those of Algorithm 2.
#include <algorithm>
#include <cmath>

#include "algorithms/algorithms.h"
#include "algorithms/anderson.h"
#include "algorithms/stages.h"

namespace nscdd {
namespace {

/// Not in the paper. Where the jump of the copies has more than doubled in five or more updates, lambda is too large for what
/// n_GS sweeps undo: the next five updates are plain (lambda = 0), the next time ten, and so on.
class JumpGuard {
 public:
  void Watch(int update, double jump) {
    if (update - since_ < 5) return;
    if (jump > 2.0 * jump_) {
      plain_until_ = update + plain_updates_;
      plain_updates_ = std::min(2 * plain_updates_, 1 << 20);
    }
    jump_ = jump;
    since_ = update;
  }
  bool IsPlain(int update) const { return update < plain_until_; }

 private:
  int since_ = 0, plain_until_ = 0;
  int plain_updates_ = 5;
  double jump_ = INFINITY;
};

}  // namespace

SolveReport Solve(const PartitionedProblem& problem, const FeaOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state) {
  if (options.interface.lambda == 0.0) {
    const NscddOptions plain{options.stopping, options.partition, options.sweeps_per_stage, options.acceleration};
    return Solve(problem, plain, communicator, workspace, state);
  }
  Monitor monitor(problem, options.stopping, communicator, /*keep_best=*/true);
  monitor.Begin(*state);
  Stages stages(problem, options.interface, communicator, workspace, state);
  Anderson anderson(problem, options.acceleration, stages.gluing(), communicator, *state);
  JumpGuard guard;
  int k = 1;
  for (;; ++k) {
    const bool due = monitor.IsDue(k);
    stages.SweepSubdomains(options.sweeps_per_stage, due);  // stage 1, lines 2 and 3
    stages.MeasureJump();
    if (due) {  // line 6, before stage 2: what is tested is what the sweeps left
      // Copies do not agree after an augmented stage 2, but their mean U = V_f + M^-1 sum_E H_E r_E is what is solved for.
      stages.SwapMeans();
      if (monitor.Stops(k, stages.statistics(), stages.jumps(), *state)) break;
      stages.SwapMeans();
      guard.Watch(k, monitor.residuals().interface_jump);
    }
    stages.UpdateInterface(options.jump_guard && guard.IsPlain(k));   // stage 2, lines 4 and 5: eq. (13)
    anderson.Extrapolate(k, state, due ? monitor.LoadScale() : 1.0);  // not in the paper
  }
  return stages.Close(anderson.Close(monitor.Finish(k, static_cast<std::int64_t>(k) * options.sweeps_per_stage, state)));
}

}  // namespace nscdd
