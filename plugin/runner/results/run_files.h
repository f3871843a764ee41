// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "results/file_extent.h"

namespace nscdd {

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
