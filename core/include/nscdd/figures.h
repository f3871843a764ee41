// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace nscdd {

/// Where a figure of a report is shown.
enum class FigureKind {
  kResult,   ///< the same on any number of ranks: a column of steps.csv
  kSeconds,  ///< by the clock of one rank: a column of steps.csv
  kTraffic,  ///< depends on the number of ranks: a column of communication.csv
  kMemo,     ///< in reports only
};

/// What is said of a figure beside its value.
struct Figure {
  const char* name;
  FigureKind kind;
  const char* unit;  ///< "-" when dimensionless
  const char* help;  ///< a clause
};

}  // namespace nscdd

// Every figure of a report, once: (type, name, kind, unit, help). STEP, SOLVE and RESIDUAL say whether it belongs to
// StepReport, SolveReport or Residuals. Members of these structures, the copies through the C interface, steps.csv,
// communication.csv, the sums of a run and the tables of README.md follow. The order is that of the columns: a new figure goes
// to the end, and a member of its name to the end of nscdd_report.
// clang-format off
#define NSCDD_FIGURES(STEP, SOLVE, RESIDUAL) \
  STEP(std::int64_t, step, kResult, "-", "counted from 1") \
  STEP(double, time, kResult, "s", "at the end of the step") \
  SOLVE(std::int64_t, contacts, kResult, "-", "candidates") \
  SOLVE(std::int64_t, active, kResult, "-", "contacts with a normal impulse > 0") \
  SOLVE(std::int64_t, iterations, kResult, "-", \
        "sweeps (nscd), interface updates (nscdd, fea), these and the local sweeps (rea), local sweeps (iea), " \
        "factorisations (newton)") \
  SOLVE(SolveStatus, status, kResult, "-", "how the solve ended, a word of the table below") \
  RESIDUAL(double, nat, kResult, "-", "natural residual at the end (`core/src/nlgs/residual.h`)") \
  RESIDUAL(double, nat_max, kResult, "-", \
           "of the worst contact, in units of max(|f| dt / m, approach speed, recovery speed)") \
  RESIDUAL(double, qm16, kResult, "-", "max(quad, maxm / 16.666)") \
  RESIDUAL(double, interface_jump, kResult, "m/s", \
           "rms over interface copies of their velocity minus the mean, before the last stage 2") \
  STEP(double, mean_interpenetration, kResult, "m", "of max(0, -gap) at the end of the step over the candidates") \
  STEP(double, max_interpenetration, kResult, "m", "the largest of them") \
  STEP(double, kinetic_energy, kResult, "J", "of the free bodies at the end") \
  STEP(double, momentum_x, kResult, "N s", "of the free bodies at the end") \
  STEP(double, momentum_y, kResult, "N s", "of the free bodies at the end") \
  STEP(double, seconds_detect, kSeconds, "s", "finding contacts") \
  STEP(double, seconds_solve, kSeconds, "s", "solving, without communication") \
  STEP(double, seconds_communicate, kSeconds, "s", "communicating") \
  SOLVE(std::int64_t, sweeps, kResult, "-", "of every contact (of the subdomain that needed most, where they differ)") \
  SOLVE(std::int64_t, sticking, kResult, "-", "active contacts below the Coulomb limit") \
  STEP(std::int64_t, bodies, kResult, "-", "free ones") \
  RESIDUAL(double, quad, kResult, "-", "max(QuadDV, QuadDVR)") \
  RESIDUAL(double, maxm, kResult, "-", "max(MaxmDV, MaxmDVR)") \
  RESIDUAL(double, relative_jump, kResult, "-", "eta: interface_jump over QuadWR") \
  SOLVE(std::int64_t, interface_bodies, kResult, "-", "bodies with contacts in several subdomains") \
  SOLVE(std::int64_t, interface_copies, kResult, "-", "of these bodies") \
  SOLVE(std::int64_t, max_multiplicity, kResult, "-", "most copies of a body") \
  SOLVE(std::int64_t, empty_subdomains, kResult, "-", "without a contact") \
  SOLVE(std::int64_t, painleve_contacts, kResult, "-", "local problems without or with two solutions (mu |W_nt| >= W_nn)") \
  SOLVE(std::int64_t, interface_updates, kResult, "-", "stages 2") \
  SOLVE(std::int64_t, cg_iterations, kResult, "-", "of the conjugate gradient in all updates") \
  SOLVE(std::int64_t, cg_failures, kResult, "-", "updates in which the conjugate gradient met its iteration limit") \
  SOLVE(std::int64_t, factorisations, kResult, "-", "numeric ones") \
  STEP(double, injected_energy, kResult, "J", "work bound of gap feedback: sum of r_n max(0, -b_n)") \
  STEP(double, max_drift, kResult, "m", \
       "largest distance that a free body moved in the step") \
  STEP(double, alert_distance, kResult, "m", "that was used") \
  STEP(double, mean_radius, kResult, "m", "of the free bodies") \
  RESIDUAL(std::int64_t, worst_body_a, kResult, "id", "of the contact with the largest nat_max; -1: no contact") \
  RESIDUAL(std::int64_t, worst_body_b, kResult, "id", "the other body") \
  SOLVE(std::int64_t, unknowns_per_contact, kResult, "-", "1 without friction, else 2") \
  SOLVE(std::int64_t, unknowns_per_body, kResult, "-", "2 for disks without friction, else 3") \
  SOLVE(std::int64_t, bytes_per_contact, kResult, "bytes", "that a sweep reads: constants and impulse") \
  SOLVE(std::int64_t, bytes_per_body, kResult, "bytes", "that a sweep reads: velocity and inverse masses") \
  STEP(double, seconds_total, kSeconds, "s", "of the step") \
  SOLVE(double, seconds_interface, kSeconds, "s", "in the augmented interface") \
  SOLVE(std::string, reason, kResult, "-", "why the solve stopped, a clause (in CSV without comma and quotes)") \
  STEP(std::int64_t, migrated_bodies, kTraffic, "-", "that changed rank") \
  STEP(std::int64_t, messages, kTraffic, "-", "sent by all ranks in the step") \
  STEP(std::int64_t, message_bytes, kTraffic, "bytes", "of all messages") \
  STEP(std::int64_t, collectives, kTraffic, "-", "collective calls") \
  SOLVE(std::int64_t, subdomains, kMemo, "-", "of the grid") \
  SOLVE(std::int64_t, extrapolations, kMemo, "-", "of the acceleration") \
  SOLVE(std::int64_t, acceleration_restarts, kMemo, "-", "times that it forgot its history because the residual had grown") \
  SOLVE(std::int64_t, analyses, kMemo, "-", "symbolic factorisations") \
  RESIDUAL(double, power, kResult, "-", "P: power of what is violated, over all that the contacts do") \
  RESIDUAL(double, load_error, kResult, "-", \
           "part of the loads that has not arrived where it is borne; in a pile at rest, of its weight") \
  RESIDUAL(double, wall_error, kResult, "N s", "estimate from above of the error of the impulse on all prescribed bodies") \
  SOLVE(double, imbalance, kResult, "-", \
        "momentum that the worst body has out of nothing, over the largest of its mass times the velocity scale and its " \
        "impulses") \
  STEP(std::int64_t, redetections, kResult, "-", "times that contacts were looked for again, bodies having gone elsewhere") \
  STEP(std::int64_t, second_solves, kResult, "-", "1: contacts rebounded, velocities were solved for after displacements") \
  STEP(std::int64_t, beyond_reach, kResult, "-", "free bodies that moved further than contacts were looked for") \
  STEP(std::int64_t, beyond_reach_body, kResult, "id", "one of them; -1: none") \
  STEP(std::int64_t, unsettled, kResult, "-", "1: bodies went elsewhere than contacts were looked for even after the last time")
// clang-format on
