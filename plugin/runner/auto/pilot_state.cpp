// SPDX-License-Identifier: Apache-2.0
#include "auto/pilot_state.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "nscdd/error.h"

namespace nscdd {

// Found by the JSON library beside the types.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Setting, name, solver, options)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Ladder, rungs, origin)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SolverChoice, name, options)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WatcherState, depth, steps, escalations, descents, missed, by_geometry, not_converged,
                                   over_budget, since_change, quick)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PilotState, ladder, choices, rung, watcher)

std::string FormatPilotState(const PilotState& state) { return nlohmann::json(state).dump(); }

PilotState ParsePilotState(const std::string& text) {
  bool is_sound = true;
  // The library would convert 1e300 or -1.5 where a count stands, which is undefined.
  const auto look = [&](int, nlohmann::json::parse_event_t, const nlohmann::json& value) {
    if (value.is_number_float()) is_sound = is_sound && value.get<double>() >= 0.0 && value.get<double>() < 9e15;
    return is_sound;
  };
  try {
    const auto json = nlohmann::json::parse(text, look);
    if (is_sound) {
      auto state = json.get<PilotState>();
      if (state.rung < state.choices.size() && state.choices.size() == state.ladder.rungs.size()) return state;
    }
  } catch (const nlohmann::json::exception&) {
  }
  throw Error("the checkpoint does not say which settings solver 'auto' may use: begin the run anew.");
}

}  // namespace nscdd
