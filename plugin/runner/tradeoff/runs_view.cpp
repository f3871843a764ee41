// SPDX-License-Identifier: Apache-2.0
#include "nscdd/error.h"
#include "scene/gravity.h"
#include "tradeoff/process_clock.h"
#include "tradeoff/views.h"

namespace nscdd {

std::unique_ptr<Contestant> RunsView::Make(const Setting& setting) const {
  if (setting.is_box2d()) return MakeBox2dContestant(*plan_.scene, setting);
  return MakePluginContestant(*plan_.scene, plan_.adapter, *plan_.registry, plan_.Complete(setting));
}

/// Returns the seconds of the step, all its substeps together.
double RunsView::MeasureStep(std::int64_t step, Contestant* contestant, const Setting& setting, RowBuilder* row) const {
  const double dt = plan_.scene->time.dt / setting.substeps;
  double seconds = 0.0;
  for (int k = 0; k < setting.substeps; ++k) {
    const StepProblem problem = ReadStepProblem(&contestant->adapter(), plan_.stepping, dt);
    const double start = ProcessSeconds();
    contestant->Step(dt);
    seconds += ProcessSeconds() - start;
    const StepEnd end = ReadStepEnd(contestant, problem);
    row->AddSolve({MeasureAnswer(problem.problem, end.answer),
                   {-1.0, -1.0},
                   MeasureGrowth(&contestant->adapter(), problem, end.answer.velocity, end.pose),
                   contestant->LastEffort()});
    if (k + 1 < setting.substeps) continue;
    const AdapterDescription platform = contestant->adapter().Describe();
    row->AddStep(MeasureInterpenetration(&contestant->adapter(), problem.bodies.id, end.pose, plan_.stepping.alert_distance),
                 Evaluate(plan_.observable, problem, end.answer, end.pose, platform.period),
                 reference_.observable.at(static_cast<std::size_t>(step) - 1));
  }
  return seconds;
}

TradeoffRow RunsView::Measure(const Setting& setting, Timings* timings, const StopQuestion& stop) {
  RowBuilder row(name(), setting, plan_.mean_radius);
  bool cut = false;
  std::string failure;
  timings->Begin();
  try {
    const auto contestant = Make(setting);
    contestant->KeepImpulses(true);
    const auto steps = static_cast<std::int64_t>(reference_.observable.size());
    for (std::int64_t step = 1; step <= steps; ++step) {
      if (step > 1 && (cut = stop())) break;
      contestant->SetGravity(GravityAt(plan_.scene->gravity, step, plan_.scene->time.dt));
      timings->Add(MeasureStep(step, contestant.get(), setting, &row));
    }
  } catch (const Error& e) {
    failure = e.what();
  }
  return row.Build(cut, failure);
}

void RunsView::Time(const Setting& setting, Timings* timings, const StopQuestion& stop) {
  const auto contestant = Make(setting);
  const double dt = plan_.scene->time.dt / setting.substeps;
  const auto steps = static_cast<std::int64_t>(reference_.observable.size());
  timings->Begin();
  for (std::int64_t step = 1; step <= steps; ++step) {
    if (stop()) return timings->DropLast();
    contestant->SetGravity(GravityAt(plan_.scene->gravity, step, plan_.scene->time.dt));
    const double start = ProcessSeconds();
    for (int k = 0; k < setting.substeps; ++k) contestant->Step(dt);
    timings->Add(ProcessSeconds() - start);
  }
}

}  // namespace nscdd
