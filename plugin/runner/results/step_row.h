// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace nscdd {

/// One finished step as the runner reports it. Names and units as in core/include/nscdd/report.h.
struct StepRow {
  std::int64_t step = 0;
  double time = 0.0;
  std::int64_t contacts = 0;
  std::int64_t active = 0;
  std::int64_t iterations = 0;
  std::string status = "converged";  ///< NameOf(SolveStatus)
  double nat = 0.0;
  double nat_max = 0.0;
  double qm16 = 0.0;
  double interface_jump = 0.0;
  double mean_interpenetration = 0.0;
  double max_interpenetration = 0.0;
  double kinetic_energy = 0.0;
  double momentum_x = 0.0;
  double momentum_y = 0.0;
  double seconds_detect = 0.0;
  double seconds_solve = 0.0;
  double seconds_communicate = 0.0;
  std::int64_t sweeps = 0;
  std::int64_t sticking = 0;
  std::int64_t bodies = 0;
  double quad = 0.0;
  double maxm = 0.0;
  double relative_jump = 0.0;
  std::int64_t interface_bodies = 0;
  std::int64_t interface_copies = 0;
  std::int64_t max_multiplicity = 0;
  std::int64_t empty_subdomains = 0;
  std::int64_t painleve_contacts = 0;
  std::int64_t interface_updates = 0;
  std::int64_t cg_iterations = 0;
  std::int64_t cg_failures = 0;
  std::int64_t factorisations = 0;
  double injected_energy = 0.0;
  double max_drift = 0.0;
  double alert_distance = 0.0;
  double mean_radius = 0.0;
  std::int64_t worst_body_a = -1;  ///< of the contact with the largest nat_max; -1: no contact
  std::int64_t worst_body_b = -1;
  std::int64_t unknowns_per_contact = 0;
  std::int64_t unknowns_per_body = 0;
  std::int64_t bytes_per_contact = 0;
  std::int64_t bytes_per_body = 0;
  double seconds_total = 0.0;
  double seconds_interface = 0.0;
  std::string reason;  ///< why the solve stopped, one clause

  // What depends on the number of ranks, summed over them: communication.csv.
  std::int64_t migrated_bodies = 0;
  std::int64_t messages = 0;
  std::int64_t message_bytes = 0;
  std::int64_t collectives = 0;
};

}  // namespace nscdd
