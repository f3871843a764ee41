// SPDX-License-Identifier: Apache-2.0
#include "checkpoint/resume_point.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "nscdd/error.h"
#include "results/run_files.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

void CheckFiles(const fs::path& folder, const CheckpointHead& head) {
  for (const auto* list : {&head.tables, &head.segments}) {
    for (const FileExtent& extent : *list) CheckExtent(folder, extent);
  }
}

}  // namespace

ResumePoint::ResumePoint(const fs::path& folder, const RankGroup& ranks) {
  std::int64_t step = std::numeric_limits<std::int64_t>::max();
  ranks.RunOnRoot([&] { step = Choose(folder); });
  step = ranks.Min(step);
  ranks.RunTogether([&] {
    if (!ranks.is_root()) Open(folder / CheckpointName(step));
  });
}

void ResumePoint::Open(const fs::path& file) {
  file_ = std::make_unique<MappedFile>(file);
  checkpoint_ = ParseCheckpoint(file_->bytes());
}

std::int64_t ResumePoint::Choose(const fs::path& folder) {
  const std::vector<std::int64_t> steps = CheckpointSteps(folder);
  std::vector<std::string> damaged;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    const std::string name = CheckpointName(*step);
    try {
      Open(folder / name);
      if (head().step != *step) throw Error(fmt::format("it was written after step {}", head().step));
      CheckFiles(folder, head());
      for (const std::string& bad : damaged) fs::rename(folder / bad, folder / (bad + ".damaged"));
      return *step;
    } catch (const Error& e) {
      warnings_.push_back(fmt::format("{} cannot be used: {}", name, e.what()));
      damaged.push_back(name);
    }
  }
  throw Error(
      fmt::format("no checkpoint in {} can be used, begin the run anew: {}", folder.string(), fmt::join(warnings_, "; ")));
}

}  // namespace nscdd
