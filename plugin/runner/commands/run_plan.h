// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "auto/pilot.h"
#include "checkpoint/checkpoint.h"
#include "commands/commands.h"
#include "nscdd/host/solver_registry.h"
#include "results/results_folder.h"
#include "scene/scene.h"
#include "solver_settings.h"

namespace nscdd {

/// What a run does, whether the command line and a scene file say so or a checkpoint.
struct RunPlan {
  RunRecord record;  ///< without `inputs`
  Scene scene;
  SolverRegistry registry;
  std::unique_ptr<Pilot> pilot;  ///< null unless the solver is "auto"
  SolverChoice choice;           ///< of the first step
  std::int64_t subdomains_x = 1, subdomains_y = 1;
};

/// Throws Error if the request says something that --resume takes from the run's folder.
void RefuseConflicts(const RunRequest& request);

/// Throws Error on bad input.
RunPlan PlanRun(const RunRequest& request, int ranks);

/// The same run again, or further with the number of steps and of those between checkpoints that the command line may give.
/// Throws Error when its plugin or this program is another one than it was, or no step is left to do.
RunPlan PlanResumedRun(const RunRequest& request, const CheckpointHead& head);

/// The files that the scene names, read through.
std::vector<InputFile> InputsOf(const Scene& scene);
/// Throws Error if one of them is not what it was.
void CheckInputs(const std::vector<InputFile>& inputs);

/// What run.json says.
RunIdentity IdentityOf(const RunPlan& plan, int ranks);

}  // namespace nscdd
