// SPDX-License-Identifier: Apache-2.0
#include "checkpoint/resume_point.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <system_error>

#include "nscdd/error.h"
#include "results/results_file.h"
#include "results/run_files.h"
#include "results/written_file.h"
#include "state/state_file.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

void CheckFiles(const fs::path& folder, const CheckpointHead& head) {
  for (const auto* list : {&head.tables, &head.segments}) {
    for (const FileExtent& extent : *list) CheckExtent(folder, extent);
  }
}

void CopyFile(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) throw Error(CannotWrite(to, error.value()));
}

}  // namespace

ResumePoint::ResumePoint(const fs::path& folder, const RankGroup& ranks, bool has_finished) {
  if (has_finished) {
    ranks.RunTogether([&] { OpenState(folder / kStateName); });
    return;
  }
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

void ResumePoint::OpenState(const fs::path& file) {
  const StateReader state(file);
  try {
    checkpoint_.head = ParseHead(state.head().run);
    if (head().step != state.head().clock.step) throw Error(fmt::format("its run ended with step {}", head().step));
  } catch (const Error& e) {
    throw Error(fmt::format("{} cannot be used: {}.", file.string(), e.what()));
  }
  state.ForEachBody(0, state.bodies(), [this](const BodyDefinition& body) {
    bodies_.push_back({body.id, body.pose, body.velocity});
  });
  parts_ = state.SolverParts();
  for (const auto& part : parts_) checkpoint_.sections.push_back({{}, part});
  if (!parts_.empty()) checkpoint_.sections.front().bodies = std::as_bytes(std::span(bodies_));
}

void ResumePoint::CopyResults(ResultsFolder* results, bool drop_last) {
  const fs::path& folder = results->path();
  results->ranks().RunOnRoot([&] {
    CheckpointHead& head = checkpoint_.head;
    for (const auto* list : {&head.tables, &head.segments}) {
      for (const FileExtent& extent : *list) CheckExtent(folder, {NameOfPart(extent.name), extent.size, extent.crc});
    }
    for (const FileExtent& table : head.tables) {
      CopyFile(folder / NameOfPart(table.name), results->Stage(NameOfPart(table.name)));
    }
    const std::string segment = SegmentName(0);
    CopyResultsFile(folder / kResultsName, folder / segment, drop_last ? std::optional(head.step) : std::nullopt);
    SyncToDisk(folder / segment);
    head.segments = {ExtentOf(folder, segment)};
  });
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
