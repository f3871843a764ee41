// SPDX-License-Identifier: Apache-2.0
#include "auto/watcher.h"

#include <fmt/format.h>

#include <algorithm>

namespace nscdd {
namespace {

constexpr double kSolverShare = 0.1;    // of the target: a smaller growth by the solver is not its fault
constexpr double kNegligible = 0.01;    // of the target: a smaller growth in a step is none
constexpr std::int64_t kPatience = 10;  // steps that must be quick before a dearer rung is tried

}  // namespace

double Watcher::Target(const StepReport& report) const {
  return wish_.interpenetration.value_or(0.0) * (wish_.of_mean_radius ? report.mean_radius : 1.0);
}

bool Watcher::IsTooDeep(const StepReport& report) const {
  if (!wish_.interpenetration) return false;
  return !(report.max_interpenetration <= std::max(Target(report), state_.depth + kNegligible * Target(report)));
}

Watcher::Verdict Watcher::Judge(const StepReport& report, double solver_growth, double seconds, bool above, bool below) {
  ++state_.steps;
  const bool failed = !IsAsAsked(report.solve.status);
  const bool deep = IsTooDeep(report);
  const bool by_solver = deep && !(solver_growth <= kSolverShare * Target(report));
  state_.not_converged += failed;
  state_.missed += by_solver;
  state_.by_geometry += deep && !by_solver;
  state_.depth = report.max_interpenetration;
  if (wish_.budget) state_.over_budget += seconds > *wish_.budget;
  Verdict verdict = Verdict::kStay;
  if (failed || by_solver) {
    if (above) verdict = Verdict::kClimb;
  } else if (wish_.budget && !wish_.interpenetration) {
    verdict = JudgeBudget(seconds, above, below);
  }
  ++state_.since_change;
  if (verdict == Verdict::kStay) return verdict;
  state_.since_change = 0;
  state_.quick = 0.0;
  ++(verdict == Verdict::kClimb ? state_.escalations : state_.descents);
  return verdict;
}

/// Without a wish for accuracy: as accurate as the budget allows.
Watcher::Verdict Watcher::JudgeBudget(double seconds, bool above, bool below) {
  if (seconds > *wish_.budget) return below ? Verdict::kDescend : Verdict::kStay;
  state_.quick = std::max(state_.quick, seconds);
  const bool room = state_.since_change + 1 >= kPatience && state_.quick < 0.5 * *wish_.budget && state_.descents == 0;
  return room && above ? Verdict::kClimb : Verdict::kStay;
}

std::string Watcher::Summary(const std::string& origin, const std::string& last_rung) const {
  std::string text =
      fmt::format("AUTO: {} escalation{}{}, last rung '{}', from {}", state_.escalations, state_.escalations == 1 ? "" : "s",
                  state_.descents > 0 ? fmt::format(" and {} descents", state_.descents) : "", last_rung, origin);
  if (wish_.interpenetration) {
    text += state_.missed + state_.by_geometry == 0
                ? fmt::format("; no step of {} went deeper than wished", state_.steps)
                : fmt::format("; {} of {} steps went deeper than wished", state_.missed + state_.by_geometry, state_.steps);
    if (state_.by_geometry > 0)
      text += fmt::format(", in {} of them for the time step's sake: take a smaller dt", state_.by_geometry);
  }
  if (state_.not_converged > 0) text += fmt::format("; {} steps did not converge", state_.not_converged);
  if (wish_.budget) text += fmt::format("; {} of {} steps took longer than the budget", state_.over_budget, state_.steps);
  return text;
}

}  // namespace nscdd
