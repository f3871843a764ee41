// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "auto/pilot_state.h"
#include "mpi_session.h"
#include "nscdd/host/adapter_host.h"
#include "solver_settings.h"

namespace nscdd {

/// Runs a scene with solver "auto": holds the ladder's rungs and changes the solver between steps. All ranks decide the same.
class Pilot {
 public:
  /// Null unless the request, or else the scene, names the solver "auto". Throws Error on bad input.
  static std::unique_ptr<Pilot> Make(const Scene& scene, const SolverRequest& request, const SolverRegistry& registry,
                                     int ranks);

  /// Goes on with what Save() of an earlier run of the scene said.
  static std::unique_ptr<Pilot> Restore(const std::string& saved, const Scene& scene, const SolverRegistry& registry);
  std::string Save() const;

  /// Of the rung in use.
  const SolverChoice& choice() const { return state_.choices[state_.rung]; }
  /// After each step of `dt` [s]: exchanges `solver` for one of another rung, with the state of the old one, when it must be
  /// and another step follows (`goes_on`). Collective.
  void AfterStep(const StepReport& report, double dt, bool goes_on, const RankGroup& ranks, const MpiSession& session,
                 const AdapterHost& host, PlatformAdapter* adapter, Solver* solver);

  /// The last step after which the solver was exchanged, so that the new one has no tables yet and no host has ghosts; -1:
  /// none.
  std::int64_t changed_after() const { return changed_after_; }
  std::int64_t escalations() const { return watcher_.state().escalations; }
  std::int64_t descents() const { return watcher_.state().descents; }
  std::string Summary() const { return watcher_.Summary(state_.ladder.origin, rung().name); }

 private:
  Pilot(PilotState state, const Scene& scene, const SolverRegistry& registry);
  const Setting& rung() const { return state_.ladder.rungs[state_.rung]; }

  PilotState state_;  // but for the watcher's
  Watcher watcher_;
  SolverRegistry registry_;
  std::int64_t changed_after_ = -1;
};

}  // namespace nscdd
