// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tradeoff/answer_residuals.h"
#include "tradeoff/step_problem.h"

namespace nscdd {

/// A number of the whole sample that a user may care about; evaluated at the end of a step.
enum class Observable {
  kCentreOfMassX,  ///< [m] of the free bodies
  kCentreOfMassY,  ///< [m]
  kKineticEnergy,  ///< [J] of the free bodies
  kWallForce,      ///< [N] length of the sum of all contact forces on prescribed bodies
  kWallForceX,     ///< [N] its components
  kWallForceY,     ///< [N]
  kFlowRate,       ///< [kg/s] momentum along x over the length of the sample: the period, else the width of the centres
};

/// Names as on the command line. Throws Error with those that exist.
Observable ParseObservable(const std::string& name);
std::string NameOf(Observable observable);
std::string UnitOf(Observable observable);
std::vector<std::string> ObservableNames();

/// `end`: poses at the end of the step, by row of bodies; `period` [m], 0 without.
double Evaluate(Observable observable, const StepProblem& step, const Answer& answer, const std::vector<Pose>& end,
                double period);

}  // namespace nscdd
