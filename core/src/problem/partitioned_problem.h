// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/contact_table.h"
#include "problem/interface_map.h"
#include "problem/subdomain_problem.h"

namespace nscdd {

/// Scales of the residuals; properties of the whole problem, the same on all ranks.
struct ResidualScales {
  double impulse = 0.0;   ///< ||dt f||_2 over free bodies, translations [N s]
  double velocity = 0.0;  ///< max(largest |f| dt / m, largest approach speed, largest -b_n) [m/s]
  double energy = 0.0;    ///< sum of |dt f|^2 / m [J]
  double exchange = 0.0;  ///< max(energy and sum of (dt torque)^2 / I, sum over contacts of m' v^2) [J]: v is the speed of
                          ///< approach or recovery, 1 / m' = 1 / m_a + 1 / m_b
};

/// One step's problem, this rank's part: constant during a solve.
struct PartitionedProblem {
  ContactModel model = ContactModel::kNormal;
  std::vector<SubdomainProblem> subdomains;  ///< ascending; ranks hold ascending blocks
  InterfaceMap interface;
  ResidualScales scales;
  double dt = 0.0;                         ///< [s]; 0: not a step of time
  double mean_mass = 0.0;                  ///< [kg] of free bodies
  std::int64_t contact_count = 0;          ///< of all ranks
  std::int64_t subdomain_count = 1;        ///< of all ranks
  const ContactTable* contacts = nullptr;  ///< names the worst contact
  const std::vector<std::int64_t>* body_id = nullptr;
};

/// Interface impulses F_E, stored per copy (zero sum over the copies of a body), never as multipliers: no chain of copies, no
/// signs, no rank deficiency. Empty without an interface.
struct InterfaceState {
  std::vector<double> impulse;  ///< Dofs per copy of InterfaceMap::copies
};

/// What a solution changes.
struct PartitionedState {
  std::vector<SubdomainState> subdomains;
  InterfaceState interface;
};

}  // namespace nscdd
