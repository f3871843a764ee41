// SPDX-License-Identifier: Apache-2.0
#include "commands/run_checkpoints.h"

#include <fmt/format.h>

#include <vector>

#include "nscdd/error.h"
#include "run_results.h"

namespace nscdd {
namespace {

std::vector<SavedBody> BodiesOf(const Solver& solver) {
  const GrainTable grains = MakeGrainTable(solver);
  std::vector<SavedBody> bodies;
  bodies.reserve(grains.size());
  for (std::size_t i = 0; i < grains.size(); ++i) {
    bodies.push_back({grains.id[i], {grains.x[i], grains.y[i], grains.angle[i]}, {grains.vx[i], grains.vy[i], grains.spin[i]}});
  }
  return bodies;
}

/// Of a host without ghosts.
std::vector<SavedBody> BodiesOf(PlatformAdapter* adapter) {
  BodyTable table;
  adapter->ReadBodies(&table);
  std::vector<SavedBody> bodies;
  for (std::size_t i = 0; i < table.size(); ++i) bodies.push_back({table.id[i], table.pose[i], table.velocity[i]});
  return bodies;
}

}  // namespace

std::vector<SavedBody> RunCheckpoints::BodiesAfter(std::int64_t step) {
  const std::int64_t first = plan_.scene.clock().step;
  if (step == first) return {};  // they are the scene's
  const bool solver_is_new = plan_.pilot && plan_.pilot->changed_after() == step - first;
  return solver_is_new ? BodiesOf(&platform_->adapter()) : BodiesOf(*solver_);
}

void RunCheckpoints::Write(std::int64_t step) {
  CheckpointHead head;
  head.run = plan_.record;
  if (plan_.pilot) head.pilot = plan_.pilot->Save();
  head.step = step;
  head.ranks = folder_->ranks().size();
  head.tables = csv_->Keep();
  head.segments = file_->Keep();
  std::vector<SavedBody> bodies;
  std::vector<std::byte> state;
  folder_->ranks().RunTogether([&] {
    bodies = BodiesAfter(step);
    state = solver_->SaveState();
  });
  WriteCheckpoint(folder_->path(), head, bodies, state, folder_->ranks());
  last_step_ = step;
}

bool RunCheckpoints::IsToldToEnd(std::int64_t step) {
  const bool told = folder_->ranks().Min(stop_.received() != 0 ? 0 : 1) == 0;
  if (told && last_step_ != step) Write(step);
  return told;
}

std::string RunCheckpoints::command() const { return fmt::format("nscdd run --resume {}", folder_->path().string()); }

void Restore(const Checkpoint& checkpoint, std::int64_t bodies, const RankGroup& ranks, Platform* platform, Solver* solver) {
  std::int64_t saved = 0, restored = 0;
  std::vector<std::span<const std::byte>> states;
  ranks.RunTogether([&] {
    for (std::size_t i = 0; i < checkpoint.sections.size(); ++i) {
      const CheckpointSection& section = checkpoint.sections[i];
      for (std::size_t k = 0; k < section.body_count(); ++k) {
        const SavedBody body = section.body(k);
        restored += platform->Restore(body.id, body.pose, body.velocity) ? 1 : 0;
      }
      saved += static_cast<std::int64_t>(section.body_count());
      if (static_cast<int>(i % static_cast<std::size_t>(ranks.size())) == ranks.rank()) states.push_back(section.state);
    }
  });
  const std::int64_t strangers = saved - ranks.Sum(restored), missing = ranks.Sum(bodies - restored);
  if (strangers != 0 || missing != 0) {
    throw Error(
        fmt::format("the checkpoint has {} bodies that are not in the scene, and lacks {} that are: begin the run anew.",
                    strangers, missing));
  }
  solver->LoadStates(states);
}

}  // namespace nscdd
