#pragma once

#include <vector>

#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Watches an iteration: measures it every test_every iterations and decides when it stops. All ranks decide the same.
class Monitor {
 public:
  /// `keep_best`: the impulses of the best tested iterate are kept and returned if the iteration diverges.
  Monitor(const PartitionedProblem& problem, const StoppingOptions& options, Communicator* communicator, bool keep_best = false);

  /// Whether this iteration is tested (then sweep it with statistics).
  bool IsDue(int iteration) const { return iteration % options_.test_every == 0 || iteration >= options_.max_iterations; }

  /// Measures after the copies were glued; true when the iteration ends. `statistics` and `jumps` have one part per subdomain, the
  /// latter may be empty. The measures of a sweep's change (quad, maxm, qm16) also ask for eta < tolerance: they do not see the
  /// interface; the natural residuals do not need it, V = V_f + M^-1 H r being the mean of the copies. Collective.
  bool Stops(int iteration, const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
             const PartitionedState& state);

  /// Measures without deciding. Collective.
  const Residuals& Measure(const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
                           const PartitionedState& state);
  /// How an incomplete resolution ended, after Measure(): converged if the criterion holds all the same.
  void Conclude(bool subdomains_converged);

  /// The report, with counts of the final state. On divergence the impulses are those of the best iterate, or zero, V_E is
  /// V_f + M~^-1 H_E r_E and F is zero; an interface is then glued by the caller. Collective.
  SolveReport Finish(int iterations, std::int64_t sweeps, PartitionedState* state);
  bool has_diverged() const { return report_.status == SolveStatus::kDiverged; }

 private:
  void MeasureAll(const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
                  const PartitionedState& state);
  void Stop(SolveStatus status, std::string reason);
  double CriterionNow() const;
  void KeepBest(const PartitionedState& state);
  void RestoreBest(PartitionedState* state);
  void CountContacts(const PartitionedState& state);
  void FindWorst();

  const PartitionedProblem& problem_;
  StoppingOptions options_;
  Communicator* communicator_;
  SolveReport report_;
  NaturalParts worst_;   // of this rank's subdomains
  double first_ = -1.0;  // measure at the first test
  double best_ = 0.0;
  int best_iteration_ = 0;
  bool keep_best_;
  std::vector<std::vector<double>> best_impulse_;
  Residuals best_residuals_;
};

/// The empty problem's report: converged without iterations.
SolveReport ReportWithoutContacts(const PartitionedProblem& problem);

}  // namespace nscdd
