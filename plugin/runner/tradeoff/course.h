// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tradeoff/contestant.h"
#include "tradeoff/plan.h"

namespace nscdd {

/// Consecutive steps of the scene that are measured.
struct Stretch {
  std::int64_t first = 1;
  std::int64_t count = 0;
  Snapshot before;  ///< some steps earlier; step 0: the scene's own start
};

/// The steps that are measured, spread over the whole scene: all of them, or some stretches of equal length. Where the bodies
/// are before a stretch comes from a scouting run of the plugin, so that every setting, the reference too, begins it alike.
class Course {
 public:
  /// Makes the scouting run, if there must be one: `nscd` at nat 1e-5 (else whatever the reference is made with), for at most
  /// `seconds`. What it does not reach is left out.
  Course(const Plan& plan, double seconds, const StopQuestion& interrupted, const std::function<void(std::int64_t)>& progress);

  const std::vector<Stretch>& stretches() const { return stretches_; }
  std::int64_t steps() const;  ///< measured
  std::int64_t last() const { return stretches_.back().first + stretches_.back().count - 1; }
  /// Leaves the stretch `index` its first `count` steps.
  void Cut(std::size_t index, std::int64_t count) { stretches_[index].count = count; }
  /// "100 of 300 steps, in 5 stretches: 1-20, 61-80, ..."
  std::string Summary() const;

  /// A contestant for the stretch `index`. The plugin's begin at its first step with the impulses of the step before, made by
  /// an accurate solver on the setting's grid; Box2D goes some steps by itself to have its own, and to leave the skin of its
  /// walls.
  std::unique_ptr<Contestant> Enter(std::size_t index, const Setting& setting);
  /// What the plugin's contestants on one subdomain begin the stretch with.
  const Snapshot& StartOf(std::size_t index) { return Start(index, "1x1"); }

 private:
  const Snapshot& Start(std::size_t index, const std::string& grid);
  /// From the snapshot to just before the stretch.
  void Approach(const Stretch& stretch, int substeps, Contestant* contestant) const;
  void Scout(double seconds, const StopQuestion& interrupted, const std::function<void(std::int64_t)>& progress);

  const Plan& plan_;
  std::vector<Stretch> stretches_;
  std::map<std::pair<std::size_t, std::string>, Snapshot> starts_;
};

/// A step of the reference trajectory whose problem the settings solve too.
struct ReferenceStep {
  std::int64_t step = 0;
  StepProblem problem;
  std::vector<Vec2> warm;  ///< impulses of the reference's step before, by row of the contacts
  Answer answer;           ///< the reference's
  double observable = 0.0;
};

/// The steps of the course, solved as exactly as the plugin can, and what they are compared with.
struct ReferenceRun {
  Setting setting;                   ///< that was used
  std::vector<ReferenceStep> steps;  ///< recorded ones
  std::vector<double> observable;    ///< at the end of every step of the course
  std::vector<double> nat;           ///< of every step, as measured here
  std::vector<double> nat_max;
  std::int64_t not_converged = 0;
  double seconds = 0.0;  ///< that it took
};

/// `newton` where the plugin has it, else `nscd`, accelerated if it can be; `contacts` bounds the iterations.
Setting ReferenceSetting(const SolverRegistry& registry, std::int64_t contacts);

/// Runs `setting` along the course. Where it takes longer than `seconds`, every stretch is cut after its share of them (one
/// step each at least); ends early when interrupted. Throws Error when the residual measured here is not the one that the
/// solver reports: the problem would not be the one that was solved.
ReferenceRun RecordReference(const Plan& plan, const Setting& setting, double seconds, const StopQuestion& interrupted,
                             const std::function<void(std::int64_t, double)>& progress, Course* course);

/// The host's bodies at the end of a step and the impulses by row of the problem's contacts.
struct StepEnd {
  Answer answer;
  std::vector<Pose> pose;
};
StepEnd ReadStepEnd(Contestant* contestant, const StepProblem& problem);

}  // namespace nscdd
