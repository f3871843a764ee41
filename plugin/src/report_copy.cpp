// SPDX-License-Identifier: Apache-2.0
#include "report_copy.h"

namespace nscdd {
namespace {

static_assert(static_cast<int>(SolveStatus::kConverged) == NSCDD_CONVERGED);
static_assert(static_cast<int>(SolveStatus::kIterationLimit) == NSCDD_ITERATION_LIMIT);
static_assert(static_cast<int>(SolveStatus::kStalled) == NSCDD_STALLED);
static_assert(static_cast<int>(SolveStatus::kDiverged) == NSCDD_DIVERGED);
static_assert(static_cast<int>(SolveStatus::kIncomplete) == NSCDD_INCOMPLETE);
static_assert(static_cast<int>(SolveStatus::kFixed) == NSCDD_FIXED);

constexpr std::uint32_t kMinorOfFixed = 2;

void CopySolve(const SolveReport& solve, nscdd_report* target) {
  const bool is_known = solve.status != SolveStatus::kFixed || target->header.abi_minor >= kMinorOfFixed;
  target->status = is_known ? static_cast<std::int32_t>(solve.status) : NSCDD_ITERATION_LIMIT;
  target->reason = solve.reason.c_str();
  target->contacts = solve.contacts;
  target->active = solve.active;
  target->sticking = solve.sticking;
  target->iterations = solve.iterations;
  target->sweeps = solve.sweeps;
  target->nat = solve.residuals.nat;
  target->nat_max = solve.residuals.nat_max;
  target->quad = solve.residuals.quad;
  target->maxm = solve.residuals.maxm;
  target->qm16 = solve.residuals.qm16;
  target->interface_jump = solve.residuals.interface_jump;
  target->relative_jump = solve.residuals.relative_jump;
  target->worst_body_a = solve.residuals.worst.body_a;
  target->worst_body_b = solve.residuals.worst.body_b;
  target->subdomains = solve.subdomains;
  target->empty_subdomains = solve.empty_subdomains;
  target->interface_bodies = solve.interface_bodies;
  target->interface_copies = solve.interface_copies;
  target->max_multiplicity = solve.max_multiplicity;
  target->unknowns_per_contact = solve.unknowns_per_contact;
  target->unknowns_per_body = solve.unknowns_per_body;
  target->bytes_per_contact = solve.bytes_per_contact;
  target->bytes_per_body = solve.bytes_per_body;
  target->painleve_contacts = solve.painleve_contacts;
  target->interface_updates = solve.interface_updates;
  target->cg_iterations = solve.cg_iterations;
  target->cg_failures = solve.cg_failures;
  target->analyses = solve.analyses;
  target->factorisations = solve.factorisations;
  target->seconds_interface = solve.seconds_interface;
  target->extrapolations = solve.extrapolations;
  target->acceleration_restarts = solve.acceleration_restarts;
}

}  // namespace

void CopyReport(const StepReport& report, nscdd_report* target) {
  CopySolve(report.solve, target);
  target->step = report.step;
  target->time = report.time;
  target->bodies = report.bodies;
  target->mean_interpenetration = report.mean_interpenetration;
  target->max_interpenetration = report.max_interpenetration;
  target->mean_radius = report.mean_radius;
  target->kinetic_energy = report.kinetic_energy;
  target->momentum_x = report.momentum_x;
  target->momentum_y = report.momentum_y;
  target->injected_energy = report.injected_energy;
  target->max_drift = report.max_drift;
  target->alert_distance = report.alert_distance;
  target->migrated_bodies = report.migrated_bodies;
  target->messages = report.messages;
  target->message_bytes = report.message_bytes;
  target->collectives = report.collectives;
  target->seconds_detect = report.seconds_detect;
  target->seconds_solve = report.seconds_solve;
  target->seconds_communicate = report.seconds_communicate;
  target->seconds_total = report.seconds_total;
}

}  // namespace nscdd
