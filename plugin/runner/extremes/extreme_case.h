// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "nscdd/reference/world.h"
#include "nscdd/vector.h"

namespace nscdd {

/// A small scene at the edge of what the method should bear, and what must come out of it: an entry of cases.toml.
struct ExtremeCase {
  std::string family;
  std::string name;
  Vec2 gravity;  ///< [m/s^2]
  std::vector<reference::Body> bodies;
  bool tight = false;                    ///< a tight solution is taken for the truth
  Twist truth;                           ///< otherwise: velocity of a free body after the last step, in closed form
  std::map<std::int64_t, Twist> truths;  ///< of the bodies that differ
  double scale = 0.0;                    ///< [m/s] natural speed of the scene: g dt, or the speed of approach
  double dt = 0.0;                       ///< [s]
  std::int64_t steps = 1;
  std::string subdomains;
  std::string criterion;
  double tolerance = 0.0;
  std::vector<std::pair<std::string, std::string>> options;  ///< given to the solvers that have them
  std::string only_with;                                     ///< an option that a solver must have for this case
  double extent = 10.0;                                      ///< [m] largest coordinate, whose rounding the gaps inherit
  double amplification = 1.0;                                ///< velocity of a body over the residual that a contact leaves
  double lambda = 0.0;                                       ///< F = y - M_lambda V keeps momentum to lambda times the rounding
  bool feeds_energy = false;                                 ///< feedback of interpenetration does work
  bool by_weight = false;        ///< the error is that of the impulse on all prescribed bodies, at most 1 %
  bool has_no_solution = false;  ///< converged is wrong, whatever the velocities; the right answer names the bodies
  bool quick = false;            ///< in the short version too
};

/// All of cases.toml, which is part of the program.
std::vector<ExtremeCase> ReadExtremeCases();

}  // namespace nscdd
