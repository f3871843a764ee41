#pragma once

#include <memory>

#include "results/results_folder.h"
#include "results/step_row.h"

namespace nscdd {

class StagedFile;

/// steps.csv, one row per step, flushed row by row (steps.csv.part while the run lasts); with several ranks also
/// communication.csv, the columns that depend on their number. Columns: README.md.
class StepsCsv {
 public:
  /// Collective. Keeps a reference to `folder`.
  explicit StepsCsv(ResultsFolder* folder);
  ~StepsCsv();

  /// Collective; rank 0's row counts. Throws Error on all ranks when it cannot be written.
  void Append(const StepRow& row);
  /// Collective; before ResultsFolder::Finish().
  void Close();

 private:
  ResultsFolder* folder_;
  std::unique_ptr<StagedFile> steps_;          ///< rank 0 only
  std::unique_ptr<StagedFile> communication_;  ///< rank 0 of several only
};

}  // namespace nscdd
