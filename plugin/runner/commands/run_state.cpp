// SPDX-License-Identifier: Apache-2.0
#include "commands/run_state.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>
#include <system_error>
#include <unordered_map>
#include <vector>

#include "nscdd/error.h"
#include "results/run_files.h"
#include "run_results.h"
#include "scene/body_stream.h"
#include "state/state_file.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

/// The bodies that this rank owns: the scene says what they are, the solver's table where they are and how they move.
std::vector<BodyDefinition> BodiesAtEnd(const Scene& scene, const GrainTable& grains, int ranks) {
  std::unordered_map<std::int64_t, std::size_t> row;
  for (std::size_t i = 0; i < grains.size(); ++i) row.emplace(grains.id[i], i);
  std::vector<BodyDefinition> bodies(grains.size());
  std::size_t found = 0;
  for (int rank = 0; rank < ranks; ++rank) {  // bodies have wandered since each rank made its share of them
    ForEachBody(scene, rank, ranks, [&](const BodyDefinition& body) {
      const auto place = row.find(body.id);
      if (place == row.end()) return;
      const std::size_t i = place->second;
      bodies[i] = body;
      bodies[i].pose = {grains.x[i], grains.y[i], grains.angle[i]};
      bodies[i].velocity = {grains.vx[i], grains.vy[i], grains.spin[i]};
      ++found;
    });
  }
  if (found != grains.size()) {
    throw Error(fmt::format("{} bodies of the last step are not in {} any more: leave its files alone during a run.",
                            grains.size() - found, scene.file.string()));
  }
  return bodies;
}

/// Nothing if the plugin cannot tell: whoever goes on is told then.
std::vector<std::byte> SavedBy(const Solver& solver) {
  try {
    return solver.SaveState();
  } catch (const Error&) {
    return {};
  }
}

StateHead HeadOf(const RunPlan& plan, const RunClock& clock) {
  const double radius = MeanGrainRadius(plan.scene);
  StateHead head;
  head.program = plan.record.program;
  head.plugin = plan.record.plugin;
  head.scene = plan.scene.name;
  head.clock = clock;
  head.dt = plan.scene.time.dt;
  if (plan.scene.periodic) {
    head.period = plan.scene.periodic->length;
    head.period_origin = plan.scene.periodic->origin;
  }
  head.mean_radius = std::isfinite(radius) ? radius : 0.0;
  head.materials = plan.scene.materials;
  return head;
}

}  // namespace

void WriteState(const RunPlan& plan, const RunClock& clock, const std::vector<FileExtent>& tables, const Solver& solver,
                ResultsFolder* folder) {
  const RankGroup& ranks = folder->ranks();
  StateHead head = HeadOf(plan, clock);
  std::vector<BodyDefinition> bodies;
  std::vector<std::byte> state;
  ranks.RunTogether([&] {
    bodies = BodiesAtEnd(plan.scene, MakeGrainTable(solver), ranks.size());
    state = SavedBy(solver);
  });
  ranks.RunOnRoot([&] {
    CheckpointHead run;
    run.run = plan.record;
    if (plan.pilot) run.pilot = plan.pilot->Save();
    run.step = clock.step;
    run.ranks = ranks.size();
    run.tables = tables;
    run.segments = {ExtentOf(folder->path(), PartOf(kResultsName))};
    head.run = FormatHead(run);
  });
  WriteStateFile(folder->path() / PartOf(kStateName), head, bodies, state, ranks);
  folder->Stage(kStateName);
}

std::string LoadSolverState(const RunPlan& plan, const RankGroup& ranks, Solver* solver) {
  std::string saved_by;
  std::vector<std::vector<std::byte>> parts;
  ranks.RunTogether([&] {
    const StateReader state(plan.scene.start->path);
    saved_by = state.head().plugin;
    parts = state.SolverParts();
  });
  if (saved_by != plan.record.plugin)
    return fmt::format("it was saved by the plugin {}, this is {}", saved_by, plan.record.plugin);
  std::vector<std::span<const std::byte>> mine;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (static_cast<int>(i % static_cast<std::size_t>(ranks.size())) == ranks.rank()) mine.push_back(parts[i]);
  }
  try {
    solver->LoadStates(mine);
  } catch (const Error& e) {  // the same on all ranks
    return e.what();
  }
  return "";
}

void CheckStartStays(const Scene& scene, const fs::path& folder) {
  if (!scene.start) return;
  std::error_code error;
  if (!fs::equivalent(scene.start->path, folder / kStateName, error) || error) return;
  throw Error(
      fmt::format("the results in {} would take the place of the state that the scene begins with: choose another folder "
                  "with --out.",
                  folder.string()));
}

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
