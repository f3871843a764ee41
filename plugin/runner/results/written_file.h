// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "results/crc64.h"

namespace nscdd {

/// A file that is written from its beginning, or from where a checkpoint saw its end. Every function throws Error, naming the
/// path, when the system refuses.
class StagedFile {
 public:
  explicit StagedFile(const std::filesystem::path& path);
  /// Goes on behind the file's first `size` bytes, and cuts what is there.
  StagedFile(const std::filesystem::path& path, std::uint64_t size);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Appends; what was written is in the system's hands, hence readable by others, when it returns.
  void Write(std::string_view text);
  void Write(std::span<const std::byte> bytes) { Write({reinterpret_cast<const char*>(bytes.data()), bytes.size()}); }
  void Close();

  /// Of all that the file holds.
  std::uint64_t size() const { return size_; }
  std::uint64_t crc() const { return crc_.value(); }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  Crc64 crc_;
};

/// Waits until the file or folder at `path` is on the disk.
void SyncToDisk(const std::filesystem::path& path);

/// Throws Error if the file at `path` could not grow by `bytes` now: for a library that does not bear a full disk. Says nothing
/// where the file system cannot tell.
void CheckSpace(const std::filesystem::path& path, std::uint64_t bytes);

/// "cannot write PATH (the system's reason): free some space, or choose another folder with --out".
std::string CannotWrite(const std::filesystem::path& path, int system_error);

/// A single file that the user names: it is written beside its place and takes it when complete, so that who reads the file
/// that was there before goes on reading that one, and a failure leaves it as it was. What is no regular file (a pipe, a
/// terminal) is written as it is; a link stays one.
class ReplacedFile {
 public:
  explicit ReplacedFile(std::filesystem::path file);
  ~ReplacedFile();  ///< without Commit(): removes what was written
  ReplacedFile(const ReplacedFile&) = delete;
  ReplacedFile& operator=(const ReplacedFile&) = delete;

  /// Where to write.
  const std::filesystem::path& part() const { return part_; }
  /// After what was written is closed. Throws Error, naming the file, when the system refuses.
  void Commit();

 private:
  std::filesystem::path file_, part_;
  bool committed_ = false;
};

/// A whole file of text. Throws Error as above.
void ReplaceText(const std::filesystem::path& file, std::string_view text);

}  // namespace nscdd
