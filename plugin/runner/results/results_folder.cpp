// SPDX-License-Identifier: Apache-2.0
#include "results/results_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "nscdd/error.h"
#include "results/run_files.h"
#include "results/written_file.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "run.json";
constexpr const char* kFormat = "nscdd run 1";
constexpr const char* kFinished = "run.json.finished";  // the marker of a run that has ended, while its files get their names
constexpr std::array kOwnNames = {"steps.csv", "communication.csv", "final.csv", "results.h5", "results.xdmf", kStateName};

std::string ReadAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(fmt::format("cannot read {}: check that it exists and its permissions.", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The marker, or null if there is none or it is not ours.
nlohmann::json ReadMarker(const fs::path& file) {
  if (!fs::exists(file)) return nullptr;
  nlohmann::json marker = nlohmann::json::parse(ReadAll(file), nullptr, /*allow_exceptions=*/false);
  const bool is_ours = marker.is_object() && marker.value("format", "") == kFormat && marker.contains("scene");
  return is_ours ? marker : nlohmann::json(nullptr);
}

/// Throws if somebody would lose something by our writing here.
void RefuseForeignResults(const fs::path& folder, const std::string& scene) {
  bool has_marker = false;
  for (const std::string& name : {std::string(kMarker), PartOf(kMarker), std::string(kFinished)}) {
    const nlohmann::json marker = ReadMarker(folder / name);
    if (marker.is_null()) continue;
    has_marker = true;
    if (marker["scene"] != scene) {
      throw Error(
          fmt::format("the folder {} holds results of the scene '{}', not of '{}': choose another folder with --out, or "
                      "remove that one.",
                      folder.string(), marker["scene"].get<std::string>(), scene));
    }
  }
  if (has_marker) return;
  for (const std::string name : kOwnNames) {
    for (const std::string& found : {name, PartOf(name)}) {
      if (!fs::exists(folder / found)) continue;
      throw Error(
          fmt::format("the folder {} holds a {} but no {} that says which scene it is from: choose another folder with "
                      "--out, or remove it.",
                      folder.string(), found, kMarker));
    }
  }
}

nlohmann::ordered_json MarkerOf(const RunIdentity& identity) {
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  for (const auto& [key, value] : identity.settings) settings[key] = value;
  return {{"format", kFormat},
          {"scene", identity.scene},
          {"scene_file", identity.scene_file},
          {"scene_hash", identity.scene_hash},
          {"version", identity.version},
          {"dt", identity.dt},
          {"settings", settings},
          {"notes", identity.notes}};
}

void RefuseToLoseCheckpoints(const fs::path& folder) {
  const std::vector<std::int64_t> steps = CheckpointSteps(folder);
  if (steps.empty()) return;
  throw Error(
      fmt::format("the folder {0} holds an unfinished run with a checkpoint after step {1}: go on with it by 'nscdd run "
                  "--resume {0}', choose another folder with --out, or remove {0}/{2} and those before it to begin anew.",
                  folder.string(), steps.back(), CheckpointName(steps.back())));
}

/// A run that has ended goes on from its state file, unless it was stopped.
void CheckFinished(const fs::path& folder, const nlohmann::json& marker) {
  const std::string steps = marker.value("/settings/steps"_json_pointer, std::string("all"));
  if (marker.contains("/summary/stopped_at_step"_json_pointer)) {
    throw Error(
        fmt::format("the run in {0} stopped for good at step {1} of {2}, which did not converge (solver.on_nonconvergence = "
                    "\"stop\"): begin it anew with other settings, or a scene with [start] state = \"{0}/{3}\".",
                    folder.string(), marker["summary"]["stopped_at_step"].dump(), steps, kStateName));
  }
  if (fs::exists(folder / kStateName)) return;
  throw Error(fmt::format("the run in {} has finished ({} steps) and left no {} to go on from: begin it anew.", folder.string(),
                          steps, kStateName));
}

/// Gives the files of a run that has ended their names and removes what is not needed any more. If it is cut short, it can be
/// done again.
void CompleteFinish(const fs::path& folder) {
  const auto files = ReadMarker(folder / kFinished).value("files", std::vector<std::string>());
  std::vector<std::string> stale(kOwnNames.begin(), kOwnNames.end());
  const nlohmann::json previous = ReadMarker(folder / kMarker);
  if (previous.is_object()) {
    for (const auto& name : previous.value("files", std::vector<std::string>())) stale.push_back(name);
  }
  for (const std::string& name : files) {
    if (fs::path(name).filename() == name && fs::exists(folder / PartOf(name)))
      fs::rename(folder / PartOf(name), folder / name);
  }
  for (const std::string& name : stale) {
    const bool is_new = std::find(files.begin(), files.end(), name) != files.end();
    // A name with a folder in it is none that we gave.
    if (!is_new && fs::path(name).filename() == name) fs::remove(folder / name);
  }
  RemoveScratch(folder);
  fs::remove(folder / PartOf(kMarker));
  fs::rename(folder / kFinished, folder / kMarker);
  SyncToDisk(folder);
}

/// Creates `folder` and those above it; returns the new ones, innermost first.
std::vector<fs::path> CreateFolders(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw Error(fmt::format("{} is a file, not a folder: choose another folder with --out.", folder.string()));
  }
  std::vector<fs::path> created;
  for (fs::path part = folder; !part.empty() && !fs::exists(part, error) && part != part.root_path();
       part = part.parent_path()) {
    if (part.has_filename()) created.push_back(part);
  }
  fs::create_directories(folder, error);
  if (error) throw Error(CannotWrite(folder, error.value()));
  return created;
}

}  // namespace

