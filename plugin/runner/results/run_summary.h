// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "nscdd/report.h"

namespace nscdd {

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
  void Add(const StepReport& step);

  /// Steps whose solve did not do what it was asked for.
  std::int64_t not_converged() const;

  // Filled by Add().
  std::int64_t steps = 0;
  std::array<std::int64_t, kStatuses.size()> status_count = {};  ///< by SolveStatus
  StepReport last;
  StepReport first_not_converged;
  StepReport sum, least, most;          ///< of each figure that is a quantity
  std::int64_t steps_beyond_reach = 0;  ///< in which bodies moved further than contacts were looked for
  std::int64_t uneven_steps = 0;        ///< converged, nat_max > 1/2
};

/// The table, several lines, each ended by '\n'.
std::string FormatSummary(const RunSummary& summary);

}  // namespace nscdd
