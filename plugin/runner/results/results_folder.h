// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "results/rank_group.h"

namespace nscdd {

/// Whose results a folder holds; written to run.json.
struct RunIdentity {
  std::string scene;       ///< name: results of the same name may be replaced, of another are refused
  std::string scene_file;  ///< as the user gave it
  std::string scene_hash;  ///< HashOfFile() of it
  std::string version;     ///< of the program
  std::vector<std::pair<std::string, std::string>> settings;  ///< what the run was asked for, in this order
  std::vector<std::string> notes = {};                        ///< sentences on its input and its end
  double dt = 0.0;                                            ///< [s] the end of step k is at k dt
};

/// FNV-1a of the file's bytes, 16 hexadecimal digits. Throws Error if it cannot be read.
std::string HashOfFile(const std::filesystem::path& file);

/// The folder that a run writes its results into.
///
/// Everything is written under a name ending in ".part", results of an earlier run stay as they are meanwhile; Finish() renames
/// all of it. A run that ends by an error before its first step leaves nothing behind; one that ends later, or is killed,
/// leaves its ".part" files (steps.csv.part grows row by row), and its checkpoints if it wrote any (run_files.h).
class ResultsFolder {
 public:
  /// Collective. Creates the folder if need be and claims it. Throws Error on all ranks when it holds results of another scene
  /// or another program's files under our names, or checkpoints of an unfinished run, cannot be written, or another run writes
  /// into it now.
  ResultsFolder(const std::filesystem::path& folder, const RunIdentity& identity, const RankGroup& ranks);
  /// Collective. Claims the folder of a run to go on with it, from a checkpoint or, when it has finished, from its state file;
  /// whatever happens, that run's files stay. Throws Error on all ranks when there is none, it has neither, it is running, or
  /// it was stopped by a step that did not converge.
  ResultsFolder(const std::filesystem::path& folder, const RankGroup& ranks);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  const RankGroup& ranks() const { return ranks_; }

  /// Path under which the file `name` of the results is to be written; Finish() gives it its name. Not collective.
  std::filesystem::path Stage(const std::string& name);
  /// What run.json will say; for a folder that was claimed without.
  void Identify(const RunIdentity& identity) { identity_ = identity; }
  /// A number for the "summary" of run.json; before Finish().
  void Count(const std::string& name, std::int64_t value) { counts_.emplace_back(name, value); }
  /// A sentence for the "notes" of run.json; before Finish().
  void Note(const std::string& sentence) { identity_.notes.push_back(sentence); }
  /// The run to go on with has left its results and no checkpoint of a later step.
  bool has_finished() const { return has_finished_; }
  /// From now on an unfinished run keeps its ".part" files.
  void KeepParts() { keep_parts_ = true; }
  /// Collective, once, after all files are closed: gives them their names, and removes what an earlier run left besides.
  void Finish();

 private:
  void Claim();
  void ClaimAgain();
  void RemoveLeftovers();
  void Lock();
  void Release();
  void Rename();

  std::filesystem::path folder_;
  RankGroup ranks_;
  RunIdentity identity_;
  std::vector<std::string> staged_;
  std::vector<std::pair<std::string, std::int64_t>> counts_;
  std::vector<std::filesystem::path> created_;  ///< folders that were not there before, innermost first
  int lock_ = -1;                               ///< descriptor of run.json.part on rank 0
  bool keep_parts_ = false;
  bool has_finished_ = false;
  bool finished_ = false;
};

}  // namespace nscdd
