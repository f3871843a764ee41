// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "nscdd/report.h"
#include "results/results_folder.h"
#include "results/run_files.h"

namespace nscdd {

class StagedFile;

/// steps.csv, one row per step, flushed row by row (steps.csv.part while the run lasts); with several ranks also
/// communication.csv, the columns that depend on their number. Columns: nscdd/figures.h.
class StepsCsv {
 public:
  /// Collective. Keeps a reference to `folder`.
  explicit StepsCsv(ResultsFolder* folder);
  /// Goes on behind `kept`, which an earlier StepsCsv handed out by Keep(), and cuts later rows.
  StepsCsv(ResultsFolder* folder, const std::vector<FileExtent>& kept);
  ~StepsCsv();

  /// Collective; rank 0's report counts. Throws Error on all ranks when it cannot be written.
  void Append(const StepReport& step);
  /// Collective. Brings the rows to the disk; rank 0 gets what a continuation begins from.
  std::vector<FileExtent> Keep();
  /// Collective; before ResultsFolder::Finish().
  void Close();

 private:
  ResultsFolder* folder_;
  std::unique_ptr<StagedFile> steps_;          ///< rank 0 only
  std::unique_ptr<StagedFile> communication_;  ///< rank 0 of several only, and where an earlier run of several ranks began it
};

/// Calls `visit` for each row of the files in `kept`, with what they say of its step. Throws Error, naming the file and the
/// line, when one is not what StepsCsv writes.
void ForEachStep(const std::filesystem::path& folder, const std::vector<FileExtent>& kept,
                 const std::function<void(const StepReport&)>& visit);

}  // namespace nscdd
