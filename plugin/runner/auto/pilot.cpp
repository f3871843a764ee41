// SPDX-License-Identifier: Apache-2.0
#include "auto/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "nscdd/error.h"
#include "nscdd/grid_size.h"
#include "nscdd/step_problem.h"

namespace nscdd {
namespace {

constexpr const char* kAuto = "auto";

AutoSettings WishOf(const Scene& scene) { return scene.solver.wish.value_or(AutoSettings{1e-3, true, {}}); }

/// What a request or a scene says of the grid; "" if nothing.
std::string WantedGrid(const Scene& scene, const SolverRequest& request) {
  std::string grid;
  for (const SolverOption& option : scene.solver.options) {
    if (option.key == "subdomains") grid = option.text;
  }
  for (const auto& [key, value] : request.options) {
    if (key == "subdomains") grid = value;
  }
  if (!grid.empty() && !ParseGrid(grid))
    throw Error(fmt::format("solver 'auto': option 'subdomains' is '{}'; write it as 4x2", grid));
  return grid;
}

/// The rung as a choice: its options go before the scene's, those of the command line before both.
SolverChoice ChoiceOf(const Setting& rung, const Scene& scene, const SolverRequest& request, const SolverRegistry& registry) {
  SolverRequest own{request.plugin, rung.solver, rung.options};
  for (const auto& option : request.options) {
    const bool elsewhere = !HasOption(registry, rung.solver, option.first) && AnySolverHas(registry, option.first);
    if (!elsewhere) own.options.push_back(option);  // nscd has no grid, for instance: 1x1 says the same
  }
  return ChooseSolver(scene, own, registry);
}

/// [m] largest growth of an interpenetration that the velocities at the end of the step explain, on this rank.
double SolverGrowth(const Solver& solver, double dt) {
  const TableView t = solver.Table("contacts");
  const auto gap = t.Real("gap"), vn = t.Real("velocity_n");
  double growth = 0.0;
  for (std::size_t c = 0; c < gap.size(); ++c) {
    growth = std::max(growth, DepthGrowth(gap[c], vn[c], dt));
  }
  return growth;
}

/// Largest over the ranks; picometres and nanoseconds are fine enough, and exact.
double Largest(const RankGroup& ranks, double value, double unit) {
  const double most = std::min(std::round(value / unit), 9e18);
  return -static_cast<double>(ranks.Min(-static_cast<std::int64_t>(most))) * unit;
}

/// A new solver begins with every body in one host only.
void RemoveGhosts(const Solver& solver, PlatformAdapter* adapter) {
  const auto owned = solver.Table("bodies").Integer("id");
  const std::set<std::int64_t> keep(owned.begin(), owned.end());
  BodyTable bodies;
  adapter->ReadBodies(&bodies);
  for (const std::int64_t id : bodies.id) {
    if (!keep.contains(id)) adapter->transport()->Remove(id);
  }
}

}  // namespace

Pilot::Pilot(PilotState state, const Scene& scene, const SolverRegistry& registry)
    : state_(std::move(state)), watcher_(WishOf(scene), state_.watcher), registry_(registry) {}

std::unique_ptr<Pilot> Pilot::Restore(const std::string& saved, const Scene& scene, const SolverRegistry& registry) {
  return std::unique_ptr<Pilot>(new Pilot(ParsePilotState(saved), scene, registry));
}

std::string Pilot::Save() const {
  PilotState state = state_;
  state.watcher = watcher_.state();
  return FormatPilotState(state);
}

std::unique_ptr<Pilot> Pilot::Make(const Scene& scene, const SolverRequest& request, const SolverRegistry& registry,
                                   int ranks) {
  if ((request.solver.empty() ? scene.solver.name : request.solver) != kAuto) return nullptr;
  const std::filesystem::path file = FrontFileOf(scene.file);
  const bool measured = std::filesystem::exists(file);
  Ladder ladder = MakeLadder(WishOf(scene), WantedGrid(scene, request), ranks,
                             measured ? ReadFront(file) : std::vector<FrontEntry>{}, file.string(), registry);
  if (ladder.rungs.empty())
    throw Error("solver 'auto': the plugin has none of the solvers that it would choose from; name one");
  PilotState state;
  for (const Setting& rung : ladder.rungs) state.choices.push_back(ChoiceOf(rung, scene, request, registry));
  state.ladder = std::move(ladder);
  return std::unique_ptr<Pilot>(new Pilot(std::move(state), scene, registry));
}

void Pilot::AfterStep(const StepReport& report, double dt, bool goes_on, const RankGroup& ranks, const MpiSession& session,
                      const AdapterHost& host, PlatformAdapter* adapter, Solver* solver) {
  if (report.step == 1) {  // overlaps of the start
    const auto gap = solver->Table("contacts").Real("gap");
    double deepest = 0.0;
    for (const double g : gap) deepest = std::max(deepest, -g);
    watcher_.SetStart(Largest(ranks, deepest, 1e-12));
  }
  const double growth = watcher_.IsTooDeep(report) ? Largest(ranks, SolverGrowth(*solver, dt), 1e-12) : 0.0;
  const double seconds = Largest(ranks, report.seconds_total, 1e-9);
  const auto verdict =
      watcher_.Judge(report, growth, seconds, goes_on && state_.rung + 1 < state_.choices.size(), goes_on && state_.rung > 0);
  if (verdict == Watcher::Verdict::kStay) return;
  state_.rung += verdict == Watcher::Verdict::kClimb ? 1 : std::size_t(-1);
  changed_after_ = report.step;
  const std::vector<std::byte> state = solver->SaveState();
  ranks.RunTogether([&] {
    if (ranks.size() > 1) RemoveGhosts(*solver, adapter);
  });
  *solver = registry_.Create({choice().name, choice().options, host.table(), session.solver_communicator()});
  solver->LoadState(state);
}

}  // namespace nscdd
