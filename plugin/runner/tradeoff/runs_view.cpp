// SPDX-License-Identifier: Apache-2.0
#include "nscdd/error.h"
#include "scene/gravity.h"
#include "stopwatch.h"
#include "tradeoff/views.h"

namespace nscdd {

bool RunsView::ForEachStep(const Setting& setting, bool keep_impulses, const StopQuestion& stop,
                           const std::function<void(Contestant* contestant)>& make) {
  bool is_first = true;
  for (std::size_t k = 0; k < course_.stretches().size(); ++k) {
    const Stretch& stretch = course_.stretches()[k];
    if (!is_first && stop()) return false;
    const auto contestant = course_.Enter(k, setting);
    contestant->KeepImpulses(keep_impulses);
    for (std::int64_t step = stretch.first; step < stretch.first + stretch.count; ++step) {
      if (!is_first && stop()) return false;
      is_first = false;
      contestant->SetGravity(GravityAt(plan_.scene->gravity, step, plan_.scene->time.dt, plan_.scene->clock()));
      make(contestant.get());
    }
  }
  return true;
}

/// Returns the seconds of the step, all its substeps together.
double RunsView::MeasureStep(double reference, Contestant* contestant, const Setting& setting, RowBuilder* row) const {
  const double dt = plan_.scene->time.dt / setting.substeps;
  double seconds = 0.0;
  for (int k = 0; k < setting.substeps; ++k) {
    const StepProblem problem = contestant->Read(plan_.stepping, dt);
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
                 Evaluate(plan_.observable, problem, end.answer, end.pose, platform.period), reference);
  }
  return seconds;
}

TradeoffRow RunsView::Measure(const Setting& setting, Timings* timings, const StopQuestion& stop) {
  RowBuilder row(name(), setting, plan_.mean_radius);
  bool cut = false;
  std::string failure;
  timings->Begin();
  auto reference = reference_.observable.begin();
  try {
    cut = !ForEachStep(setting, true, stop,
                       [&](Contestant* contestant) { timings->Add(MeasureStep(*reference++, contestant, setting, &row)); });
  } catch (const Error& e) {
    failure = e.what();
  }
  return row.Build(cut, failure);
}

void RunsView::Time(const Setting& setting, Timings* timings, const StopQuestion& stop) {
  const double dt = plan_.scene->time.dt / setting.substeps;
  timings->Begin();
  const bool is_whole = ForEachStep(setting, false, stop, [&](Contestant* contestant) {
    const double start = ProcessSeconds();
    for (int k = 0; k < setting.substeps; ++k) contestant->Step(dt);
    timings->Add(ProcessSeconds() - start);
  });
  if (!is_whole) timings->DropLast();
}

}  // namespace nscdd
