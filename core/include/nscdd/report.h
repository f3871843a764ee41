// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nscdd/contact_table.h"

namespace nscdd {

/// How a solve ended. Solvers whose residual need not fall from test to test (accelerated ones, the augmented interface,
/// newton) return the best tested iterate, the others the last one, or zero impulses if it diverged.
enum class SolveStatus {
  kConverged,       ///< the criterion fell below its tolerance (or there was no contact)
  kIterationLimit,  ///< max_iterations reached first
  kStalled,         ///< no new minimum of the residual for stall_iterations iterations, or no further step was possible
  kDiverged,        ///< the residual, or nat_max, is not finite, or above 1e6 times the first one and (nat_max: 1e6) above 1
  kIncomplete,  ///< an incomplete resolution (REA, IEA) did all that it does; the criterion does not hold for the whole sample
  kFixed,       ///< tolerance 0: it made the max_iterations iterations that it was asked for
};

/// Whether the solve did what it was asked for.
constexpr bool IsAsAsked(SolveStatus status) {
  return status == SolveStatus::kConverged || status == SolveStatus::kIncomplete || status == SolveStatus::kFixed;
}

/// The word of a status in files and options.
constexpr const char* NameOf(SolveStatus status) {
  switch (status) {
    case SolveStatus::kConverged:
      return "converged";
    case SolveStatus::kIterationLimit:
      return "iteration_limit";
    case SolveStatus::kStalled:
      return "stalled";
    case SolveStatus::kIncomplete:
      return "incomplete";
    case SolveStatus::kFixed:
      return "fixed";
    case SolveStatus::kDiverged:
      break;
  }
  return "diverged";
}

/// Natural residuals of the global problem at the end, and what the last tested sweep changed. Definitions: residual.h.
struct Residuals {
  double nat = 0.0;             ///< [-]
  double nat_max = 0.0;         ///< [-] in units of max(|f| dt / m, approach speed, recovery speed)
  double quad = 0.0;            ///< [-] max(QuadDV, QuadDVR)
  double maxm = 0.0;            ///< [-] max(MaxmDV, MaxmDVR)
  double qm16 = 0.0;            ///< [-] max(quad, maxm / 16.666)
  double interface_jump = 0.0;  ///< [m/s] rms over interface copies of V_E - mean, before the last stage 2
  double relative_jump = 0.0;   ///< [-] eta: the same over QuadWR
  ContactKey worst;             ///< contact with the largest nat_max
};

/// Residuals at one test.
struct IterationRecord {
  int iteration = 0;
  double nat = 0.0;
  double nat_max = 0.0;
  double qm16 = 0.0;
  double interface_jump = 0.0;
};

/// What a solve did. The same on all ranks.
struct SolveReport {
  SolveStatus status = SolveStatus::kConverged;
  std::string reason;  ///< one clause: why it stopped
  Residuals residuals;
  int iterations = 0;  ///< sweeps (NSCD), interface updates (NSCDD, FEA), these and the local sweeps (REA), local sweeps (IEA)
  std::int64_t sweeps = 0;                 ///< sweeps of every contact (of the subdomain that needed most, where they differ)
  std::int64_t interface_updates = 0;      ///< stages 2
  std::int64_t extrapolations = 0;         ///< of the acceleration
  std::int64_t acceleration_restarts = 0;  ///< times that it forgot its history because the residual had grown
  std::int64_t cg_iterations = 0;          ///< of all updates
  std::int64_t cg_failures = 0;            ///< updates in which the conjugate gradient met its iteration limit
  std::int64_t analyses = 0;               ///< symbolic factorisations
  std::int64_t factorisations = 0;         ///< numeric ones
  double seconds_interface = 0.0;          ///< in the augmented interface, this rank
  std::int64_t contacts = 0;               ///< candidates
  std::int64_t active = 0;                 ///< r_n > 0
  std::int64_t sticking = 0;               ///< active, |r_t| < mu r_n
  std::int64_t subdomains = 0;
  std::int64_t empty_subdomains = 0;
  std::int64_t interface_bodies = 0;
  std::int64_t interface_copies = 0;
  int max_multiplicity = 0;
  int unknowns_per_contact = 0;  ///< 1 without friction, else 2
  int unknowns_per_body = 0;     ///< 2 for disks without friction, else 3
  int bytes_per_contact = 0;     ///< of the sweep: constants and impulse
  int bytes_per_body = 0;        ///< of the sweep: velocity and inverse masses
  int painleve_contacts = 0;     ///< local problems without or with two solutions (mu |W_nt| >= W_nn)
  std::vector<IterationRecord> history;
};

/// What a time step did. The same on all ranks but for seconds_*, which are this rank's.
struct StepReport {
  SolveReport solve;
  std::int64_t step = 0;               ///< counted from 1
  double time = 0.0;                   ///< [s] at the end of the step
  std::int64_t bodies = 0;             ///< free ones
  double mean_interpenetration = 0.0;  ///< [m] of max(0, -gap) at the end of the step over the candidates
  double max_interpenetration = 0.0;   ///< [m]
  double mean_radius = 0.0;            ///< [m] of free bodies
  double kinetic_energy = 0.0;         ///< [J] of free bodies at the end
  double momentum_x = 0.0;             ///< [N s] of free bodies at the end
  double momentum_y = 0.0;
  double injected_energy = 0.0;  ///< [J] work bound of gap feedback: sum of r_n max(0, -b_n)
  double max_drift = 0.0;  ///< [m] largest distance a free body moved in the step; above alert_distance contacts may be missed
  double alert_distance = 0.0;       ///< [m] used
  std::int64_t migrated_bodies = 0;  ///< that changed rank
  std::int64_t messages = 0;         ///< sent by all ranks in the step
  std::int64_t message_bytes = 0;
  std::int64_t collectives = 0;
  double seconds_detect = 0.0;
  double seconds_solve = 0.0;  ///< communication within it excluded
  double seconds_communicate = 0.0;
  double seconds_total = 0.0;
};

}  // namespace nscdd
