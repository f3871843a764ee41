#include "results/staged_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "nscdd/error.h"

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

StagedFile::~StagedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void StagedFile::Write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written >= 0) {
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

}  // namespace nscdd
