#pragma once

#include <cstdint>
#include <string>

#include "nscdd/report.h"
#include "scene/scene.h"

namespace nscdd {

/// Judges the steps of a run with solver "auto". Decides from the reports alone, which are the same on all ranks; only a budget
/// looks at a clock.
class Watcher {
 public:
  enum class Verdict { kStay, kClimb, kDescend };

  explicit Watcher(const AutoSettings& wish) : wish_(wish) {}

  /// Whether Judge() needs the deepening: the interpenetration is above the wish and has grown in the step.
  bool IsTooDeep(const StepReport& report) const;
  /// After each step. `fixed`: the rung asks for a number of iterations. `solver_growth` [m]: of the step, read if IsTooDeep().
  /// `seconds`: of the step, the slowest rank. `above`, `below`: whether there is a rung.
  Verdict Judge(const StepReport& report, bool fixed, double solver_growth, double seconds, bool above, bool below);
  /// [m] interpenetration before the first step; deeper overlaps of the start are nobody's fault.
  void SetStart(double depth) { depth_ = depth; }

  std::int64_t escalations() const { return escalations_; }
  std::int64_t descents() const { return descents_; }

  /// One line for the end of the run: escalations, steps that missed the target, and why.
  std::string Summary(const std::string& origin, const std::string& last_rung) const;

 private:
  double Target(const StepReport& report) const;
  Verdict JudgeBudget(double seconds, bool above, bool below);

  AutoSettings wish_;
  double depth_ = 0.0;  // [m] at the end of the step before
  std::int64_t steps_ = 0, escalations_ = 0, descents_ = 0;
  std::int64_t missed_ = 0;       // steps deeper than wished by the solver's doing
  std::int64_t by_geometry_ = 0;  // by the time step's: gaps are not linear in it
  std::int64_t not_converged_ = 0;
  std::int64_t over_budget_ = 0;
  std::int64_t since_change_ = 0;
  double quick_ = 0.0;  // [s] largest step since the last change of rung
};

}  // namespace nscdd
