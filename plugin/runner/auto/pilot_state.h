// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "auto/ladder.h"
#include "auto/watcher.h"
#include "solver_settings.h"

namespace nscdd {

/// All that a run with solver "auto" goes on with, whatever has become of the front's file.
struct PilotState {
  Ladder ladder;
  std::vector<SolverChoice> choices;  ///< a rung each, with what scene and command line ask for
  std::size_t rung = 0;
  WatcherState watcher;
};

/// As text for a checkpoint; numbers read back the same.
std::string FormatPilotState(const PilotState& state);
/// Throws Error if it is not text of FormatPilotState().
PilotState ParsePilotState(const std::string& text);

}  // namespace nscdd
