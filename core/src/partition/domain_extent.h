// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"
#include "nscdd/vector.h"
#include "partition/grid.h"

namespace nscdd {

/// What all ranks must agree on before the cuts of a step are placed.
struct DomainExtent {
  Vec2 low, high;               ///< box of the free bodies' centres [m]; both zero when there are none
  double largest_radius = 0.0;  ///< [m] of any disk
  double largest_reach = 0.0;   ///< [m] of any body
  bool newcomers = false;       ///< some rank has bodies that were not here before
};

/// `centre`, `reach`: of every row of `bodies`. Minima and maxima are exact, so the same on any number of ranks. Throws Error
/// on all ranks when their time steps `dt` [s] differ. Collective.
DomainExtent ReduceExtent(const BodyTable& bodies, const std::vector<Pose>& centre, const std::vector<double>& reach,
                          std::size_t newcomers, double dt, Communicator* communicator);

/// The cuts: nx x ny equal cells over the extent, or over the period.
Grid GridOver(const DomainExtent& extent, const PartitionOptions& partition, const AdapterDescription& platform);

}  // namespace nscdd
