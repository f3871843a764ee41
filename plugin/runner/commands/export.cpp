// SPDX-License-Identifier: Apache-2.0
#include "commands/commands.h"

#include <fmt/format.h>

#include <utility>

#include "commands/print_notes.h"
#include "nscdd/error.h"
#include "nscdd/host/adapter_host.h"
#include "problem/problem_file.h"
#include "run_results.h"
#include "scene/platform.h"
#include "scene/read_scene.h"

namespace nscdd {
namespace {

/// A contact problem, its answer, and what to say about it.
struct Exported {
  std::string title;
  std::string description;
  ContactProblem problem;
  ContactSolution answer;
};

std::string DescriptionOf(const std::string& what, const SolverChoice& choice, const SolveReport& report) {
  return fmt::format("{}; answer of nscdd {}, solver {}: {}, nat {:.3g}, nat_max {:.3g}", what, NSCDD_VERSION, choice.name,
                     NameOf(report.status), report.residuals.nat, report.residuals.nat_max);
}

Exported FromScene(const ExportRequest& request) {
  const Scene scene = ReadSceneFile(request.input);
  PrintNotes(scene.notes);
  SolverRegistry registry;
  registry.Add(FindPlugin(request.solver.plugin));
  const SolverChoice choice = ChooseSolver(scene, request.solver, registry);
  const auto platform = MakePlatform(request.adapter.empty() ? scene.adapter : request.adapter, scene);
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) { platform->Add(body); });
  StepRecorder recorder(&platform->adapter());
  AdapterHost host(&recorder);
  Solver solver = registry.Create({choice.name, choice.options, host.table(), {}});
  for (std::int64_t step = 1; step <= request.step; ++step) {
    platform->SetGravity(GravityAt(scene.gravity, step, scene.time.dt, scene.clock()));
    solver.Step(scene.time.dt);
  }
  RecordedStep step = recorder.Problem(SteppingOf(choice, registry), scene.time.dt);
  if (!request.json.empty()) WriteProblemFile(request.json, step, scene.time.dt, scene.time.theta);
  const SolveReport report = solver.Report().solve;
  const std::string what = fmt::format("step {} of scene {}, dt {} s", request.step, scene.name, scene.time.dt);
  return {scene.title.empty() ? scene.name : scene.title,
          DescriptionOf(what, choice, report),
          std::move(step.problem),
          {std::move(step.velocity), std::move(step.impulse), {}, report}};
}

Exported FromProblem(const ExportRequest& request) {
  if (!request.json.empty()) throw Error("--json: the input is a problem file already; leave it out");
  ProblemFile file = ReadProblemFile(request.input);
  PrintNotes(file.notes);
  SolverRegistry registry;
  registry.Add(FindPlugin(request.solver.plugin));
  Scene scene;  // the command line alone chooses
  scene.file = request.input;
  scene.time.theta = file.theta;
  const SolverChoice choice = ChooseSolver(scene, request.solver, registry);
  Solver solver = registry.Create({choice.name, choice.options, nullptr, {}});
  ContactSolution answer = solver.Solve(file.problem);
  const std::string name = request.input.stem().string();
  return {name, DescriptionOf("problem " + name, choice, answer.report), std::move(file.problem), std::move(answer)};
}

}  // namespace

void Export(const ExportRequest& request) {
  if (request.fclib.empty() && request.json.empty())
    throw Error("export: nothing to write; give --fclib FILE.h5 or --json FILE.json");
  const bool problem = request.input.extension() == ".json";
  const Exported exported = problem ? FromProblem(request) : FromScene(request);
  if (!request.fclib.empty()) {
    WriteFclibFile(request.fclib, exported.title, exported.description, exported.problem, exported.answer);
  }
  fmt::print("{}\n{} bodies, {} contacts\n", exported.description, exported.problem.mass.size(),
             exported.problem.contacts.size());
  for (const auto& file : {request.fclib, request.json}) {
    if (!file.empty()) fmt::print("{}\n", file.string());
  }
}

}  // namespace nscdd
