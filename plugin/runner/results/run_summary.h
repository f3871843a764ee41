// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "results/step_row.h"

namespace nscdd {

/// Least and largest of a count over the steps.
struct CountRange {
  std::int64_t least = 0;
  std::int64_t most = 0;
};

/// Gathers what the table at the end of a run shows.
struct RunSummary {
  // Filled by the runner.
  std::string scene;
  std::string adapter;
  std::string solver;
  std::string criterion;  ///< for instance "nat <= 0.0001"
  std::string output;     ///< folder
  int ranks = 1;
  std::int64_t subdomains_x = 1;
  std::int64_t subdomains_y = 1;
  std::int64_t steps_asked = 0;
  double seconds_wall = 0.0;  ///< of the whole run

  /// After each step.
  void Add(const StepRow& row);

  /// Steps whose solve did not converge; incomplete resolutions and fixed numbers of iterations are not among them.
  std::int64_t not_converged() const { return status_count[1] + status_count[2] + status_count[5]; }

  // Filled by Add().
  std::int64_t steps = 0;
  double time = 0.0;                              ///< [s] simulated
  std::array<std::int64_t, 6> status_count = {};  ///< converged, iteration_limit, stalled, incomplete, fixed, diverged
  StepRow last;
  StepRow first_not_converged;
  std::int64_t iterations = 0;  ///< sums over the steps, unless they say maximum
  std::int64_t max_iterations = 0;
  std::int64_t sweeps = 0;
  double nat = 0.0;
  double max_nat = 0.0;
  double max_nat_max = 0.0;
  double mean_interpenetration = 0.0;
  double max_interpenetration = 0.0;
  double max_jump = 0.0;
  double injected_energy = 0.0;
  std::int64_t steps_beyond_alert = 0;  ///< max_drift > min(alert_distance, mean_radius)
  std::int64_t uneven_steps = 0;        ///< converged, nat_max > 1/2
  std::int64_t painleve_contacts = 0;
  CountRange unknowns_per_contact, unknowns_per_body, bytes_per_contact, bytes_per_body;
  std::int64_t migrated_bodies = 0;
  std::int64_t messages = 0;
  std::int64_t message_bytes = 0;
  std::int64_t collectives = 0;
  double seconds_detect = 0.0;
  double seconds_solve = 0.0;
  double seconds_communicate = 0.0;
  double seconds_steps = 0.0;  ///< sum of seconds_total
  std::int64_t interface_updates = 0;
  std::int64_t cg_iterations = 0;
  std::int64_t factorisations = 0;
  double seconds_interface = 0.0;
};

/// The table, several lines, each ended by '\n'.
std::string FormatSummary(const RunSummary& summary);

}  // namespace nscdd
