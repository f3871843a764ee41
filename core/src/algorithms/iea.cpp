// SPDX-License-Identifier: Apache-2.0
// Algorithm 4, the incomplete enriched algorithm: lines 4 to 16; the time stepper does the rest. polish_sweeps and
// closing_updates are not in the paper.
#include <algorithm>

#include "algorithms/algorithms.h"
#include "algorithms/stages.h"

namespace nscdd {
namespace {

/// Positions of the contacts that touch an interface body, of each subdomain.
std::vector<std::vector<std::int32_t>> InterfaceContacts(const PartitionedProblem& problem) {
  std::vector<std::vector<std::int32_t>> positions(problem.subdomains.size());
  for (std::size_t e = 0; e < positions.size(); ++e) {
    const SubdomainProblem& p = problem.subdomains[e];
    if (p.multiplicity.empty()) continue;
    VisitRows(p, [&](const auto& rows) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const bool touches = p.multiplicity[rows[k].a] > 1 || p.multiplicity[rows[k].b] > 1;
        if (touches) positions[e].push_back(static_cast<std::int32_t>(k));
      }
    });
  }
  return positions;
}

}  // namespace

SolveReport Solve(const PartitionedProblem& problem, const IeaOptions& options, Communicator* communicator,
                  InterfaceWorkspace* workspace, PartitionedState* state) {
  Monitor monitor(problem, options.stopping, communicator);
  Stages stages(problem, options.interface, communicator, workspace, state);
  stages.SweepSubdomains(1);  // lines 5, 6: the status of the contacts
  stages.MeasureJump();
  stages.UpdateInterface();  // lines 7, 8: the one interface problem, explicit
  const Stages::LocalResult local = stages.SolveSubdomains(options.stopping);  // lines 9 to 16
  stages.MeasureJump();

  std::int64_t sweeps = 1 + local.sweeps;
  if (options.polish_sweeps > 0) {
    const auto positions = InterfaceContacts(problem);
    for (int s = 0; s < options.polish_sweeps; ++s) {
      stages.GlueMeans();
      for (std::size_t e = 0; e < positions.size(); ++e) SweepSome(problem.subdomains[e], positions[e], &state->subdomains[e]);
      stages.MeasureJump();
    }
  }
  if (options.closing_updates > 0) {
    stages.GlueMeans();
    NscddOptions closing{options.stopping, options.partition, 1, {}};
    closing.stopping.max_iterations = options.closing_updates;
    SolveReport report = Solve(problem, closing, communicator, workspace, state);
    const bool at_limit = report.status == SolveStatus::kIterationLimit || report.status == SolveStatus::kFixed;
    if (at_limit && report.squeezed.empty()) report.status = SolveStatus::kIncomplete;
    report.iterations += local.sweeps;
    report.sweeps += sweeps;
    return stages.Close(std::move(report));
  }
  stages.SwapMeans();
  monitor.Measure(stages.statistics(), stages.jumps(), *state);
  monitor.Conclude(local.converged);
  return stages.Close(monitor.Finish(local.sweeps, sweeps, state));
}

}  // namespace nscdd
