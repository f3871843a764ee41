// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/course.h"

#include <fmt/format.h>

#include <algorithm>

#include "nscdd/error.h"
#include "scene/gravity.h"
#include "stopwatch.h"

namespace nscdd {
namespace {

constexpr std::int64_t kMostStretches = 5;
constexpr std::int64_t kRunIn = 10;  // steps: Box2D's position iterations halve an overlap in each

std::vector<Stretch> Spread(std::int64_t steps, std::int64_t scene) {
  if (steps >= scene) return {{1, steps, {}}};
  const std::int64_t n = std::clamp<std::int64_t>(steps / 2, 1, kMostStretches);
  std::vector<Stretch> stretches;
  for (std::int64_t k = 0; k < n; ++k) {
    stretches.push_back({k * scene / n + 1, (k + 1) * steps / n - k * steps / n, {}});
  }
  return stretches;
}

/// Accurate without waiting for the last digits; on the grid "2x2", say.
Setting ScoutSetting(const SolverRegistry& registry, const std::string& grid) {
  const std::vector<std::pair<std::string, std::string>> sharp = {{"tolerance", "1e-5"}, {"max_iterations", "2000"}};
  Setting one{"scout", "nscd", sharp}, many{"scout", "nscdd", sharp}, newton{"scout", "newton", {{"tolerance", "1e-5"}}};
  many.options.emplace_back("subdomains", grid);
  std::vector<std::string> notices;
  const bool is_one = grid == "1x1";
  const auto known = KnownSettings({is_one ? one : many, is_one ? newton : many}, registry, &notices);
  if (known.empty()) throw Error(fmt::format("the plugin has no solver to go through the scene with: {}", notices.front()));
  return known.front();
}

std::string RangeOf(const Stretch& s) {
  return s.count == 1 ? fmt::format("{}", s.first) : fmt::format("{}-{}", s.first, s.first + s.count - 1);
}

}  // namespace

Course::Course(const Plan& plan, double seconds, const StopQuestion& interrupted,
               const std::function<void(std::int64_t)>& progress)
    : plan_(plan), stretches_(Spread(plan.steps, plan.scene->time.steps)) {
  if (stretches_.back().first > 1) Scout(seconds, interrupted, progress);
}

std::int64_t Course::steps() const {
  std::int64_t sum = 0;
  for (const Stretch& s : stretches_) sum += s.count;
  return sum;
}

std::string Course::Summary() const {
  std::string ranges;
  for (const Stretch& s : stretches_) ranges += fmt::format("{}{}", ranges.empty() ? "" : ", ", RangeOf(s));
  const std::string in = stretches_.size() == 1 ? "" : fmt::format("in {} stretches: ", stretches_.size());
  return fmt::format("{} of the scene's {} steps ({}{})", steps(), plan_.scene->time.steps, in, ranges);
}

void Course::Scout(double seconds, const StopQuestion& interrupted, const std::function<void(std::int64_t)>& progress) {
  const Stopwatch watch;
  const auto contestant =
      MakePluginContestant(*plan_.scene, plan_.adapter, *plan_.registry, plan_.Complete(ScoutSetting(*plan_.registry, "1x1")));
  const auto is_early = [](const Stretch& s) { return s.first <= kRunIn + 1; };  // is reached from the scene's start
  auto next = std::find_if_not(stretches_.begin(), stretches_.end(), is_early);
  for (std::int64_t step = 1; next != stretches_.end(); ++step) {
    contestant->SetGravity(GravityAt(plan_.scene->gravity, step, plan_.scene->time.dt, plan_.scene->clock()));
    contestant->Step(plan_.scene->time.dt);
    progress(step);
    const bool is_late = interrupted() || watch.seconds() > seconds;
    if (is_late) next->first = std::min(next->first, step + kRunIn + 1);  // the last one is here
    if (step + kRunIn + 1 < next->first) continue;
    next->before = contestant->Capture(step);
    ++next;
    if (is_late) break;
  }
  stretches_.erase(next, stretches_.end());
}

void Course::Approach(const Stretch& stretch, int substeps, Contestant* contestant) const {
  const double dt = plan_.scene->time.dt;
  if (stretch.before.step > 0) contestant->Put(stretch.before);
  for (std::int64_t step = stretch.before.step + 1; step < stretch.first; ++step) {
    contestant->SetGravity(GravityAt(plan_.scene->gravity, step, dt, plan_.scene->clock()));
    for (int k = 0; k < substeps; ++k) contestant->Step(dt / substeps);
  }
}

const Snapshot& Course::Start(std::size_t index, const std::string& grid) {
  const auto [at, is_new] = starts_.try_emplace({index, grid});
  const Stretch& stretch = stretches_[index];
  if (!is_new || stretch.first == 1) return at->second;
  Snapshot from = stretch.before;
  if (grid != "1x1") from.state.clear();  // is one of another partition
  const auto contestant =
      MakePluginContestant(*plan_.scene, plan_.adapter, *plan_.registry, plan_.Complete(ScoutSetting(*plan_.registry, grid)));
  Stretch approach = stretch;
  approach.before = std::move(from);
  Approach(approach, 1, contestant.get());
  return at->second = contestant->Capture(stretch.first - 1);
}

std::unique_ptr<Contestant> Course::Enter(std::size_t index, const Setting& setting) {
  const Stretch& stretch = stretches_[index];
  if (setting.is_box2d()) {
    auto contestant = MakeBox2dContestant(*plan_.scene, setting);
    Approach(stretch, setting.substeps, contestant.get());
    return contestant;
  }
  auto contestant = MakePluginContestant(*plan_.scene, plan_.adapter, *plan_.registry, plan_.Complete(setting));
  if (stretch.first > 1) contestant->Put(Start(index, GridOf(setting, *plan_.registry)));
  return contestant;
}

}  // namespace nscdd
