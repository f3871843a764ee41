// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "nscdd/communicator.h"
#include "partition/impulse_cache.h"

namespace nscdd {

/// Brings cached impulses, which any rank may hold after a restart, to the owners of their bodies; `owned` are this rank's.
/// Entries of bodies that nobody owns are dropped. Who owns a body is asked of the rank id % ranks, its directory. Collective.
void DeliverToOwners(std::span<const std::int64_t> owned, Communicator* communicator, ImpulseCache* cache);

}  // namespace nscdd
