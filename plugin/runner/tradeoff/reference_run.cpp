// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/reference_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "nscdd/error.h"
#include "scene/gravity.h"

namespace nscdd {
namespace {

// What a step of the reference may take: about half a second of sweeps, some seconds of factorisations.
constexpr double kContactUpdates = 4e7, kFactorisedContacts = 1.5e6;

std::string Clamped(double most, std::int64_t least, std::int64_t largest) {
  return fmt::format("{}", std::clamp(static_cast<std::int64_t>(most), least, largest));
}

std::vector<Vec2> RowsOf(const std::map<ContactKey, Vec2>& by_key, const StepProblem& problem) {
  std::vector<Vec2> rows(problem.keys.size());
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const auto at = by_key.find(problem.keys[c]);
    if (at != by_key.end()) rows[c] = at->second;
  }
  return rows;
}

/// Our reading of the step's problem, put to an answer whose residual the solver has measured itself.
void CheckAgainstReport(double measured, double reported, std::int64_t step) {
  if (std::abs(measured - reported) <= 1e-3 * reported + 1e-10) return;
  throw Error(fmt::format(
      "step {} of the reference: nat is {:.6e} as measured and {:.6e} as reported; the problem read from the platform is not "
      "the one that was solved (is another alert_distance or normal_law in force?)",
      step, measured, reported));
}

bool IsRecorded(const Plan& plan, std::int64_t step) {
  const std::int64_t stride = std::max<std::int64_t>(1, plan.steps / std::max<std::int64_t>(1, plan.problems));
  return (step - 1) % stride == stride / 2 && (step - 1) / stride < plan.problems;
}

}  // namespace

StepEnd ReadStepEnd(Contestant* contestant, const StepProblem& problem) {
  BodyTable end = ReadSortedBodies(&contestant->adapter());
  return {{std::move(end.velocity), RowsOf(contestant->impulses(), problem)}, std::move(end.pose)};
}

Setting ReferenceSetting(const SolverRegistry& registry, std::int64_t contacts) {
  const auto count = static_cast<double>(std::max<std::int64_t>(1, contacts));
  const std::string iterations = Clamped(kContactUpdates / count, 500, 20000);
  const std::vector<Setting> candidates = {
      {"newton",
       "newton",
       {{"tolerance", "1e-10"},
        {"interior_residual", "1e-5"},
        {"max_iterations", Clamped(kFactorisedContacts / count, 80, 600)}}},
      {"nscd anderson",
       "nscd",
       {{"acceleration", "anderson"}, {"tolerance", "1e-10"}, {"max_iterations", iterations}, {"test_every", "20"}}},
      {"nscd", "nscd", {{"tolerance", "1e-10"}, {"max_iterations", iterations}, {"test_every", "20"}}}};
  std::vector<std::string> notices;
  const std::vector<Setting> known = KnownSettings(candidates, registry, &notices);
  if (known.empty()) throw Error("the plugin has neither 'newton' nor 'nscd' to make a reference with; load one that has");
  return known.front();
}

ReferenceRun RecordReference(const Plan& plan, const Setting& setting, const StopQuestion& stop,
                             const std::function<void(std::int64_t, double)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  ReferenceRun run;
  run.setting = setting;
  const auto contestant = MakePluginContestant(*plan.scene, plan.adapter, *plan.registry, plan.Complete(setting));
  const double period = contestant->adapter().Describe().period;
  std::map<ContactKey, Vec2> warm;
  for (std::int64_t step = 1; step <= plan.steps && (step == 1 || !stop()); ++step) {
    const double dt = plan.scene->time.dt;
    contestant->SetGravity(GravityAt(plan.scene->gravity, step, dt));
    StepProblem problem = ReadStepProblem(&contestant->adapter(), plan.stepping, dt);
    contestant->Step(dt);
    const Effort effort = contestant->LastEffort();
    StepEnd end = ReadStepEnd(contestant.get(), problem);
    const AnswerResiduals residuals = MeasureAnswer(problem.problem, end.answer);
    CheckAgainstReport(residuals.nat, effort.reported_nat, step);
    run.nat.push_back(residuals.nat);
    run.nat_max.push_back(residuals.nat_max);
    run.not_converged += effort.status >= StepStatus::kIterationLimit;
    run.observable.push_back(Evaluate(plan.observable, problem, end.answer, end.pose, period));
    std::map<ContactKey, Vec2> impulses = contestant->impulses();
    if (IsRecorded(plan, step)) {
      std::vector<Vec2> first = RowsOf(warm, problem);
      run.steps.push_back({step, std::move(problem), std::move(first), std::move(end.answer), run.observable.back()});
    }
    warm = std::move(impulses);
    progress(step, residuals.nat);
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace nscdd
