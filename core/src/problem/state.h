// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "problem/partitioned_problem.h"

namespace nscdd {

/// V_E := V_f + M~^-1 H r  (F_E is subtracted by the interface).
void ComputeVelocity(const SubdomainProblem& problem, SubdomainState* state);

/// First iterate from warm impulses, (r_n, r_t) per row of the rank's table of contacts (empty: r = 0), and interface impulses
/// F = 0: r clipped to the cone, V_E = V_f + M~^-1 H r. Set F afterwards with Gluing::SubtractImpulse.
PartitionedState InitialState(const PartitionedProblem& problem, std::span<const Vec2> warm);

/// Writes the velocities of the copies of free bodies into `velocity` (by row of the rank's table of bodies). A spin that is no
/// unknown is left as it is there.
void StoreVelocities(const SubdomainProblem& problem, const SubdomainState& state, std::span<const double> inverse_mass,
                     std::vector<Twist>* velocity);

/// Writes impulses and relative velocities, by row of the rank's table of contacts.
void StoreImpulses(const SubdomainProblem& problem, const SubdomainState& state, std::vector<Vec2>* impulse,
                   std::vector<Vec2>* relative_velocity);

}  // namespace nscdd
