// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/communicator.h"
#include "partition/grid.h"
#include "partition/population.h"
#include "problem/partitioned_problem.h"
#include "stepping/motion.h"
#include "stepping/step_tables.h"

namespace nscdd {

/// What the first stage's displacements ask for next. The same on all ranks.
struct NextStage {
  bool detection = false;  ///< pairs that were not listed may meet, or half-planes were taken where bodies did not go
  bool precision = false;  ///< the solver left overlaps that the next detection could take for the other side of a wall
  bool rebound = false;    ///< of an active contact
};

/// Whether contact `c` acts in the first stage: s_n > 0, or gap + dt w_n is closed at the end.
bool IsActive(const StepTables& tables, std::size_t c, double dt);

/// Judges the displacements W of the first stage, `state` of `problem`. A detection is asked for where
///   - a body came further than its reach,
///   - a contact that was open carries an impulse more than a tenth of its levers beside the point that its half-plane touches,
///     and another contact acts on its bodies too: these may have turned aside before,
///   - bodies that turn overlap by more than 1e-4 of the levers, and by half of it more than their half-plane says.
/// Precision where a half-plane is overstepped by more than a hundredth of the levers, or by 2e-4 of them at more than a tenth
/// a step: the tolerance of the solver is relative to the impulses. A rebound where, of a contact with s_n > 0 or gap + dt w_n
/// closed at the end, e times the approach speed is more than a hundredth of what the loads of a step do to it: less would be
/// back within the step. Collective.
NextStage JudgeDisplacements(const PartitionedProblem& problem, const PartitionedState& state, const Population& population,
                             const StepTables& tables, const Grid& grid, double dt, Communicator* communicator);

/// The second stage, of velocities, in place of the first, from its impulses: V = V_f + M^-1 H r with
/// 0 <= v_n + e v_n^- _|_ r_n >= 0 at active contacts, v_n^- the (signed) velocity before the step; at the others r_n = 0.
void AskForRebounds(const BodyTable& bodies, double dt, StepTables* tables, PartitionedProblem* problem,
                    PartitionedState* state);

/// What a further detection is to know of the bodies that this rank owns: how far they came, and for those on which several
/// contacts act (or contacts in several subdomains), or whose contacts turn, the way; the others met on the way that was swept.
/// Collective.
KnownMotion NextMotion(const Population& population, const StepTables& tables, double dt, Communicator* communicator);

/// Which bodies a contact hinders on the way of the sweep: it is closed at its beginning, or within it.
std::vector<std::uint8_t> HinderedBodies(const StepTables& tables, double dt);

/// V of every row from W, the solution of the first stage: the rest of the loads' impulse is added where nothing hinders the
/// body.
std::vector<Twist> VelocitiesOf(const BodyTable& bodies, const StepTables& tables, double dt);

}  // namespace nscdd
