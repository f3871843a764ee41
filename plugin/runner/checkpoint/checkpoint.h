// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "nscdd/vector.h"
#include "results/rank_group.h"
#include "results/run_files.h"

namespace nscdd {

/// A file that the scene names.
struct InputFile {
  std::string path;  ///< absolute
  std::string hash;  ///< HashOfFile()
};

/// What a run was asked for: all that it takes to go on with it.
struct RunRecord {
  std::string program;      ///< version
  std::string plugin_path;  ///< as asked for; empty: where the program finds it
  std::string plugin;       ///< name and version, as the plugin says
  std::string scene_text;   ///< the scene file as it was
  std::string scene_file;   ///< as the user gave it
  std::string scene_path;   ///< absolute
  std::string scene_hash;
  std::vector<InputFile> inputs;
  std::vector<std::string> notes;  ///< on how it began
  std::string adapter;
  std::string solver;
  std::vector<std::pair<std::string, std::string>> options;
  std::int64_t steps = 0;
  std::int64_t save_every = 0;        ///< 0: first and last step only
  std::int64_t checkpoint_every = 0;  ///< 0: no checkpoints
};

/// What stands at the beginning of a checkpoint.
struct CheckpointHead {
  RunRecord run;
  std::string pilot;                 ///< what solver "auto" goes on with; empty: another solver
  std::int64_t step = 0;             ///< steps done
  std::int64_t ranks = 1;            ///< that wrote it
  std::vector<FileExtent> tables;    ///< steps.csv, communication.csv
  std::vector<FileExtent> segments;  ///< of results.h5
};

std::string FormatHead(const CheckpointHead& head);
/// Throws Error if it is not text of FormatHead().
CheckpointHead ParseHead(const std::string& text);

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
