// SPDX-License-Identifier: Apache-2.0
#include "commands/run_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <system_error>
#include <unordered_map>

#include "nscdd/error.h"
#include "results/run_files.h"
#include "run_results.h"
#include "scene/body_stream.h"
#include "scene/grain_size.h"
#include "state/state_reader.h"
#include "state/state_writer.h"

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

}  // namespace nscdd
