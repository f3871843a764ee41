#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "auto/ladder.h"
#include "auto/watcher.h"
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

  /// Of the rung in use.
  const SolverChoice& choice() const { return choices_[rung_]; }
  /// After each step of `dt` [s]: exchanges `solver` for one of another rung, with the state of the old one, when it must be
  /// and another step follows (`goes_on`). Collective.
  void AfterStep(const StepReport& report, double dt, bool goes_on, const RankGroup& ranks, const MpiSession& session,
                 const AdapterHost& host, PlatformAdapter* adapter, Solver* solver);

  std::int64_t escalations() const { return watcher_.escalations(); }
  std::int64_t descents() const { return watcher_.descents(); }
  std::string Summary() const { return watcher_.Summary(ladder_.origin, ladder_.rungs[rung_].name); }

 private:
  Pilot(Ladder ladder, std::vector<SolverChoice> choices, const AutoSettings& wish, const SolverRegistry& registry);

  Ladder ladder_;
  std::vector<SolverChoice> choices_;  // a rung each, with what scene and command line ask for
  Watcher watcher_;
  const SolverRegistry& registry_;
  std::size_t rung_ = 0;
};

}  // namespace nscdd
