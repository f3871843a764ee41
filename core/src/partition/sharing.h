// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "nscdd/communicator.h"
#include "partition/population.h"

namespace nscdd {

/// Which subdomains hold a contact of each body of a rank's table: for row i, ascending numbers. Their count is the
/// multiplicity m_i. Prescribed bodies have none: they have no unknown, so nothing to glue.
struct Sharing {
  std::vector<std::int32_t> begin{0};  ///< one more than rows
  std::vector<std::int32_t> subdomain;

  std::span<const std::int32_t> Of(std::size_t row) const {
    return {subdomain.data() + begin[row], subdomain.data() + begin[row + 1]};
  }
  int Multiplicity(std::size_t row) const { return begin[row + 1] - begin[row]; }
};

/// (row of a body, number of a subdomain that touches it).
using SubdomainPairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// From pairs in any order, repeated or not.
Sharing MakeSharing(std::size_t rows, const SubdomainPairs& pairs);

/// Completes the pairs of this rank's contacts to the sharing of all bodies that it holds, and `marks`, by row, to those that
/// some rank has set. Collective.
Sharing CompleteSharing(const Population& population, SubdomainPairs pairs, std::vector<std::uint8_t>* marks,
                        Communicator* communicator);

}  // namespace nscdd
