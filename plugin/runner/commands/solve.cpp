// SPDX-License-Identifier: Apache-2.0
#include "commands/commands.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/print_notes.h"
#include "nscdd/self_stress.h"
#include "problem/problem_file.h"

namespace nscdd {

void Solve(const std::filesystem::path& problem, const SolverRequest& request, bool self_stress) {
  const ProblemFile file = ReadProblemFile(problem);
  PrintNotes(file.notes);
  SolverRegistry registry;
  registry.Add(FindPlugin(request.plugin));
  Scene scene;  // the command line alone chooses
  scene.file = problem;
  scene.time.theta = file.theta;
  const SolverChoice choice = ChooseSolver(scene, request, registry);
  Solver solver = registry.Create({choice.name, choice.options, nullptr, {}});
  const ContactSolution solution = solver.Solve(file.problem);

  const SolveReport& report = solution.report;
  nlohmann::ordered_json json;
  json["solver"] = choice.name;
  json["status"] = NameOf(report.status);
  json["reason"] = report.reason;
  json["iterations"] = report.iterations;
  json["sweeps"] = report.sweeps;
  json["nat"] = report.residuals.nat;
  json["nat_max"] = report.residuals.nat_max;
  json["qm16"] = report.residuals.qm16;
  json["interface_jump"] = report.residuals.interface_jump;
  json["load_error"] = report.residuals.load_error;
  json["power"] = report.residuals.power;
  json["wall_error"] = report.residuals.wall_error;
  json["imbalance"] = report.imbalance;
  if (self_stress) json["undetermined_share"] = UndeterminedShare(file.problem, solution.impulse);
  if (!file.notes.sentences.empty()) json["notes"] = file.notes.sentences;
  for (const char* key : {"V_end", "r", "v"}) json[key] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < file.body_count; ++i) {
    const Twist& v = solution.velocity[i];
    for (const double number : {v.vx, v.vy, v.spin}) json["V_end"].push_back(number);
  }
  for (std::size_t c = 0; c < solution.impulse.size(); ++c) {
    for (const double number : {solution.impulse[c].x, solution.impulse[c].y}) json["r"].push_back(number);
    for (const double number : {solution.relative_velocity[c].x, solution.relative_velocity[c].y}) json["v"].push_back(number);
  }
  fmt::print("{}\n", json.dump(1));
}

}  // namespace nscdd
