// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/communicator.h"
#include "partition/distribution.h"
#include "problem/partitioned_problem.h"
#include "stepping/impulse_cache.h"

namespace nscdd {

/// Brings the solution back to the owners of the bodies: one velocity per body, the mean over its copies (which conserves the
/// momentum of the sample exactly, math.md section 5 (b)), and in `cache`, whose entries it replaces, the impulses that the
/// next step starts from.
///
/// `velocity` holds V_f of every row before, or the velocity of a local copy where there is one; after, V of the owned rows (by
/// the rank that owns them). `impulse` is by row of the contact table, `solved` lists this rank's contacts. Collective, one
/// round of messages.
void Reconcile(const PartitionedProblem& problem, const PartitionedState& state, const Distribution& distribution,
               const Sharing& sharing, const std::vector<std::int32_t>& solved, const std::vector<Vec2>& impulse,
               Communicator* communicator, std::vector<Twist>* velocity, ImpulseCache* cache);

}  // namespace nscdd
