// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/communicator.h"

namespace nscdd {

[[noreturn]] void RefuseBodyInSeveralHosts(std::int64_t id);

/// Throws Error on all ranks when an id is in the lists of several. Each id is told to the rank id % ranks, which meets all
/// that are equal. Collective.
void CheckIdsAreUnique(const std::vector<std::int64_t>& ids, Communicator* communicator);

}  // namespace nscdd
