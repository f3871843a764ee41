// SPDX-License-Identifier: Apache-2.0
#include "results/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "nscdd/error.h"

namespace nscdd {
namespace {

[[noreturn]] void Refuse(const std::filesystem::path& path, int system_error) {
  throw Error(fmt::format("cannot read {} ({}): check that it exists and its permissions.", path.string(),
                          std::generic_category().message(system_error)));
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) Refuse(path, errno);
  struct stat status {};
  int system_error = ::fstat(descriptor, &status) != 0 ? errno : 0;
  if (system_error == 0 && !S_ISREG(status.st_mode)) system_error = EINVAL;
  const auto size = static_cast<std::size_t>(status.st_size);
  if (system_error == 0 && size > 0) {
    void* memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (memory == MAP_FAILED) {
      system_error = errno;
    } else {
      bytes_ = {static_cast<const std::byte*>(memory), size};
    }
  }
  ::close(descriptor);
  if (system_error != 0) Refuse(path, system_error);
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace nscdd
