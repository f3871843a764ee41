// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "checkpoint/checkpoint.h"
#include "results/mapped_file.h"
#include "results/results_folder.h"

namespace nscdd {

/// Where a run goes on: the newest checkpoint of its folder that is intact, as are the files that it names; or the end of a run
/// that has finished, from its state file. Every rank reads it.
class ResumePoint {
 public:
  /// Collective; the folder is claimed, and says whether its run has finished. Newer checkpoints that cannot be used are put
  /// aside under the name NAME.damaged. Throws Error on all ranks, with the reasons, if there is nothing that can be used.
  ResumePoint(const std::filesystem::path& folder, const RankGroup& ranks, bool has_finished = false);

  const Checkpoint& checkpoint() const { return checkpoint_; }
  const CheckpointHead& head() const { return checkpoint_.head; }
  /// Rank 0: why not a newer one; one sentence for each, empty if it is the newest.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Collective. Of a run that has finished: puts copies of its tables and of its saved steps, but for the last one if
  /// `drop_last`, where a checkpoint would have them. Its results stay. Throws Error on all ranks when they are not as they
  /// were written.
  void CopyResults(ResultsFolder* folder, bool drop_last);

 private:
  std::int64_t Choose(const std::filesystem::path& folder);
  void Open(const std::filesystem::path& file);
  void OpenState(const std::filesystem::path& file);

  std::unique_ptr<MappedFile> file_;
  std::vector<SavedBody> bodies_;              // of a state file,
  std::vector<std::vector<std::byte>> parts_;  // and what the solvers of its ranks saved
  Checkpoint checkpoint_;
  std::vector<std::string> warnings_;
};

}  // namespace nscdd
