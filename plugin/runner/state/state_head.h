// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/material.h"
#include "scene/run_clock.h"

namespace nscdd {

/// What a state file says beside its bodies and its solver's state.
struct StateHead {
  std::string program;  ///< version
  std::string plugin;   ///< name and version; its solver wrote the solver's state
  std::string scene;    ///< name
  RunClock clock;
  double dt = 0.0;             ///< [s] of the last step
  double period = 0.0;         ///< [m] 0: not periodic
  double period_origin = 0.0;  ///< [m]
  double mean_radius = 0.0;    ///< [m] of the grains; 0: there are none
  std::vector<Material> materials;
  std::string run;  ///< what `nscdd run --resume` goes on with: text of FormatHead()
};

}  // namespace nscdd
