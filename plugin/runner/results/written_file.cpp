// SPDX-License-Identifier: Apache-2.0
#include "results/written_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "nscdd/error.h"
#include "results/mapped_file.h"
#include "results/run_files.h"

namespace nscdd {

std::string CannotWrite(const std::filesystem::path& path, int system_error) {
  const bool full = system_error == ENOSPC || system_error == EDQUOT;
  return fmt::format("cannot write {} ({}): {}, or choose another folder with --out.", path.string(),
                     std::generic_category().message(system_error), full ? "free some space" : "mend its permissions");
}

StagedFile::StagedFile(const std::filesystem::path& path) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw Error(CannotWrite(path, errno));
}

StagedFile::StagedFile(const std::filesystem::path& path, std::uint64_t size) : path_(path), size_(size) {
  crc_.Add(MappedFile(path).bytes().first(size));
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0) throw Error(CannotWrite(path, errno));
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) {
    const int system_error = errno;
    ::close(descriptor_);
    throw Error(CannotWrite(path, system_error));
  }
}

StagedFile::~StagedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void StagedFile::Write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written >= 0) {
      crc_.Add(std::as_bytes(std::span(text.data(), static_cast<std::size_t>(written))));
      size_ += static_cast<std::uint64_t>(written);
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      throw Error(CannotWrite(path_, errno));
    }
  }
}

void StagedFile::Close() {
  const int status = ::close(descriptor_);
  descriptor_ = -1;
  if (status != 0) throw Error(CannotWrite(path_, errno));
}

void SyncToDisk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw Error(CannotWrite(path, errno));
  const int status = ::fsync(descriptor);
  const int system_error = errno;
  ::close(descriptor);
  // EINVAL: the file system has no such notion (some network mounts), and then nothing more can be done.
  if (status != 0 && system_error != EINVAL) throw Error(CannotWrite(path, system_error));
}

void CheckSpace(const std::filesystem::path& path, std::uint64_t bytes) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) throw Error(CannotWrite(path, errno));
  const off_t end = ::lseek(descriptor, 0, SEEK_END);
  const bool fits = ::fallocate(descriptor, FALLOC_FL_KEEP_SIZE, end, static_cast<off_t>(bytes)) == 0;
  const int system_error = errno;
  const bool is_free_again = ::ftruncate(descriptor, end) == 0;
  ::close(descriptor);
  if (!fits && (system_error == ENOSPC || system_error == EDQUOT || system_error == EFBIG))
    throw Error(CannotWrite(path, system_error));
  if (!is_free_again) throw Error(CannotWrite(path, errno));
}

namespace {

namespace fs = std::filesystem;

/// The file itself where `file` is a link.
fs::path Resolve(fs::path file) {
  std::error_code none;
  return fs::is_symlink(file, none) ? fs::weakly_canonical(file, none) : std::move(file);
}

[[noreturn]] void Refuse(const fs::path& file, int system_error) {
  throw Error(fmt::format("{}: the file cannot be written ({}); check the path, its permissions and the free space",
                          file.string(), std::generic_category().message(system_error)));
}

}  // namespace

ReplacedFile::ReplacedFile(fs::path file) : file_(Resolve(std::move(file))) {
  std::error_code none;
  const bool special = fs::exists(file_, none) && !fs::is_regular_file(file_, none);
  part_ = special ? file_ : fs::path(PartOf(file_.string()));
}

ReplacedFile::~ReplacedFile() {
  std::error_code ignored;
  if (!committed_ && part_ != file_) fs::remove(part_, ignored);
}

void ReplacedFile::Commit() {
  std::error_code error;
  if (part_ != file_) fs::rename(part_, file_, error);
  if (error) Refuse(file_, error.value());
  committed_ = true;
}

void ReplaceText(const fs::path& file, std::string_view text) {
  ReplacedFile replaced(file);
  std::ofstream out(replaced.part(), std::ios::binary);
  out << text;
  out.close();
  if (!out) Refuse(file, errno);
  replaced.Commit();
}

}  // namespace nscdd
