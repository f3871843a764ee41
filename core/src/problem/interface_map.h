// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "partition/grid.h"
#include "partition/sharing.h"
#include "problem/subdomain_problem.h"

namespace nscdd {

/// The copies of the bodies that several subdomains touch, as one rank sees them. Each interface body with a copy here has one
/// slot per copy anywhere, in ascending order of the subdomains; slots of other ranks' copies are filled by messages.
/// Empty, and without any cost, when no body is shared.
struct InterfaceMap {
  struct Copy {
    std::int32_t problem;  ///< index among this rank's subdomain problems
    std::int32_t body;     ///< row in that problem
    std::int32_t slot;
  };
  struct Neighbour {
    int rank;
    std::vector<std::int32_t> send;     ///< slots of ours that it needs
    std::vector<std::int32_t> receive;  ///< slots that it fills
  };

  std::vector<std::int32_t> row;         ///< of each interface body in the rank's table of bodies, ascending
  std::vector<std::int32_t> slot_begin;  ///< of each interface body, and one behind
  std::vector<Copy> copies;              ///< this rank's, ascending by slot
  std::vector<Neighbour> neighbours;     ///< ascending by rank

  std::int64_t slot_count() const { return slot_begin.empty() ? 0 : slot_begin.back(); }
};

/// `problems` are the subdomains of block `rank` of `blocks`. Tables of all ranks ascend by body id, so both ends of a message
/// list the same bodies in the same order.
InterfaceMap MakeInterfaceMap(const std::vector<SubdomainProblem>& problems, const Sharing& sharing, const Blocks& blocks,
                              int rank);

}  // namespace nscdd
