// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "nscdd/answer_measures.h"
#include "nscdd/host/solver_registry.h"
#include "nscdd/options.h"
#include "nscdd/step_problem.h"
#include "scene/scene.h"

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

/// A number of the whole sample that a user may care about; evaluated at the end of a step.
enum class Observable {
  kCentreOfMassX,  ///< [m] of the free bodies
  kCentreOfMassY,  ///< [m]
  kKineticEnergy,  ///< [J] of the free bodies
  kWallForce,      ///< [N] length of the sum of all contact forces on prescribed bodies
  kWallForceX,     ///< [N] its components
  kWallForceY,     ///< [N]
  kFlowRate,       ///< [kg/s] momentum along x over the length of the sample: the period, else the width of the centres
};

/// Names as on the command line. Throws Error with those that exist.
Observable ParseObservable(const std::string& name);
std::string NameOf(Observable observable);
std::string UnitOf(Observable observable);
std::vector<std::string> ObservableNames();

/// `end`: poses at the end of the step, by row of bodies; `period` [m], 0 without.
double Evaluate(Observable observable, const StepProblem& step, const Answer& answer, const std::vector<Pose>& end,
                double period);

/// What the views need to know.
struct Plan {
  const Scene* scene = nullptr;
  std::string adapter;  ///< platform of the plugin's solvers
  const SolverRegistry* registry = nullptr;
  SteppingOptions stepping;                                         ///< of all settings; alert distance >= 0
  std::vector<std::pair<std::string, std::string>> stepping_texts;  ///< the same as options of a solver
  std::int64_t steps = 0;                                           ///< of the runs and of the reference
  std::int64_t problems = 0;                                        ///< recorded ones, evenly spread over the steps
  bool cold = false;                                                ///< recorded problems are solved from zero impulses
  Observable observable = Observable::kCentreOfMassY;
  double mean_radius = 0.0;  ///< [m] of the free bodies

  /// The setting with the stepping options that all share; none for Box2D.
  Setting Complete(Setting setting) const {
    if (setting.is_box2d()) return setting;
    for (const auto& option : stepping_texts) {
      if (setting.Option(option.first).empty()) setting.options.push_back(option);
    }
    return setting;
  }
};

/// Asked between steps; true: leave the rest out.
using StopQuestion = std::function<bool()>;

}  // namespace nscdd
