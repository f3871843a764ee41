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
  return !(report.max_interpenetration <= std::max(Target(report), depth_ + kNegligible * Target(report)));
}

Watcher::Verdict Watcher::Judge(const StepReport& report, bool fixed, double solver_growth, double seconds, bool above,
                                bool below) {
  ++steps_;
  const SolveStatus status = report.solve.status;
  const bool limit = status == SolveStatus::kIterationLimit && !fixed;
  const bool failed = limit || status == SolveStatus::kStalled || status == SolveStatus::kDiverged;
  const bool deep = IsTooDeep(report);
  const bool by_solver = deep && !(solver_growth <= kSolverShare * Target(report));
  not_converged_ += failed;
  missed_ += by_solver;
  by_geometry_ += deep && !by_solver;
  depth_ = report.max_interpenetration;
  if (wish_.budget) over_budget_ += seconds > *wish_.budget;
  Verdict verdict = Verdict::kStay;
  if (failed || by_solver) {
    if (above) verdict = Verdict::kClimb;
  } else if (wish_.budget && !wish_.interpenetration) {
    verdict = JudgeBudget(seconds, above, below);
  }
  ++since_change_;
  if (verdict == Verdict::kStay) return verdict;
  since_change_ = 0;
  quick_ = 0.0;
  ++(verdict == Verdict::kClimb ? escalations_ : descents_);
  return verdict;
}

/// Without a wish for accuracy: as accurate as the budget allows.
Watcher::Verdict Watcher::JudgeBudget(double seconds, bool above, bool below) {
  if (seconds > *wish_.budget) return below ? Verdict::kDescend : Verdict::kStay;
  quick_ = std::max(quick_, seconds);
  const bool room = since_change_ + 1 >= kPatience && quick_ < 0.5 * *wish_.budget && descents_ == 0;
  return room && above ? Verdict::kClimb : Verdict::kStay;
}

std::string Watcher::Summary(const std::string& origin, const std::string& last_rung) const {
  std::string text = fmt::format("AUTO: {} escalation{}{}, last rung '{}', from {}", escalations_, escalations_ == 1 ? "" : "s",
                                 descents_ > 0 ? fmt::format(" and {} descents", descents_) : "", last_rung, origin);
  if (wish_.interpenetration) {
    text += missed_ + by_geometry_ == 0
                ? fmt::format("; no step of {} went deeper than wished", steps_)
                : fmt::format("; {} of {} steps went deeper than wished", missed_ + by_geometry_, steps_);
    if (by_geometry_ > 0) text += fmt::format(", in {} of them for the time step's sake: take a smaller dt", by_geometry_);
  }
  if (not_converged_ > 0) text += fmt::format("; {} steps did not converge", not_converged_);
  if (wish_.budget) text += fmt::format("; {} of {} steps took longer than the budget", over_budget_, steps_);
  return text;
}

}  // namespace nscdd
