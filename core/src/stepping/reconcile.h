// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/communicator.h"
#include "partition/impulse_cache.h"
#include "partition/population.h"
#include "problem/partitioned_problem.h"
#include "stepping/step_tables.h"

namespace nscdd {

/// The solution by row of this rank's tables (velocity, impulse, relative_velocity), the velocities brought to the owners of
/// the bodies: one per body, the mean over its copies, which conserves the momentum of the sample exactly. In `cache`, whose
/// entries it replaces, the impulses that the next step starts from.
/// Collective, one round of messages.
void Reconcile(const PartitionedProblem& problem, const PartitionedState& state, const Population& population,
               Communicator* communicator, StepTables* tables, ImpulseCache* cache);

}  // namespace nscdd
