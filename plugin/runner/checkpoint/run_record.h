// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "results/file_extent.h"

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

}  // namespace nscdd
