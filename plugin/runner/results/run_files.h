// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

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

// Names of the files that a run has in its folder before it ends.

/// Of a file that gets the name `name` at the end.
std::string PartOf(const std::string& name);
/// The name that a PartOf() gets at the end.
std::string NameOfPart(const std::string& part);
inline constexpr const char* kResultsName = "results.h5";
inline constexpr const char* kStateName = "state.h5";
/// Of the checkpoint after step `step`.
std::string CheckpointName(std::int64_t step);
/// Of the part of results.h5 that begins with step `step`; 0: with the shapes.
std::string SegmentName(std::int64_t step);

/// Steps of the checkpoints in a folder, ascending.
std::vector<std::int64_t> CheckpointSteps(const std::filesystem::path& folder);

/// Removes the parts of results.h5 that are not in `kept`.
void RemoveSegmentsBut(const std::filesystem::path& folder, const std::vector<FileExtent>& kept);

/// Removes checkpoints, finished or not, and parts of results.h5.
void RemoveScratch(const std::filesystem::path& folder);

}  // namespace nscdd
