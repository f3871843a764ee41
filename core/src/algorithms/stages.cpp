// SPDX-License-Identifier: Apache-2.0
#include "algorithms/stages.h"

#include <algorithm>

#include "nlgs/residual.h"
#include "parallel/ordered_reduction.h"

namespace nscdd {

Stages::Stages(const PartitionedProblem& problem, Communicator* communicator, PartitionedState* state)
    : problem_(problem),
      communicator_(communicator),
      state_(state),
      gluing_(problem.subdomains, problem.interface, communicator),
      statistics_(problem.subdomains.size()) {}

Stages::Stages(const PartitionedProblem& problem, const AugmentedInterfaceOptions& options, Communicator* communicator,
               InterfaceWorkspace* workspace, PartitionedState* state)
    : Stages(problem, communicator, state) {
  is_direct_ = options.solve == InterfaceSolve::kDirect;
  const bool several = problem.subdomains.size() > 1 || communicator->size() > 1;
  if (options.lambda == 0.0 || !several) return;
  augmented_ = std::make_unique<AugmentedInterface>(problem, options, communicator, workspace);
  if (augmented_->NeedsLeftVelocities()) left_.resize(problem.subdomains.size());
}

void Stages::SweepSubdomains(int sweeps, bool measured) {
  for (std::size_t e = 0; e < problem_.subdomains.size(); ++e) {
    const SubdomainProblem& problem = problem_.subdomains[e];
    SubdomainState* state = &state_->subdomains[e];
    for (int s = 1; s < sweeps; ++s) Sweep(problem, state);
    // All three sweep alike; they differ in what they write down.
    if (!left_.empty()) {
      statistics_[e] = SweepRecording(problem, state, &left_[e]);
    } else if (measured) {
      statistics_[e] = SweepWithStatistics(problem, state);
    } else {
      Sweep(problem, state);
    }
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
    // A subdomain tests itself without asking the others: they may need other numbers of sweeps.
    const bool last = *sweeps >= stopping.max_iterations;
    if (*sweeps % stopping.test_every != 0 && !last) {
      Sweep(problem, state);
      continue;
    }
    statistics_[e] = SweepWithStatistics(problem, state);
    const StagnationMeasures s = Stagnation(statistics_[e], problem_.scales);
    const NaturalParts n = NaturalResidual(problem, *state, Masses::kDivided);
    Residuals r;
    SetNatural(n, problem_.scales, &r);
    r.quad = s.quad;
    r.maxm = s.maxm;
    r.qm16 = s.qm16;
    if (Measure(stopping.criterion, r) <= stopping.tolerance) return true;
    if (last) return false;
  }
}

Stages::LocalResult Stages::SolveSubdomains(const StoppingOptions& stopping) {
  struct Most {
    double sweeps, unconverged;
  };
  std::vector<ReductionPart<None, Most>> parts(problem_.subdomains.size());
  // No message is sent until all subdomains of this rank are done.
  for (std::size_t e = 0; e < parts.size(); ++e) {
    int sweeps = 0;
    const bool converged = SolveSubdomain(e, stopping, &sweeps);
    parts[e].max = {static_cast<double>(sweeps), converged ? 0.0 : 1.0};
  }
  const Most most = ReduceInOrder(parts, communicator_).max;
  return {static_cast<int>(most.sweeps), most.unconverged == 0.0};
}

SolveReport Stages::Close(SolveReport report) {
  report.interface_updates += updates_;
  if (!augmented_) return report;
  const InterfaceCounters& c = augmented_->counters();
  report.cg_iterations = c.cg_iterations;
  report.cg_failures = c.cg_failures;
  // Every rank factorises the assembled matrix; the subdomains' own are counted once each.
  struct Work {
    double analyses, factorisations;
  };
  std::vector<ReductionPart<Work>> parts(problem_.subdomains.size());
  parts.front().sum = {static_cast<double>(c.analyses), static_cast<double>(c.factorisations)};
  const Work all = ReduceInOrder(parts, communicator_).sum;
  const double ranks = is_direct_ ? communicator_->size() : 1.0;
  report.analyses = static_cast<std::int64_t>(all.analyses / ranks);
  report.factorisations = static_cast<std::int64_t>(all.factorisations / ranks);
  report.seconds_interface = c.seconds;
  return report;
}

}  // namespace nscdd
