// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checkpoint/resume_point.h"
#include "checkpoint/stop_signal.h"
#include "commands/run_plan.h"
#include "nscdd/host/solver.h"
#include "results/results_file.h"
#include "results/results_folder.h"
#include "results/run_files.h"
#include "results/steps_csv.h"
#include "scene/platform.h"

namespace nscdd {

/// Collective. Writes state.h5: this rank's bodies and the solver's state after the last step, and what --resume goes on with.
/// `clock`: after the last step; `tables`, `results`: rank 0's files of the folder, complete.
void WriteState(const RunPlan& plan, const RunClock& clock, const std::vector<FileExtent>& tables, const Solver& solver,
                ResultsFolder* folder);

/// Collective. Lets the solver go on from what that of the scene's state file saved. Returns "", or why it begins without.
std::string LoadSolverState(const RunPlan& plan, const RankGroup& ranks, Solver* solver);

/// Throws Error if results in `folder` would take the place of the state that the scene begins with.
void CheckStartStays(const Scene& scene, const std::filesystem::path& folder);

/// Writes the checkpoints of a run, and listens for the signals that ask it to end. All functions are collective.
class RunCheckpoints {
 public:
  /// Keeps references.
  RunCheckpoints(const RunPlan& plan, ResultsFolder* folder, StepsCsv* csv, ResultsFile* file, Platform* platform,
                 Solver* solver)
      : plan_(plan), folder_(folder), csv_(csv), file_(file), platform_(platform), solver_(solver) {}

  void Write(std::int64_t step);
  /// After step `step`, unless the run ends with it.
  void WriteIfDue(std::int64_t step) {
    if (step % plan_.record.checkpoint_every == 0 && step < plan_.record.steps) Write(step);
  }

  /// True on all ranks when one of them was told to end; the checkpoint after `step` is there then.
  bool IsToldToEnd(std::int64_t step);

  std::int64_t last_step() const { return last_step_; }
  void set_last_step(std::int64_t step) { last_step_ = step; }
  /// "nscdd run --resume DIR"
  std::string command() const;

 private:
  std::vector<SavedBody> BodiesAfter(std::int64_t step);

  const RunPlan& plan_;
  ResultsFolder* folder_;
  StepsCsv* csv_;
  ResultsFile* file_;
  Platform* platform_;
  Solver* solver_;
  std::int64_t last_step_ = -1;  // of the last checkpoint; -1: none yet
  StopSignal stop_;
};

/// Gives the bodies and the solver of this rank the state of a checkpoint after a step of the run. Collective. Throws Error on
/// all ranks when the checkpoint has other bodies than the scene. `bodies`: of this rank's platform.
void Restore(const Checkpoint& checkpoint, std::int64_t bodies, const RankGroup& ranks, Platform* platform, Solver* solver);

}  // namespace nscdd
