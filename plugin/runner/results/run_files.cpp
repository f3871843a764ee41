// SPDX-License-Identifier: Apache-2.0
#include "results/run_files.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

#include "nscdd/error.h"
#include "results/crc64.h"
#include "results/mapped_file.h"

namespace nscdd {

FileExtent ExtentOf(const std::filesystem::path& folder, const std::string& name) {
  const MappedFile file(folder / name);
  return {name, file.bytes().size(), Crc64Of(file.bytes())};
}

void CheckExtent(const std::filesystem::path& folder, const FileExtent& extent) {
  const MappedFile file(folder / extent.name);
  if (file.bytes().size() < extent.size) {
    throw Error(
        fmt::format("{} has {} bytes, {} were written.", (folder / extent.name).string(), file.bytes().size(), extent.size));
  }
  if (Crc64Of(file.bytes().first(extent.size)) != extent.crc) {
    throw Error(fmt::format("{} is damaged: its checksum is not that of what was written.", (folder / extent.name).string()));
  }
}

namespace {

namespace fs = std::filesystem;

/// The number in a name that is `begin`, digits, `end`.
std::optional<std::int64_t> NumberIn(std::string_view name, std::string_view begin, std::string_view end) {
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() < begin.size() + end.size()) return {};
  name = name.substr(begin.size(), name.size() - begin.size() - end.size());
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || stop != name.data() + name.size() || number < 0) return {};
  return number;
}

bool IsScratch(std::string_view name) {
  return name == "run.json.finished.part" || NumberIn(name, "checkpoint_", ".ckpt") ||
         NumberIn(name, "checkpoint_", ".ckpt.part") || NumberIn(name, "checkpoint_", ".ckpt.damaged") ||
         NumberIn(name, "results_", ".h5.part");
}

/// The files for whose names `is_meant` is true.
template <class Predicate>
void Remove(const fs::path& folder, Predicate is_meant) {
  std::error_code ignored;  // what stays is in nobody's way
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (is_meant(entry.path().filename().string())) files.push_back(entry.path());
  }
  for (const fs::path& file : files) fs::remove(file, ignored);
}

}  // namespace

std::string PartOf(const std::string& name) { return name + ".part"; }
std::string NameOfPart(const std::string& part) { return part.substr(0, part.size() - std::string_view(".part").size()); }
std::string CheckpointName(std::int64_t step) { return fmt::format("checkpoint_{:06}.ckpt", step); }
std::string SegmentName(std::int64_t step) { return fmt::format("results_{:06}.h5.part", step); }

std::vector<std::int64_t> CheckpointSteps(const fs::path& folder) {
  std::vector<std::int64_t> steps;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (const auto step = NumberIn(entry.path().filename().string(), "checkpoint_", ".ckpt")) steps.push_back(*step);
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

void RemoveSegmentsBut(const fs::path& folder, const std::vector<FileExtent>& kept) {
  Remove(folder, [&](const std::string& name) {
    return NumberIn(name, "results_", ".h5.part") &&
           std::none_of(kept.begin(), kept.end(), [&](const FileExtent& extent) { return extent.name == name; });
  });
}

void RemoveScratch(const fs::path& folder) { Remove(folder, IsScratch); }

}  // namespace nscdd
