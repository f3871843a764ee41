// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "nscdd/error.h"
#include "nscdd/host/solver.h"
#include "stopwatch.h"
#include "tradeoff/views.h"

namespace nscdd {
namespace {

/// What a solver made of a recorded step.
struct Outcome {
  StepEnd end;
  Effort effort;
  double seconds = 0.0;
};

/// Solves recorded steps one after the other.
class ProblemSolver {
 public:
  ProblemSolver(const Plan& plan, const Setting& setting, AdapterDescription platform)
      : cold_(plan.cold),
        platform_(std::move(platform)),
        solver_(plan.registry->Create({setting.solver, plan.Complete(setting).options, nullptr, {}})) {}

  Outcome Solve(const ReferenceStep& step) {
    const double start = ProcessSeconds();
    ContactSolution solution = solver_.Solve(step.problem.problem, cold_ ? std::vector<Vec2>{} : step.warm);
    const double around = ProcessSeconds() - start;  // copies included, waiting for the processor not
    Outcome outcome;
    const double inside = solver_.Report().seconds_solve;  // the other way round
    outcome.seconds = inside > 0.0 ? std::min(inside, around) : around;
    outcome.effort = EffortOf(solution.report);
    outcome.end.pose =
        Drifted(step.problem.detection, solution.velocity, step.problem.stepping.theta * step.problem.dt, platform_);
    outcome.end.answer = {std::move(solution.velocity), std::move(solution.impulse)};
    return outcome;
  }

 private:
  bool cold_;
  AdapterDescription platform_;
  Solver solver_;
};

}  // namespace

ProblemsView::ProblemsView(const Plan& plan, const ReferenceRun& reference)
    : plan_(plan), reference_(reference), geometry_(MakePlatform(plan.adapter, *plan.scene)) {
  ForEachBody(*plan.scene, 0, 1, [&](const BodyDefinition& body) { geometry_->Add(body); });
  ReadSortedBodies(&geometry_->adapter());
}

TradeoffRow ProblemsView::Measure(const Setting& setting, Timings* timings, const StopQuestion& stop) {
  RowBuilder row(name(), setting, plan_.mean_radius);
  bool cut = false;
  std::string failure;
  timings->Begin();
  try {
    const AdapterDescription platform = geometry_->adapter().Describe();
    ProblemSolver solver(plan_, setting, platform);
    for (const ReferenceStep& step : reference_.steps) {
      if (&step != &reference_.steps.front() && (cut = stop())) break;
      const Outcome outcome = solver.Solve(step);
      timings->Add(outcome.seconds);
      const std::vector<Twist>& velocity = outcome.end.answer.velocity;
      row.AddSolve({MeasureAnswer(step.problem.problem, outcome.end.answer),
                    CompareVelocities(step.problem.problem, velocity, step.answer.velocity),
                    MeasureGrowth(&geometry_->adapter(), step.problem, velocity, outcome.end.pose), outcome.effort});
      row.AddStep(MeasureInterpenetration(&geometry_->adapter(), step.problem.bodies.id, outcome.end.pose,
                                          plan_.stepping.alert_distance),
                  Evaluate(plan_.observable, step.problem, outcome.end.answer, outcome.end.pose, platform.period),
                  step.observable);
    }
  } catch (const Error& e) {
    failure = e.what();
  }
  return row.Build(cut, failure);
}

void ProblemsView::Time(const Setting& setting, Timings* timings, const StopQuestion& stop) {
  ProblemSolver solver(plan_, setting, geometry_->adapter().Describe());
  timings->Begin();
  for (const ReferenceStep& step : reference_.steps) {
    if (stop()) return timings->DropLast();
    timings->Add(solver.Solve(step).seconds);
  }
}

}  // namespace nscdd
