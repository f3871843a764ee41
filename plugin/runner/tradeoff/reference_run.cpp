// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/course.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "nscdd/error.h"
#include "scene/gravity.h"
#include "stopwatch.h"

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

/// The step with this number among those asked for.
bool IsRecorded(const Plan& plan, std::int64_t step) {
  const std::int64_t stride = std::max<std::int64_t>(1, plan.steps / std::max<std::int64_t>(1, plan.problems));
  return (step - 1) % stride == stride / 2 && (step - 1) / stride < plan.problems;
}

/// Makes steps and notes them.
class Recorder {
 public:
  Recorder(const Plan& plan, ReferenceRun* run) : plan_(plan), run_(*run) {}

  /// `number`: of the step among those asked for, from 1. `warm`: impulses of the step before. Returns those of this one.
  std::map<ContactKey, Vec2> Step(std::int64_t step, std::int64_t number, Contestant* contestant,
                                  const std::map<ContactKey, Vec2>& warm) {
    const double dt = plan_.scene->time.dt;
    contestant->SetGravity(GravityAt(plan_.scene->gravity, step, dt, plan_.scene->clock()));
    StepProblem problem = contestant->Read(plan_.stepping, dt);
    contestant->Step(dt);
    const Effort effort = contestant->LastEffort();
    StepEnd end = ReadStepEnd(contestant, problem);
    const AnswerResiduals residuals = MeasureAnswer(problem.problem, end.answer);
    CheckAgainstReport(residuals.nat, effort.reported_nat, step);
    run_.nat.push_back(residuals.nat);
    run_.nat_max.push_back(residuals.nat_max);
    run_.not_converged += !IsAsAsked(effort.status);
    run_.observable.push_back(
        Evaluate(plan_.observable, problem, end.answer, end.pose, contestant->adapter().Describe().period));
    if (IsRecorded(plan_, number)) {
      std::vector<Vec2> first = RowsOf(warm, problem);
      run_.steps.push_back({step, std::move(problem), std::move(first), std::move(end.answer), run_.observable.back()});
    }
    return contestant->impulses();
  }

 private:
  const Plan& plan_;
  ReferenceRun& run_;
};

}  // namespace

StepEnd ReadStepEnd(Contestant* contestant, const StepProblem& problem) {
  BodyTable end = ReadSortedBodies(&contestant->adapter());
  return {{std::move(end.velocity), RowsOf(contestant->impulses(), problem)}, std::move(end.pose)};
}

Setting ReferenceSetting(const SolverRegistry& registry, std::int64_t contacts) {
  const auto count = static_cast<double>(std::max<std::int64_t>(1, contacts));
  const std::string iterations = Clamped(kContactUpdates / count, 500, 20000);
  const std::vector<Setting> candidates = {
      {"newton", "newton", {{"tolerance", "1e-10"}, {"max_iterations", Clamped(kFactorisedContacts / count, 80, 600)}}},
      {"nscd anderson",
       "nscd",
       {{"acceleration", "anderson"}, {"tolerance", "1e-10"}, {"max_iterations", iterations}, {"test_every", "20"}}},
      {"nscd", "nscd", {{"tolerance", "1e-10"}, {"max_iterations", iterations}, {"test_every", "20"}}}};
  std::vector<std::string> notices;
  const std::vector<Setting> known = KnownSettings(candidates, registry, &notices);
  if (known.empty()) throw Error("the plugin has neither 'newton' nor 'nscd' to make a reference with; load one that has");
  return known.front();
}

ReferenceRun RecordReference(const Plan& plan, const Setting& setting, double seconds, const StopQuestion& interrupted,
                             const std::function<void(std::int64_t, double)>& progress, Course* course) {
  const Stopwatch watch;
  ReferenceRun run;
  run.setting = setting;
  Recorder recorder(plan, &run);
  const std::size_t count = course->stretches().size();
  std::int64_t number = 0;  // of the step among those asked for
  for (std::size_t k = 0; k < count; ++k) {
    const Stretch& stretch = course->stretches()[k];
    const std::int64_t end = number + stretch.count;
    const double until = seconds * static_cast<double>(k + 1) / static_cast<double>(count);
    const auto contestant = course->Enter(k, setting);
    std::map<ContactKey, Vec2> warm = course->StartOf(k).impulses;
    std::int64_t done = 0;
    for (; done < stretch.count && (done == 0 || !(interrupted() || watch.seconds() > until)); ++done) {
      warm = recorder.Step(stretch.first + done, ++number, contestant.get(), warm);
      progress(stretch.first + done, run.nat.back());
    }
    course->Cut(k, done);
    number = end;
  }
  run.seconds = watch.seconds();
  return run;
}

}  // namespace nscdd
