#pragma once

#include <cstdint>
#include <vector>

#include "nlgs/residual.h"
#include "nscdd/body_table.h"
#include "nscdd/contact_table.h"
#include "nscdd/platform_adapter.h"
#include "problem/subdomain_problem.h"

namespace nscdd::benchmark {

/// The contact problem of one step (theta = 1/2, gap law, one subdomain), as the TimeStepper makes it, for answers that are not its own.
struct StepProblem {
  BodyTable bodies;        ///< at the beginning of the step, ascending ids
  ContactTable contacts;   ///< at q_m
  std::vector<double> inverse_mass;     ///< [1/kg] by row of bodies; 0: prescribed
  std::vector<double> inverse_inertia;  ///< [1/(kg m^2)]
  std::vector<Twist> free_velocity;     ///< V_f
  ResidualScales scales;
  SubdomainProblem subdomain;           ///< all contacts, in the order of the table
};

/// From what the adapter's host holds now. `alert` [m].
StepProblem ReadStepProblem(PlatformAdapter* adapter, double dt, double alert);

/// How well velocities and impulses solve a step's problem.
struct AnswerResiduals {
  double nat = 0.0;      ///< [-] of the velocities as given
  double nat_max = 0.0;  ///< [-]
  double nat_of_impulses = 0.0;      ///< [-] the same with V = V_f + M^-1 H r recomputed from the impulses
  double nat_max_of_impulses = 0.0;  ///< [-]
  double imbalance = 0.0;  ///< [-] rms over free bodies of |V - V_f - M^-1 H r| (translation) over the scale of nat_max
};

/// `velocity` by row of bodies, `impulse` (r_n, r_t) by row of contacts.
AnswerResiduals MeasureAnswer(const StepProblem& problem, const std::vector<Twist>& velocity, const std::vector<Vec2>& impulse);

/// Interpenetration max(0, -gap) of the host's bodies where they are now.
struct Interpenetration {
  double mean = 0.0;  ///< [m] over all pairs with gap <= alert
  double max = 0.0;   ///< [m]
};
Interpenetration MeasureInterpenetration(PlatformAdapter* adapter, double alert);

}  // namespace nscdd::benchmark
