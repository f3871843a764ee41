// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "nscdd/time_stepper.h"
#include "partition/grid.h"
#include "partition/population.h"
#include "stepping/step_tables.h"

namespace nscdd {

/// What a step made of this rank's bodies and contacts, in the columns that the platform and the results are given.
struct StepOutcome {
  BodyResults bodies;
  ContactResults contacts;

  /// Position of the first body whose pose or velocity is not finite; bodies.size() if all are.
  std::size_t FirstNotFinite() const;
};

/// The end of the step of the bodies of `rank` and of its contacts: they move by `rest` [s] from where they were detected, at W
/// in two stages (rest = dt), at V in one (theta dt).
StepOutcome MoveBodies(const Population& population, const StepTables& tables, const Grid& grid, double rest, int rank);

}  // namespace nscdd
