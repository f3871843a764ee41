// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "nscdd/host/solver_registry.h"

namespace nscdd {

/// One way to solve a scene: a solver of the plugin with its options as text, or "box2d", Box2D's own solver, with
/// velocity_iterations and position_iterations.
struct Setting {
  std::string name;  ///< for tables, unique in a list
  std::string solver;
  std::vector<std::pair<std::string, std::string>> options;
  int substeps = 1;    ///< steps of dt / substeps for one step of the scene
  bool quick = false;  ///< also part of the short list

  bool is_box2d() const { return solver == "box2d"; }
  /// Value of an option of the list; `fallback` if it is not there.
  std::string Option(const std::string& key, const std::string& fallback = "") const;
};

/// Name of the setting that the scene itself asks for.
inline constexpr const char* kSceneSetting = "the scene's own";

/// The settings that `nscdd tradeoff` measures by default.
std::vector<Setting> DefaultSettings();

/// [[settings]] of a TOML file: name, solver, substeps and, as in a scene's [solver], options. Throws Error with file and line,
/// also for values that a solver in `registry` refuses.
std::vector<Setting> ReadSettings(const std::filesystem::path& file, const SolverRegistry& registry);

/// Drops settings whose solver or option no loaded plugin has; one sentence each distinct reason is added to `notices`.
std::vector<Setting> KnownSettings(std::vector<Setting> settings, const SolverRegistry& registry,
                                   std::vector<std::string>* notices);

/// The subdomains that the setting asks for, or its solver has by default, such as "2x2"; "1x1" where it knows none.
std::string GridOf(const Setting& setting, const SolverRegistry& registry);

/// The lines of a scene file that choose the setting: [solver], and a remark on [time] if it sub-steps.
std::string SolverSection(const Setting& setting);

}  // namespace nscdd
