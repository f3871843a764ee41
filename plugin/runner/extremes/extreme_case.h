// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "nscdd/reference/world.h"
#include "nscdd/vector.h"

namespace nscdd {

/// A small scene at the edge of what the method should bear, and what must come out of it.
struct ExtremeCase {
  std::string family;
  std::string name;
  std::function<void(reference::World*)> build;
  /// Velocity of a free body after the last step, in closed form; null: a tight solution is taken for the truth.
  std::function<Twist(std::int64_t id)> truth = [](std::int64_t) { return Twist{}; };
  double scale = 0.0981;  ///< [m/s] natural speed of the scene: g dt, or the speed of approach
  double dt = 0.01;       ///< [s]
  int steps = 1;
  std::string subdomains = "2x2";
  std::string criterion = "nat_max";
  double tolerance = 1e-6;
  std::vector<std::pair<std::string, std::string>> options = {};  ///< given to the solvers that have them
  std::string only_with = {};                                     ///< an option that a solver must have for this case
  double extent = 10.0;                                           ///< [m] largest coordinate, whose rounding the gaps inherit
  double amplification = 1.0;    ///< velocity of a body over the residual that a contact leaves
  double lambda = 0.0;           ///< F = y - M_lambda V keeps momentum to lambda times the rounding
  bool feeds_energy = false;     ///< feedback of interpenetration does work
  bool by_weight = false;        ///< the error is that of the impulse on all prescribed bodies, at most 1 %
  bool has_no_solution = false;  ///< converged is wrong, whatever the velocities; the right answer names the bodies
  bool quick = false;            ///< in the short version too
};

std::vector<ExtremeCase> StackCases();      ///< masses, radii, columns
std::vector<ExtremeCase> LawCases();        ///< friction, restitution
std::vector<ExtremeCase> ScaleCases();      ///< time steps, units, coordinates, tolerances
std::vector<ExtremeCase> JammedCases();     ///< arch, wedge, pressed piles, moving piles
std::vector<ExtremeCase> GeometryCases();   ///< overlaps, tunnelling, few bodies or none
std::vector<ExtremeCase> PartitionCases();  ///< lambda, subdomains, shared bodies

}  // namespace nscdd
