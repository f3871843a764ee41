// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/communicator.h"
#include "partition/grid.h"
#include "stepping/impulse_cache.h"

namespace nscdd {

/// What a time stepper keeps between two steps beside the cached impulses; the same on all ranks.
struct StepperState {
  std::int64_t step = 0;
  double time = 0.0;       ///< [s]
  double alert = -1.0;     ///< [m] < 0: not chosen yet
  double cached_dt = 0.0;  ///< [s] ImpulseCache::dt
  Grid grid;
};

/// This rank's part as bytes, field by field in the machine's order.
std::vector<std::byte> WriteState(const StepperState& state, const ImpulseCache& cache, int nx, int ny,
                                  const Communicator& communicator);

/// Reads the parts that the ranks of one run wrote at the same time, each given to one rank of the present run, and adds their
/// impulses to `cache` (empty). Collective. Throws Error on all ranks when the bytes are not those of WriteState(), of another
/// partition, of different moments, or when one of the parts is missing or there twice.
StepperState ReadStates(std::span<const std::span<const std::byte>> parts, int nx, int ny, Communicator* communicator,
                        ImpulseCache* cache);

/// Brings entries, which any rank may hold, to the owners of their bodies; `owned` are this rank's. Entries of bodies that
/// nobody owns are dropped. The owner of a body is asked of the rank id % ranks. Collective.
void DeliverToOwners(std::span<const std::int64_t> owned, Communicator* communicator, ImpulseCache* cache);

}  // namespace nscdd
