// SPDX-License-Identifier: Apache-2.0
#include "scene/read_bodies.h"

#include <fmt/format.h>

#include "state/state_file.h"

namespace nscdd {
namespace {

/// The clock at the first step of a run of time step `dt` that goes on from `head`.
RunClock ClockAfter(const StateHead& head, double dt) {
  RunClock clock = head.clock;
  if (dt == head.dt) return clock;
  clock.even_since = clock.step;
  clock.even_time = clock.time;
  return clock;
}

}  // namespace

void ReadStart(TableReader* root, Scene* scene) {
  std::optional<TableReader> table = root->Table("start");
  if (!table) return;
  const std::filesystem::path path = scene->file.parent_path() / table->Text("state");
  const bool goes_on = table->Choice("clock", {"continue", "zero"}, "continue") == "continue";
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    table->Refuse("state", fmt::format("names {}, which is not there; give the state.h5 that a run has left, from the scene's "
                                       "folder on",
                                       path.string()));
  }
  const StateReader state(path);
  if (state.bodies() == 0) table->Refuse("state", fmt::format("names {}, which has no body", path.string()));
  const StateHead& head = state.head();
  scene->start = StartState{path, goes_on ? ClockAfter(head, scene->time.dt) : RunClock{}};
  scene->materials = head.materials;
  if (head.period > 0.0) scene->periodic = Periodicity{head.period_origin, head.period};
  BodySource source;
  source.key = "start";
  source.line = table->Line();
  source.what = StateBodies{path, state.checksum(), head.mean_radius};
  source.count = state.bodies();
  scene->bodies.push_back(std::move(source));
  table->Finish();
}

}  // namespace nscdd
