// SPDX-License-Identifier: Apache-2.0
#include "solver_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "nscdd/error.h"
#include "scene/text.h"

namespace nscdd {
namespace {

/// Solvers that have an option, for the mend in a sentence.
std::string SolversWith(const SolverRegistry& registry, const std::string& option) {
  std::string names;
  for (const auto& entry : registry.entries()) {
    if (FindOption(*entry.info, option) == nullptr) continue;
    if (!names.empty()) names += ", ";
    names += entry.info->name;
  }
  return names;
}

[[noreturn]] void RefuseUnknown(const SolverRegistry& registry, const nscdd_solver_info& solver, const std::string& where,
                                const std::string& name) {
  if (AnySolverHas(registry, name)) {
    throw Error(fmt::format("{}solver '{}' has no option '{}'; choose solver {} or leave it out", where, solver.name, name,
                            SolversWith(registry, name)));
  }
  std::vector<std::string> known;
  for (std::uint64_t i = 0; i < solver.option_count; ++i) known.emplace_back(solver.options[i].name);
  throw Error(
      fmt::format("{}unknown option '{}' of solver '{}'; {}", where, name, solver.name, Suggestion(name, known, "options")));
}

/// Lets the solver itself judge one option; `where` comes before its sentence.
void CheckValue(const SolverRegistry& registry, const std::string& solver, const std::string& where, const std::string& name,
                const std::string& value) {
  try {
    registry.CheckOption(solver, name, value);
  } catch (const Error& e) {
    throw Error(where + e.what());
  }
}

void Set(OptionList* options, const std::string& name, const std::string& value) {
  for (auto& option : *options) {
    if (option.first == name) {
      option.second = value;
      return;
    }
  }
  options->emplace_back(name, value);
}

}  // namespace

SolverChoice ChooseSolver(const Scene& scene, const SolverRequest& request, const SolverRegistry& registry) {
  SolverChoice choice;
  const std::string file = scene.file.string();
  const bool from_scene = request.solver.empty();
  choice.name = from_scene ? scene.solver.name : request.solver;
  if (choice.name == "auto") {
    throw Error(
        fmt::format("{}solver 'auto' chooses while a scene runs, it works with `nscdd run` and `check` only; name one of the "
                    "solvers with --solver, or in the scene",
                    from_scene ? fmt::format("{}:{}: ", file, scene.solver.line) : ""));
  }
  const nscdd_solver_info* solver = nullptr;
  try {
    solver = &RequireSolver(registry, choice.name);
  } catch (const Error& e) {
    throw Error(from_scene ? fmt::format("{}:{}: key 'solver.name': {}", file, scene.solver.line, e.what())
                           : fmt::format("--solver: {}", e.what()));
  }
  const std::string theta = fmt::format("{}", scene.time.theta);
  CheckValue(registry, choice.name,
             scene.time.theta_line > 0 ? fmt::format("{}:{}: key 'time.theta': ", file, scene.time.theta_line) : file + ": ",
             "theta", theta);
  choice.options.emplace_back("theta", theta);
  for (const SolverOption& option : scene.solver.options) {
    const std::string where = fmt::format("{}:{}: key 'solver.{}': ", file, option.line, option.key);
    if (FindOption(*solver, option.key) == nullptr) {
      if (!from_scene && AnySolverHas(registry, option.key)) continue;
      RefuseUnknown(registry, *solver, where, option.key);
    }
    CheckValue(registry, choice.name, where, option.key, option.text);
    Set(&choice.options, option.key, option.text);
  }
  for (const auto& [name, value] : request.options) {
    if (FindOption(*solver, name) == nullptr) RefuseUnknown(registry, *solver, "command line: ", name);
    CheckValue(registry, choice.name, "command line: ", name, value);
    Set(&choice.options, name, value);
  }
  return choice;
}

const nscdd_solver_info& RequireSolver(const SolverRegistry& registry, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& entry : registry.entries()) {
    if (name == entry.info->name) return *entry.info;
    names.emplace_back(entry.info->name);
  }
  throw Error(fmt::format("there is no solver '{}'; {}", name, Suggestion(name, names, "solvers")));
}

bool AnySolverHas(const SolverRegistry& registry, const std::string& option) {
  const auto& all = registry.entries();
  return std::any_of(all.begin(), all.end(), [&](const auto& entry) { return FindOption(*entry.info, option) != nullptr; });
}

bool HasOption(const SolverRegistry& registry, const std::string& solver, const std::string& option) {
  return FindOption(*registry.Find(solver).info, option) != nullptr;
}

std::string OptionValue(const SolverChoice& choice, const SolverRegistry& registry, const std::string& name) {
  for (const auto& [key, value] : choice.options) {
    if (key == name) return value;
  }
  const nscdd_option* option = FindOption(*registry.Find(choice.name).info, name);
  return option ? option->default_value : "";
}

std::optional<double> OptionNumber(const SolverChoice& choice, const SolverRegistry& registry, const std::string& name) {
  const std::string text = OptionValue(choice, registry, name);
  if (text.empty()) return std::nullopt;
  return std::stod(text);  // the solver has accepted it
}

SteppingOptions SteppingOf(const SolverChoice& choice, const SolverRegistry& registry) {
  SteppingOptions o;
  const auto read = [&](const char* name, double* number) { *number = OptionNumber(choice, registry, name).value_or(*number); };
  read("theta", &o.theta);
  read("alert_distance", &o.alert_distance);
  read("feedback_beta", &o.feedback_beta);
  read("feedback_slop", &o.feedback_slop);
  read("feedback_cap", &o.feedback_cap);
  const std::string law = OptionValue(choice, registry, "normal_law");
  o.normal_law = law == "strict"     ? NormalLaw::kStrict
                 : law == "feedback" ? NormalLaw::kFeedback
                 : law == "gap"      ? NormalLaw::kGap
                                     : NormalLaw::kImpact;
  return o;
}

}  // namespace nscdd
