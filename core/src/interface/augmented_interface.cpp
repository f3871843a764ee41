// SPDX-License-Identifier: Apache-2.0
#include "interface/augmented_interface.h"

#include <algorithm>
#include <chrono>

#include "interface/conjugate_gradient.h"
#include "interface/direct_interface.h"

namespace nscdd {
namespace {

LinearCounters CountersOf(const InterfaceWorkspace& workspace) {
  LinearCounters sum;
  const auto add = [&](const std::unique_ptr<KeptSolver>& solver) {
    if (!solver) return;
    sum.analyses += solver->counters().analyses;
    sum.factorisations += solver->counters().factorisations;
  };
  add(workspace.shared);
  for (const auto& solver : workspace.local) add(solver);
  for (const auto& solver : workspace.interior) add(solver);
  return sum;
}

/// restoring max(0, -gap) / dt of each contact; empty without it.
std::vector<double> RestoringSpeeds(const PartitionedProblem& problem, const SubdomainProblem& p,
                                    const AugmentedInterfaceOptions& options) {
  std::vector<double> speeds;
  if (options.restoring == 0.0 || problem.dt == 0.0) return speeds;
  for (const std::int32_t c : p.contact)
    speeds.push_back(options.restoring * std::max(0.0, -problem.contacts->gap[c]) / problem.dt);
  return speeds;
}

/// A numeric factorisation does not outlive the solve: work is counted the same way in a run that was interrupted and resumed.
void ForgetValues(InterfaceWorkspace* workspace) {
  if (workspace->shared) workspace->shared->ForgetValues();
  for (const auto& solver : workspace->local) solver->ForgetValues();
  for (const auto& solver : workspace->interior) solver->ForgetValues();
}

}  // namespace

AugmentedInterface::AugmentedInterface(const PartitionedProblem& problem, const AugmentedInterfaceOptions& options,
                                       Communicator* communicator, InterfaceWorkspace* workspace)
    : problem_(problem),
      options_(options),
      workspace_(workspace),
      average_(problem.interface, AugmentedSubdomain::DofsFor(problem.model, options.compatibility), communicator) {
  ForgetValues(workspace);
  const double mass = options.reference_mass > 0.0 ? options.reference_mass : problem.mean_mass;
  for (const SubdomainProblem& p : problem.subdomains)
    parts_.emplace_back(p, options, mass, RestoringSpeeds(problem, p, options));
  if (options.solve == InterfaceSolve::kDirect) {
    if (!workspace->shared) {
      workspace->shared = std::make_unique<KeptSolver>(MakeSharedSolver(options.linear_solver, communicator), communicator);
    }
    direct_ = std::make_unique<Direct>(problem, parts_, communicator, workspace->shared.get());
  } else {
    cg_ = std::make_unique<ConjugateGradient>(problem, parts_, options, communicator, workspace);
  }
}

AugmentedInterface::~AugmentedInterface() = default;

void AugmentedInterface::Update(const Gluing& gluing, const std::vector<std::vector<double>>& left, PartitionedState* state) {
  const auto start = std::chrono::steady_clock::now();
  const LinearCounters before = CountersOf(*workspace_);
  const auto left_of = [&](std::size_t e) {
    return left.empty() ? std::span<const double>{} : std::span<const double>(left[e]);
  };
  // The contacts that are active now decide about the columns of G_E, and with them about the matrix.
  std::vector<std::vector<double>> y;
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    parts_[e].ChooseColumns(state->subdomains[e]);
    y.push_back(parts_[e].RightHandSide(state->subdomains[e], left_of(e)));
  }
  const InterfaceMap& map = problem_.interface;
  const int dofs = parts_.front().dofs();
  std::vector<double> change(dofs * map.copies.size());
  if (direct_) {
    const std::vector<std::vector<double>> solution = direct_->Solve(y);
    for (std::size_t e = 0; e < parts_.size(); ++e)
      y[e] = parts_[e].ImpulseChange(state->subdomains[e], left_of(e), solution[e]);
    // Of the change on all nodes only that on the copies is an interface impulse: inside, V~ obeys the balance.
    for (std::size_t k = 0; k < map.copies.size(); ++k) {
      const auto& copy = map.copies[k];
      const double* from = &y[copy.problem][dofs * parts_[copy.problem].NodeOf(copy.body)];
      for (int d = 0; d < dofs; ++d) change[dofs * k + d] = from[d];
    }
    // sum_E dF_E = 0 holds to the rounding of lambda; what is left would be momentum out of nothing.
    average_.Project(&change);
  } else {
    change = cg_->Solve(y);
    counters_.cg_iterations += cg_->iterations();
    counters_.cg_failures += !cg_->converged();
  }
  ApplyChange(change, gluing, state);
  const LinearCounters after = CountersOf(*workspace_);
  ++counters_.updates;
  counters_.analyses += after.analyses - before.analyses;
  counters_.factorisations += after.factorisations - before.factorisations;
  counters_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// F_E += dF_E, V_E -= M~_E^-1 dF_E; spins that the operator leaves out are glued by their mean.
void AugmentedInterface::ApplyChange(const std::vector<double>& change, const Gluing& gluing, PartitionedState* state) {
  const InterfaceMap& map = problem_.interface;
  const int dofs = parts_.front().dofs(), stride = Dofs(problem_.model);
  for (std::size_t k = 0; k < map.copies.size(); ++k) {
    const auto& copy = map.copies[k];
    double* v = &state->subdomains[copy.problem].velocity[stride * copy.body];
    const double* inverse = &problem_.subdomains[copy.problem].inverse_mass[(stride - 1) * copy.body];
    for (int d = 0; d < stride; ++d) {
      const double df = d < dofs ? change[dofs * k + d] : (v[d] - gluing.Mean(k)[d]) / inverse[d == 2];
      state->interface.impulse[stride * k + d] += df;
      v[d] -= inverse[d == 2] * df;
    }
  }
}

}  // namespace nscdd
