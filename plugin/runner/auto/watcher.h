// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "nscdd/report.h"
#include "scene/scene.h"

namespace nscdd {

/// What a Watcher remembers.
struct WatcherState {
  double depth = 0.0;  ///< [m] interpenetration at the end of the step before
  std::int64_t steps = 0, escalations = 0, descents = 0;
  std::int64_t missed = 0;       ///< steps deeper than wished by the solver's doing
  std::int64_t by_geometry = 0;  ///< by the time step's: gaps are not linear in it
  std::int64_t not_converged = 0;
  std::int64_t over_budget = 0;
  std::int64_t since_change = 0;
  double quick = 0.0;  ///< [s] largest step since the last change of rung
};

/// Judges the steps of a run with solver "auto". Decides from the reports alone, which are the same on all ranks; only a budget
/// looks at a clock.
class Watcher {
 public:
  enum class Verdict { kStay, kClimb, kDescend };

  explicit Watcher(const AutoSettings& wish, const WatcherState& state = {}) : wish_(wish), state_(state) {}

  /// Whether Judge() needs the deepening: the interpenetration is above the wish and has grown in the step.
  bool IsTooDeep(const StepReport& report) const;
  /// After each step. `solver_growth` [m]: of the step, read if IsTooDeep(). `seconds`: of the step, the slowest rank. `above`,
  /// `below`: whether there is a rung.
  Verdict Judge(const StepReport& report, double solver_growth, double seconds, bool above, bool below);
  /// [m] interpenetration before the first step; deeper overlaps of the start are nobody's fault.
  void SetStart(double depth) { state_.depth = depth; }

  const WatcherState& state() const { return state_; }

  /// One line for the end of the run: escalations, steps that missed the target, and why.
  std::string Summary(const std::string& origin, const std::string& last_rung) const;

 private:
  double Target(const StepReport& report) const;
  Verdict JudgeBudget(double seconds, bool above, bool below);

  AutoSettings wish_;
  WatcherState state_;
};

}  // namespace nscdd
