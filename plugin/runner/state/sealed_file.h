// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace nscdd {

/// Bytes before the HDF5 part of a state file (HDF5's user block): mark, version, size and checksum.
inline constexpr std::size_t kSealSize = 512;
inline constexpr std::int64_t kStateVersion = 1;

/// Writes the seal of a state file that is complete but for it. Throws Error when it cannot be written.
void Seal(const std::filesystem::path& path);

/// The checksum in the seal of these bytes. Throws Error, a clause about the file, unless they are those of a state file of
/// this version, as they were written.
std::uint64_t CheckSeal(std::span<const std::byte> bytes);

}  // namespace nscdd
