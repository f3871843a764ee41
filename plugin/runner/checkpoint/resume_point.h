// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "checkpoint/checkpoint.h"
#include "results/mapped_file.h"
#include "results/rank_group.h"

namespace nscdd {

/// The newest checkpoint of a folder that is intact, as are the files that it names; every rank reads it.
class ResumePoint {
 public:
  /// Collective; the folder is claimed (ResultsFolder). Newer checkpoints that cannot be used are put aside under the name
  /// NAME.damaged. Throws Error on all ranks, with the reasons, if there is no good one.
  ResumePoint(const std::filesystem::path& folder, const RankGroup& ranks);

  const Checkpoint& checkpoint() const { return checkpoint_; }
  const CheckpointHead& head() const { return checkpoint_.head; }
  /// Rank 0: why not a newer one; one sentence for each, empty if it is the newest.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::int64_t Choose(const std::filesystem::path& folder);
  void Open(const std::filesystem::path& file);

  std::unique_ptr<MappedFile> file_;
  Checkpoint checkpoint_;
  std::vector<std::string> warnings_;
};

}  // namespace nscdd
