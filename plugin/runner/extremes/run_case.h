// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "extremes/extreme_case.h"
#include "extremes/solver_column.h"
#include "nscdd/host/solver_registry.h"

namespace nscdd {

enum class Verdict {
  kHolds,    ///< the error is within the bound that the tolerance promises
  kLimit,    ///< it is not, and a status or a sentence says so
  kRefused,  ///< the plugin refused the case with a sentence
  kSilent,   ///< SILENT MISS: converged without a word, and wrong
  kBroken,   ///< not a number, momentum or energy out of nothing
  kNone,     ///< not a case for this solver
};

/// What a solver made of a case; worst of all steps.
struct Outcome {
  Verdict verdict = Verdict::kNone;
  std::string status;    ///< of the step that ended worst
  std::string sentence;  ///< why it stopped, and what the host should know
  double error = 0.0;    ///< [-] largest of |dV_x|, |dV_y|, R |dspin| of free bodies at the end, over the scale
  double bound = 0.0;    ///< [-] what tolerance, number of contacts and rounding of the coordinates allow
  double momentum =
      0.0;  ///< [-] of a step: | sum m (V - V_f) - impulses of the walls | over the sum of all momenta and impulses
  double energy =
      0.0;  ///< [-] kinetic energy above that of the free velocities, over the scale's (no restitution law makes it)
  double nat = 0.0;
  double nat_max = 0.0;
  std::int64_t iterations = 0;
  std::int64_t contacts = 0;
};

struct RunLimits {
  int max_iterations = 20000;  ///< of all solvers but newton, which has its own
};

/// One case with every column: a row of the map.
std::vector<Outcome> RunCase(const ExtremeCase& extreme_case, const std::vector<SolverColumn>& columns,
                             const SolverRegistry& registry, const RunLimits& limits);

}  // namespace nscdd
