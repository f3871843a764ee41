// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "nscdd/options.h"
#include "scene/scene.h"
#include "tradeoff/observable.h"
#include "tradeoff/setting.h"

namespace nscdd {

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
