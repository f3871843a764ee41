// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "partition/population.h"
#include "stepping/step_outcome.h"
#include "stepping/step_tables.h"

namespace nscdd {

/// Fills what `report` says of energies, momentum, interpenetration and drift. Throws the same Error on all ranks when the step
/// made a position or velocity that is not finite, naming the body. Collective.
void Summarise(const Population& population, const StepTables& tables, const StepOutcome& outcome,
               const SteppingOptions& stepping, double dt, Communicator* communicator, StepReport* report);

/// Adds the counts of an earlier solve of the step; its status and residuals stand where it ended worse.
void AddSolve(const SolveReport& earlier, SolveReport* last);

/// Sums of what all ranks sent in the step, `mine` on this one, and of the bodies that changed rank. Collective.
void SummariseCommunication(const CommunicationCounters& mine, std::int64_t migrated, Communicator* communicator,
                            StepReport* report);

}  // namespace nscdd
