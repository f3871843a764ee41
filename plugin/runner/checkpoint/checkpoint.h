// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "checkpoint/run_record.h"
#include "nscdd/vector.h"
#include "results/rank_group.h"

namespace nscdd {

/// A body at the end of a step, bit for bit.
struct SavedBody {
  std::int64_t id;
  Pose pose;
  Twist velocity;
};
static_assert(sizeof(SavedBody) == 56 && std::is_trivially_copyable_v<SavedBody>);

/// What one rank wrote.
struct CheckpointSection {
  std::span<const std::byte> bodies;  ///< of SavedBody, not aligned
  std::span<const std::byte> state;   ///< what its solver's SaveState() said

  std::size_t body_count() const { return bodies.size() / sizeof(SavedBody); }
  SavedBody body(std::size_t i) const;
};

/// A checkpoint file, read; the sections point into its bytes.
struct Checkpoint {
  CheckpointHead head;
  std::vector<CheckpointSection> sections;  ///< by rank
};

/// Reads the bytes of a checkpoint file. Layout: plugin/runner/checkpoint/README.md. Throws Error, a clause about the file,
/// when a bit of them is not as it was written.
Checkpoint ParseCheckpoint(std::span<const std::byte> bytes);

/// Collective. Writes the checkpoint after step head.step into `folder`, each rank its bodies and its solver's state, and
/// removes those before the previous one. It is there completely, on the disk, or not at all. Throws Error on all ranks when it
/// cannot be written; what was there before is then untouched. Rank 0's head counts.
void WriteCheckpoint(const std::filesystem::path& folder, const CheckpointHead& head, const std::vector<SavedBody>& bodies,
                     std::span<const std::byte> state, const RankGroup& ranks);

}  // namespace nscdd
