// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/communicator.h"
#include "partition/impulse_cache.h"
#include "partition/sharing.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// First iterate of a step from the impulses of the one before, times `scale` (ratio of the time steps): r by contact key, zero
/// for new contacts, clipped to the cone; F_E by (body, subdomain); V_E = V_f + M~_E^-1 (H_E r_E - F_E).
PartitionedState WarmState(const PartitionedProblem& problem, const ImpulseCache& cache, const Sharing& sharing, double scale,
                           Communicator* communicator);

}  // namespace nscdd
