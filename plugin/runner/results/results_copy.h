// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace nscdd {

/// Copies all that is in a results.h5, but for the root's attributes and the step `dropped`, into a new file: a segment that
/// ResultsFile goes on behind. By one process. Throws Error when the one cannot be read or the other not be written.
void CopyResultsFile(const std::filesystem::path& from, const std::filesystem::path& to, std::optional<std::int64_t> dropped);

}  // namespace nscdd
