#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace nscdd {

/// A file that is written from its beginning. Every function throws Error, naming the path, when the system refuses.
class StagedFile {
 public:
  explicit StagedFile(const std::filesystem::path& path);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Appends; what was written is in the system's hands, hence readable by others, when it returns.
  void Write(std::string_view text);
  void Close();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Waits until the file or folder at `path` is on the disk.
void SyncToDisk(const std::filesystem::path& path);

/// "cannot write PATH (the system's reason): free some space, or choose another folder with --out".
std::string CannotWrite(const std::filesystem::path& path, int system_error);

}  // namespace nscdd
