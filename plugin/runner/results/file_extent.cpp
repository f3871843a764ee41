// SPDX-License-Identifier: Apache-2.0
#include "results/file_extent.h"

#include <fmt/format.h>

#include "nscdd/error.h"
#include "results/crc64.h"
#include "results/mapped_file.h"

namespace nscdd {

FileExtent ExtentOf(const std::filesystem::path& folder, const std::string& name) {
  const MappedFile file(folder / name);
  Crc64 crc;
  crc.Add(file.bytes());
  return {name, file.bytes().size(), crc.value()};
}

void CheckExtent(const std::filesystem::path& folder, const FileExtent& extent) {
  const MappedFile file(folder / extent.name);
  if (file.bytes().size() < extent.size) {
    throw Error(
        fmt::format("{} has {} bytes, {} were written.", (folder / extent.name).string(), file.bytes().size(), extent.size));
  }
  Crc64 crc;
  crc.Add(file.bytes().first(extent.size));
  if (crc.value() != extent.crc) {
    throw Error(fmt::format("{} is damaged: its checksum is not that of what was written.", (folder / extent.name).string()));
  }
}

}  // namespace nscdd