std::string HashOfFile(const fs::path& file) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char byte : ReadAll(file)) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

ResultsFolder::ResultsFolder(const fs::path& folder, const RunIdentity& identity, const RankGroup& ranks)
    : folder_(folder), ranks_(ranks), identity_(identity) {
  try {
    ranks_.RunOnRoot([&] { Claim(); });
  } catch (const Error&) {
    Release();
    throw;
  }
}

ResultsFolder::ResultsFolder(const fs::path& folder, const RankGroup& ranks)
    : folder_(folder), ranks_(ranks), keep_parts_(true) {
  try {
    ranks_.RunOnRoot([&] { ClaimAgain(); });
  } catch (const Error&) {
    Release();
    throw;
  }
  has_finished_ = ranks_.Min(has_finished_ ? 0 : 1) == 0;
}

ResultsFolder::~ResultsFolder() { Release(); }

void ResultsFolder::Claim() {
  created_ = CreateFolders(folder_);
  RefuseForeignResults(folder_, identity_.scene);
  Lock();
  keep_parts_ = true;  // those of the run that may be here
  if (fs::exists(folder_ / kFinished)) {
    CompleteFinish(folder_);
    ::close(lock_);
    Lock();
  }
  RefuseToLoseCheckpoints(folder_);
  keep_parts_ = false;
  RemoveLeftovers();
  StagedFile(folder_ / PartOf(kMarker)).Write(MarkerOf(identity_).dump(2) + "\n");
}

void ResultsFolder::ClaimAgain() {
  if (!fs::is_directory(folder_)) {
    throw Error(fmt::format("there is no folder {}: give that of a run, as its --out said.", folder_.string()));
  }
  if (!fs::exists(folder_ / PartOf(kMarker)) && !fs::exists(folder_ / kFinished) && ReadMarker(folder_ / kMarker).is_null()) {
    throw Error(fmt::format("the folder {} holds no run of nscdd: give that of a run, as its --out said.", folder_.string()));
  }
  Lock();
  if (fs::exists(folder_ / kFinished)) {
    CompleteFinish(folder_);
    ::close(lock_);
    Lock();
  }
  if (!CheckpointSteps(folder_).empty()) return;
  const nlohmann::json marker = ReadMarker(folder_ / kMarker);
  if (marker.is_null()) {
    throw Error(fmt::format(
        "the run in {} has no checkpoint (--checkpoint-every was not given, or the run ended before its first step): "
        "begin it anew with 'nscdd run SCENE'.",
        folder_.string()));
  }
  has_finished_ = true;
  keep_parts_ = false;
  CheckFinished(folder_, marker);
  RemoveLeftovers();
}

/// Of a run that left no checkpoint.
void ResultsFolder::RemoveLeftovers() {
  for (const std::string name : kOwnNames) fs::remove(folder_ / PartOf(name));
  RemoveScratch(folder_);
}

void ResultsFolder::Lock() {
  const fs::path marker = folder_ / PartOf(kMarker);
  lock_ = ::open(marker.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) throw Error(CannotWrite(folder_, errno));
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(lock_);
    lock_ = -1;
    throw Error(fmt::format("another run is writing into {}: wait until it has ended, or choose another folder with --out.",
                            folder_.string()));
  }
}

fs::path ResultsFolder::Stage(const std::string& name) {
  if (std::find(staged_.begin(), staged_.end(), name) == staged_.end()) staged_.push_back(name);
  return folder_ / PartOf(name);
}

void ResultsFolder::Finish() {
  ranks_.RunOnRoot([&] { Rename(); });
  finished_ = true;
  Release();
}

void ResultsFolder::Rename() {
  for (const std::string& name : staged_) SyncToDisk(folder_ / PartOf(name));
  nlohmann::ordered_json marker = MarkerOf(identity_);
  marker["files"] = staged_;
  for (const auto& [name, value] : counts_) marker["summary"][name] = value;
  const fs::path part = folder_ / PartOf(kFinished);
  StagedFile(part).Write(marker.dump(2) + "\n");
  SyncToDisk(part);
  fs::rename(part, folder_ / kFinished);  // from here on the run has ended, whatever happens to this process
  SyncToDisk(folder_);
  CompleteFinish(folder_);
}

void ResultsFolder::Release() {
  if (lock_ < 0 && (finished_ || !ranks_.is_root())) return;
  std::error_code ignored;  // tidying up must not hide the error that led here
  const bool drop = !finished_ && !keep_parts_;
  if (lock_ >= 0) {
    if (drop) {
      for (const std::string& name : staged_) fs::remove(folder_ / PartOf(name), ignored);
      RemoveScratch(folder_);
      fs::remove(folder_ / PartOf(kMarker), ignored);
    }
    ::close(lock_);
    lock_ = -1;
  }
  if (!drop) return;
  for (const fs::path& folder : created_) fs::remove(folder, ignored);  // does nothing unless empty
  created_.clear();
}

}  // namespace nscdd
