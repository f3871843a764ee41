// SPDX-License-Identifier: Apache-2.0
#include "commands/run_plan.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <variant>

#include "nscdd/error.h"
#include "nscdd/grid_size.h"
#include "scene/read_scene.h"
#include "scene/toml_file.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

std::string NameOf(const nscdd_plugin& plugin) { return fmt::format("{} {}", plugin.name, plugin.version); }

/// What follows from the record, the scene and the solver.
void Complete(RunPlan* plan) {
  const PluginLibrary& library = *plan->registry.Find(plan->choice.name).module;
  if (plan->record.checkpoint_every > 0) library.RequireLoadStates();
  plan->record.plugin = NameOf(library.plugin());
  const GridSize grid = ParseGrid(OptionValue(plan->choice, plan->registry, "subdomains")).value_or(GridSize{});
  plan->subdomains_x = grid.nx;
  plan->subdomains_y = grid.ny;
}

}  // namespace

void RefuseConflicts(const RunRequest& request) {
  const std::pair<bool, const char*> given[] = {
      {!request.scene.empty(), "the scene file"},          {!request.solver.solver.empty(), "--solver"},
      {!request.solver.options.empty(), "solver options"}, {!request.adapter.empty(), "--adapter"},
      {request.save_every.has_value(), "--save-every"},    {!request.out.empty(), "--out"}};
  for (const auto& [is_given, what] : given) {
    if (!is_given) continue;
    throw Error(fmt::format(
        "--resume goes on with the run as it was begun: leave out {}, or begin another run without --resume.", what));
  }
}

RunPlan PlanRun(const RunRequest& request, int ranks) {
  if (request.scene.empty()) throw Error("give a scene file (nscdd run SCENE.toml), or --resume and the folder of a run.");
  RunPlan plan;
  RunRecord& record = plan.record;
  record.scene_text = ReadTomlText(request.scene);
  plan.scene = ParseScene(record.scene_text, request.scene);
  plan.registry.Add(FindPlugin(request.solver.plugin));
  plan.pilot = Pilot::Make(plan.scene, request.solver, plan.registry, ranks);
  plan.choice = plan.pilot ? plan.pilot->choice() : ChooseSolver(plan.scene, request.solver, plan.registry);
  record.program = NSCDD_VERSION;
  if (!request.solver.plugin.empty()) record.plugin_path = fs::absolute(request.solver.plugin).string();
  record.scene_file = request.scene.string();
  record.scene_path = fs::absolute(request.scene).string();
  record.scene_hash = HashOfFile(request.scene);
  record.adapter = request.adapter.empty() ? plan.scene.adapter : request.adapter;
  record.solver = plan.choice.name;
  record.options = plan.choice.options;
  record.steps = plan.scene.clock().step + request.steps.value_or(plan.scene.time.steps);
  record.save_every = request.save_every.value_or(plan.scene.output.save_every.value_or(0));
  record.checkpoint_every = request.checkpoint_every.value_or(plan.scene.output.checkpoint_every.value_or(0));
  Complete(&plan);
  return plan;
}

RunPlan PlanResumedRun(const RunRequest& request, const CheckpointHead& head) {
  const RunRecord& record = head.run;
  if (record.program != NSCDD_VERSION) {
    throw Error(fmt::format("the run in {} was begun by nscdd {}, this is {}: go on with that program.",
                            request.resume.string(), record.program, NSCDD_VERSION));
  }
  RunPlan plan;
  plan.record = record;
  plan.record.steps = request.steps.value_or(record.steps);
  plan.record.checkpoint_every = request.checkpoint_every.value_or(record.checkpoint_every);
  if (plan.record.steps <= head.step && record.steps == head.step) {
    throw Error(
        fmt::format("the run in {0} has finished ({1} steps): give a larger total to go on with it, such as --steps {2}.",
                    request.resume.string(), head.step, 2 * head.step));
  }
  if (plan.record.steps <= head.step) {
    throw Error(fmt::format("--steps {}: the checkpoint in {} is after step {}; give a larger total, or leave it out.",
                            plan.record.steps, request.resume.string(), head.step));
  }
  plan.scene = ParseScene(record.scene_text, record.scene_path);
  plan.registry.Add(FindPlugin(request.solver.plugin.empty() ? record.plugin_path : request.solver.plugin));
  if (!head.pilot.empty()) plan.pilot = Pilot::Restore(head.pilot, plan.scene, plan.registry);
  plan.choice = plan.pilot ? plan.pilot->choice() : SolverChoice{record.solver, record.options};
  Complete(&plan);
  if (plan.record.plugin != record.plugin) {
    throw Error(fmt::format("the run in {} was begun with the plugin {}, this is {}: give that one with --plugin.",
                            request.resume.string(), record.plugin, plan.record.plugin));
  }
  return plan;
}

std::vector<InputFile> InputsOf(const Scene& scene) {
  std::vector<InputFile> inputs;
  for (const BodySource& source : scene.bodies) {
    const auto add = [&](const fs::path& path) { inputs.push_back({fs::absolute(path).string(), HashOfFile(path)}); };
    if (const auto* file = std::get_if<DiskFile>(&source.what)) add(file->path);
    if (const auto* state = std::get_if<StateBodies>(&source.what)) add(state->path);
  }
  return inputs;
}

void CheckInputs(const std::vector<InputFile>& inputs) {
  for (const InputFile& input : inputs) {
    if (HashOfFile(input.path) == input.hash) continue;
    throw Error(
        fmt::format("{} has changed since the run was begun: put the file back as it was, or begin the run anew.", input.path));
  }
}

RunIdentity IdentityOf(const RunPlan& plan, int ranks) {
  const RunRecord& run = plan.record;
  RunIdentity identity{plan.scene.name,   run.scene_file, run.scene_hash, run.program, {}, plan.scene.notes.sentences,
                       plan.scene.time.dt};
  identity.notes.insert(identity.notes.end(), run.notes.begin(), run.notes.end());
  identity.settings = {
      {"adapter", run.adapter}, {"ranks", std::to_string(ranks)}, {"steps", std::to_string(run.steps)}, {"solver", run.solver}};
  if (plan.scene.start) {
    identity.settings.emplace_back("start_state", plan.scene.start->path.string());
    identity.settings.emplace_back("start_step", std::to_string(plan.scene.clock().step));
  }
  if (run.checkpoint_every > 0) identity.settings.emplace_back("checkpoint_every", std::to_string(run.checkpoint_every));
  identity.settings.insert(identity.settings.end(), run.options.begin(), run.options.end());
  return identity;
}

}  // namespace nscdd
