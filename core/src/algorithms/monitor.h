// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "interface/gluing.h"
#include "nlgs/residual.h"
#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Watches an iteration: measures it every test_every iterations and decides when it stops. All ranks decide the same.
class Monitor {
 public:
  /// `keep_best`: the best tested iterate is kept, and returned unless the last one is better.
  Monitor(const PartitionedProblem& problem, const StoppingOptions& options, Communicator* communicator,
          bool keep_best = false);

  /// Before the first iteration: load_error then sees what iterations still change. Collective.
  void Begin(const PartitionedState& state);

  /// Whether this iteration is tested (then sweep it with statistics).
  bool IsDue(int iteration) const { return iteration % options_.test_every == 0 || iteration >= options_.max_iterations; }

  /// Measures after the copies were glued; true when the iteration ends. `statistics` and `jumps` have one part per subdomain,
  /// the latter may be empty. The measures of a sweep's change (quad, maxm, qm16) also ask for eta < tolerance: they do not see
  /// the interface; the natural residuals do not need it, V = V_f + M^-1 H r being the mean of the copies. Collective.
  bool Stops(int iteration, const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
             const PartitionedState& state);

  /// Measures without deciding. Collective.
  const Residuals& Measure(const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
                           const PartitionedState& state);
  /// The last measurement is no number, or so much worse than the first that the impulses run away; nat, which is relative to
  /// them, then stays near 1.
  bool RunsAway() const;
  /// How an incomplete resolution ended, after Measure(): converged if the criterion holds all the same.
  void Conclude(bool subdomains_converged);

  /// Ends an iteration that cannot go on: the status is stalled.
  void GiveUp(std::string reason) { Stop(SolveStatus::kStalled, std::move(reason)); }
  /// 1 - S of the last test, in [1/2, 2]: with that factor of all impulses S would vanish. 1 where power is above 1, and
  /// where S is below 0.004, and for five iterations after another factor.
  double LoadScale();
  const Residuals& residuals() const { return report_.residuals; }

  /// The report, with counts of the final state: that of the last test, or the best one kept if it was better. Where the
  /// iteration diverged and none was kept, all impulses are zero. Collective.
  SolveReport Finish(int iterations, std::int64_t sweeps, PartitionedState* state);

 private:
  void MeasureAll(const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
                  const PartitionedState& state);
  void SeeDrift(int iteration);
  void Stop(SolveStatus status, std::string reason);
  double CriterionNow() const;
  std::string Standing() const;
  bool IsSqueezed() const;
  std::string ReasonOfSuccess() const;
  void KeepBest(const PartitionedState& state);
  void RestoreBest(PartitionedState* state);
  void SetZero(PartitionedState* state) const;
  void CountContacts(const PartitionedState& state);
  void FindWorst();

  struct TestedMomentum {
    int iteration;
    Vec2 momentum;  // sum of M (V - V_f) [N s]
  };

  const PartitionedProblem& problem_;
  StoppingOptions options_;
  Communicator* communicator_;
  SolveReport report_;
  NaturalParts total_;                   // of all subdomains, at the last measurement
  std::vector<TestedMomentum> momenta_;  // of all tests; empty without Begin()
  NaturalParts worst_;                   // of this rank's subdomains
  double first_ = -1.0;                  // what was tested at the first test
  double first_criterion_ = -1.0;        // the criterion alone, likewise
  double first_nat_max_ = -1.0;          // at the first measurement; < 0: none yet
  double best_ = 0.0;
  int best_iteration_ = 0;
  int scaled_at_ = 0;
  bool keep_best_;
  PartitionedState best_state_;
  Residuals best_residuals_;
  NaturalParts best_worst_;
};

/// The empty problem's report: converged without iterations.
SolveReport ReportWithoutContacts(const PartitionedProblem& problem);

}  // namespace nscdd
