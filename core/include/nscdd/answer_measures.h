// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nscdd/contact_problem.h"

namespace nscdd {

/// Velocities at the end of a step, by row of bodies, and impulses (r_n, r_t), by row of contacts, of whatever solver.
struct Answer {
  std::vector<Twist> velocity;
  std::vector<Vec2> impulse;
};

/// How well an answer solves a contact problem, whoever made it.
struct AnswerResiduals {
  double nat = 0.0;              ///< [-] definitions of nat and nat_max: natural_residual.h
  double nat_max = 0.0;          ///< [-]
  double momentum_defect = 0.0;  ///< [-] |M (V - V_f) - H r|_{M^-1} / |dt f|_{M^-1} over free bodies
  double energy_defect = 0.0;    ///< [-] sum of r_n (v_n + b_n) + r_t v_t + mu r_n |v_t| over |dt f|^2_{M^-1}: 0 for the exact
                                 ///< law; > 0: contacts gave energy, or took less than friction does; < 0: they took too much
};

/// Residuals over the contacts `measured` (empty: all). Momentum counts all contacts.
AnswerResiduals MeasureAnswer(const ContactProblem& problem, const Answer& answer, const std::vector<bool>& measured = {});

/// |V - other|_M / |dt f|_{M^-1} over free bodies, spins included; and of one body at most, sqrt(|dV|^2 + I/m dw^2) over the
/// largest |dt f| / m. Without loads the scale is 1 m/s (and the root of the total mass).
struct VelocityError {
  double energy_norm = 0.0;  ///< [-]
  double worst_body = 0.0;   ///< [-]
};
VelocityError CompareVelocities(const ContactProblem& problem, const std::vector<Twist>& velocity,
                                const std::vector<Twist>& other);

/// What the free bodies of an answer hold together, at `pose` (by row of bodies).
struct SampleTotals {
  double mass = 0.0;                       ///< [kg]
  double kinetic_energy = 0.0;             ///< [J]
  Vec2 momentum;                           ///< [N s]
  Vec2 centre;                             ///< [m] of mass
  double leftmost = 0.0, rightmost = 0.0;  ///< [m] of the centres
};
SampleTotals TotalsOf(const ContactProblem& problem, const std::vector<Twist>& velocity, const std::vector<Pose>& pose);

/// Sum of the impulses on prescribed bodies [N s].
Vec2 ImpulseOnWalls(const ContactProblem& problem, const std::vector<Vec2>& impulse);

}  // namespace nscdd
