// SPDX-License-Identifier: Apache-2.0
#include "algorithms/stages.h"

#include <algorithm>

#include "nlgs/residual.h"
#include "parallel/ordered_reduction.h"

namespace nscdd {

Stages::Stages(const PartitionedProblem& problem, const AugmentedInterfaceOptions& options, Communicator* communicator,
               InterfaceWorkspace* workspace, PartitionedState* state)
    : problem_(problem),
      communicator_(communicator),
      state_(state),
      gluing_(problem.subdomains, problem.interface, communicator),
      is_direct_(options.solve == InterfaceSolve::kDirect),
      statistics_(problem.subdomains.size()) {
  const bool several = problem.subdomains.size() > 1 || communicator->size() > 1;
  if (options.lambda == 0.0 || !several) return;
  augmented_ = std::make_unique<AugmentedInterface>(problem, options, communicator, workspace);
  if (augmented_->NeedsLeftVelocities()) left_.resize(problem.subdomains.size());
}

void Stages::SweepSubdomains(int sweeps) {
  for (std::size_t e = 0; e < problem_.subdomains.size(); ++e) {
    for (int s = 1; s < sweeps; ++s) Sweep(problem_.subdomains[e], &state_->subdomains[e]);
    statistics_[e] = left_.empty() ? SweepWithStatistics(problem_.subdomains[e], &state_->subdomains[e])
                                   : SweepRecording(problem_.subdomains[e], &state_->subdomains[e], &left_[e]);
  }
}

void Stages::UpdateInterface(bool plain) {
  ++updates_;
  if (augmented_ && !plain) {
    augmented_->Update(gluing_, left_, state_);
  } else {
    gluing_.Glue(&state_->subdomains, &state_->interface);
  }
}

bool Stages::SolveSubdomain(std::size_t e, const StoppingOptions& stopping, int* sweeps) {
  const SubdomainProblem& problem = problem_.subdomains[e];
  SubdomainState* state = &state_->subdomains[e];
  if (problem.contact_count() == 0) return true;
  for (*sweeps = 1;; ++*sweeps) {
    const bool last = *sweeps >= stopping.max_iterations;
    if (*sweeps % stopping.test_every != 0 && !last) {
      Sweep(problem, state);
      continue;
    }
    statistics_[e] = SweepWithStatistics(problem, state);
    const StagnationMeasures s = Stagnation(statistics_[e], problem_.scales);
    const NaturalParts n = NaturalResidual(problem, *state, Masses::kDivided);
    Residuals r;
    r.nat = Nat(n.sum_e2, n.sum_r2, problem_.scales);
    r.nat_max = NatMax(n.worst, problem_.scales);
    r.quad = s.quad;
    r.maxm = s.maxm;
    r.qm16 = s.qm16;
    if (Measure(stopping.criterion, r) <= stopping.tolerance) return true;
    if (last) return false;
  }
}

Stages::LocalResult Stages::SolveSubdomains(const StoppingOptions& stopping) {
  std::vector<ReductionPart<0, 2>> parts(problem_.subdomains.size());
  for (std::size_t e = 0; e < parts.size(); ++e) {
    int sweeps = 0;
    const bool converged = SolveSubdomain(e, stopping, &sweeps);
    parts[e] = {static_cast<double>(sweeps), converged ? 0.0 : 1.0};
  }
  const auto t = ReduceInOrder<0, 2>(parts, communicator_);
  return {static_cast<int>(t[0]), t[1] == 0.0};
}

SolveReport Stages::Close(SolveReport report) {
  report.interface_updates += updates_;
  if (!augmented_) return report;
  const InterfaceCounters& c = augmented_->counters();
  report.cg_iterations = c.cg_iterations;
  report.cg_failures = c.cg_failures;
  // Every rank factorises the assembled matrix; the subdomains' own are counted once each.
  std::vector<ReductionPart<2, 0>> parts(problem_.subdomains.size());
  for (auto& part : parts) part = {};
  parts.front() = {static_cast<double>(c.analyses), static_cast<double>(c.factorisations)};
  const auto t = ReduceInOrder<2, 0>(parts, communicator_);
  const double ranks = is_direct_ ? communicator_->size() : 1.0;
  report.analyses = static_cast<std::int64_t>(t[0] / ranks);
  report.factorisations = static_cast<std::int64_t>(t[1] / ranks);
  report.seconds_interface = c.seconds;
  return report;
}

}  // namespace nscdd
