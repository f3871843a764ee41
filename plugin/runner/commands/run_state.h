// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/run_plan.h"
#include "nscdd/host/solver.h"
#include "results/file_extent.h"
#include "results/results_folder.h"

namespace nscdd {

/// Collective. Writes state.h5: this rank's bodies and the solver's state after the last step, and what --resume goes on with.
/// `clock`: after the last step; `tables`, `results`: rank 0's files of the folder, complete.
void WriteState(const RunPlan& plan, const RunClock& clock, const std::vector<FileExtent>& tables, const Solver& solver,
                ResultsFolder* folder);

/// Collective. Lets the solver go on from what that of the scene's state file saved. Returns "", or why it begins without.
std::string LoadSolverState(const RunPlan& plan, const RankGroup& ranks, Solver* solver);

/// Throws Error if results in `folder` would take the place of the state that the scene begins with.
void CheckStartStays(const Scene& scene, const std::filesystem::path& folder);

}  // namespace nscdd
