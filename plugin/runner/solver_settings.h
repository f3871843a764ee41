// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nscdd/host/solver_registry.h"
#include "nscdd/options.h"
#include "scene/scene.h"

namespace nscdd {

/// Options of a solver as text, in the order in which they are passed on.
using OptionList = std::vector<std::pair<std::string, std::string>>;

/// What the command line says about the solver; empty strings and lists: nothing.
struct SolverRequest {
  std::string plugin;  ///< path of the library
  std::string solver;  ///< name
  OptionList options;  ///< override the scene's
};

/// Which solver a run uses, and how.
struct SolverChoice {
  std::string name;
  OptionList options;
};

/// Joins what the scene and the command line ask for. Options of the scene that the solver chosen on the command line does not
/// have are left out if another solver has them. Throws Error, with file and line for the scene's, on unknown solvers and
/// options and on values that the solver refuses.
SolverChoice ChooseSolver(const Scene& scene, const SolverRequest& request, const SolverRegistry& registry);

/// The solver of that name; throws Error, with the nearest name, if there is none.
const nscdd_solver_info& RequireSolver(const SolverRegistry& registry, const std::string& name);

bool HasOption(const SolverRegistry& registry, const std::string& solver, const std::string& option);
bool AnySolverHas(const SolverRegistry& registry, const std::string& option);

/// Value of an option: the chosen one, or its default; "" if the solver has none of that name.
std::string OptionValue(const SolverChoice& choice, const SolverRegistry& registry, const std::string& name);
/// The same of a number.
std::optional<double> OptionNumber(const SolverChoice& choice, const SolverRegistry& registry, const std::string& name);

/// Scheme and contact law of the choice, as far as its solver knows these options, else the core's defaults.
SteppingOptions SteppingOf(const SolverChoice& choice, const SolverRegistry& registry);

}  // namespace nscdd
