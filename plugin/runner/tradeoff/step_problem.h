// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/contact_problem.h"
#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"

namespace nscdd {

/// The contact problem of one step as the TimeStepper makes it, read from outside: for answers that are not its own.
struct StepProblem {
  BodyTable bodies;              ///< at the beginning of the step, ascending ids
  std::vector<Pose> detection;   ///< q_m = q_i + (1 - theta) dt V_i, by row of bodies
  ContactProblem problem;        ///< same rows; subdomains are left to the solver
  std::vector<ContactKey> keys;  ///< of its contacts, ascending
  SteppingOptions stepping;
  double dt = 0.0;  ///< [s]
};

/// From what the adapter's host holds now. Throws Error unless stepping.alert_distance >= 0 and the law keeps open contacts.
StepProblem ReadStepProblem(PlatformAdapter* adapter, const SteppingOptions& stepping, double dt);

/// All bodies of the adapter's host in ascending order of id.
BodyTable ReadSortedBodies(PlatformAdapter* adapter);

/// Poses after `dt` [s] at constant velocity, centres kept in the period of `platform`.
std::vector<Pose> Drifted(const std::vector<Pose>& pose, const std::vector<Twist>& velocity, double dt,
                          const AdapterDescription& platform);

/// A tenth of the mean radius of the free bodies [m], the stepper's default alert distance; 0 without free bodies.
double DefaultAlertDistance(const BodyTable& bodies);

}  // namespace nscdd
