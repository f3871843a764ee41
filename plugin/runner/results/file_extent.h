// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace nscdd {

/// The beginning of a file, as a checkpoint remembers it: what comes behind was written later.
struct FileExtent {
  std::string name;  ///< in the folder of the results
  std::uint64_t size = 0;
  std::uint64_t crc = 0;  ///< CRC-64/XZ of these bytes
};

/// The whole file as it is now. Throws Error if it cannot be read.
FileExtent ExtentOf(const std::filesystem::path& folder, const std::string& name);

/// Throws Error, naming the file, if it does not begin with these bytes any more.
void CheckExtent(const std::filesystem::path& folder, const FileExtent& extent);

}  // namespace nscdd
