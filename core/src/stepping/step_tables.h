// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/contact_table.h"
#include "nscdd/vector.h"
#include "partition/grid.h"
#include "partition/sharing.h"
#include "stepping/step_problem.h"
#include "stepping/subdomain_contacts.h"

namespace nscdd {

/// What the present step found out on this rank, beside the bodies themselves (Population). Columns by row of the population,
/// or of `contacts`.
struct StepTables {
  std::vector<Pose> detection;     ///< q_m of each body; q_i under a law of two stages
  std::vector<double> reach;       ///< how far each may come in the step, half the alert distance at least [m]
  std::vector<Twist> motion;       ///< at which the sweep moved them: V_f, or W of the stage before; two stages only
  std::vector<std::int32_t> home;  ///< cell of its centre there
  ContactTable contacts;           ///< there, or at the moments of the sweep
  SubdomainContacts chosen;        ///< those that this rank solves
  Sharing sharing;
  StepColumns columns;
  std::vector<std::uint8_t> is_hindered;  ///< 1: a contact of the body is closed, or closes on the way of the sweep
  std::vector<Twist> displacement;        ///< W: the step moves the bodies by dt W; two stages only
  std::vector<Twist> velocity;            ///< V of each owned body once reconciled; a local copy's, or V_f, of others
  std::vector<Vec2> impulse;              ///< (r_n, r_t); zero where another rank solves
  std::vector<Vec2> relative_velocity;    ///< (v_n, v_t)
};

/// q_m of every body: `half` [s] on its way, centres kept in the period.
inline std::vector<Pose> Drifted(const BodyTable& bodies, const Grid& grid, double half) {
  std::vector<Pose> poses(bodies.size());
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = grid.Wrapped(Moved(bodies.pose[i], bodies.velocity[i], half));
  return poses;
}

inline std::vector<std::int32_t> CellsOf(const std::vector<Pose>& poses, const Grid& grid) {
  std::vector<std::int32_t> cells(poses.size());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = grid.CellOf(Centre(poses[i]));
  return cells;
}

}  // namespace nscdd
