// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "interface/gluing.h"
#include "interface/interface_map.h"
#include "nlgs/residual.h"
#include "problem/subdomain_problem.h"

namespace nscdd {

/// One step's problem, this rank's part: constant during a solve.
struct PartitionedProblem {
  ContactModel model = ContactModel::kNormal;
  std::vector<SubdomainProblem> subdomains;  ///< ascending; ranks hold ascending blocks
  InterfaceMap interface;
  ResidualScales scales;
  double dt = 0.0;                         ///< [s]; 0: not a step of time
  double mean_mass = 0.0;                  ///< [kg] of free bodies
  std::int64_t contact_count = 0;          ///< of all ranks
  const ContactTable* contacts = nullptr;  ///< names the worst contact
  const std::vector<std::int64_t>* body_id = nullptr;
};

/// What its solution changes.
struct PartitionedState {
  std::vector<SubdomainState> subdomains;
  InterfaceState interface;
};

}  // namespace nscdd
