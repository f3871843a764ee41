// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"
#include "partition/grid.h"
#include "partition/impulse_cache.h"

namespace nscdd {

/// What a time stepper keeps between two steps beside the cached impulses; the same on all ranks.
struct StepperState {
  std::int64_t step = 0;
  double time = 0.0;       ///< [s]
  double alert = -1.0;     ///< [m] < 0: not chosen yet
  double cached_dt = 0.0;  ///< [s] step that left the cached impulses; 0: there are none
  Grid grid;
};

/// This rank's part as bytes, field by field.
std::vector<std::byte> WriteState(const StepperState& state, const ImpulseCache& cache, const PartitionOptions& partition,
                                  const Communicator& communicator);

/// Reads the parts that the ranks of one run wrote at the same time, each given to one rank of the present run, and adds their
/// impulses to `cache` (empty); those of interfaces only if the partition is the same, and the cuts are those that were saved.
/// Collective. Throws Error on all ranks when the bytes are not those of WriteState(), of another period, of different moments,
/// or when one of the parts is missing or there twice.
StepperState ReadStates(std::span<const std::span<const std::byte>> parts, const PartitionOptions& partition,
                        const AdapterDescription& platform, Communicator* communicator, ImpulseCache* cache);

}  // namespace nscdd
