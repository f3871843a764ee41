// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tradeoff/course.h"

namespace nscdd {

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
