#pragma once

#include <cstdint>
#include <vector>

#include "nlgs/residual.h"
#include "nscdd/body_table.h"
#include "nscdd/contact_table.h"
#include "nscdd/platform_adapter.h"
#include "problem/subdomain_problem.h"

namespace nscdd::benchmark {

/// The contact problem of one step (theta = 1/2, gap law, one subdomain), as the TimeStepper makes it, for answers that are not
/// its own.
struct StepProblem {
  BodyTable bodies;                     ///< at the beginning of the step, ascending ids
  ContactTable contacts;                ///< at q_m
  std::vector<double> inverse_mass;     ///< [1/kg] by row of bodies; 0: prescribed
  std::vector<double> inverse_inertia;  ///< [1/(kg m^2)]
  std::vector<Twist> free_velocity;     ///< V_f
  std::vector<double> offset;           ///< b_n [m/s] by row of contacts
  ResidualScales scales;
};

/// From what the adapter's host holds now. `alert` [m].
StepProblem ReadStepProblem(PlatformAdapter* adapter, double dt, double alert);

std::vector<std::int32_t> AllContacts(const StepProblem& problem);
/// `contacts`: rows of the table, in the order of the sweep.
SubdomainProblem BuildSubdomain(const StepProblem& problem, std::vector<std::int32_t> contacts);

/// How well velocities and impulses solve a step's problem.
struct AnswerResiduals {
  double nat = 0.0;        ///< [-]
  double nat_max = 0.0;    ///< [-]
  double imbalance = 0.0;  ///< [-] rms over free bodies of |V - V_f - M^-1 H r| (translation) over the scale of nat_max
};

/// `velocity` by row of bodies, `impulse` (r_n, r_t) by row of contacts; on the contacts `measured` only.
AnswerResiduals MeasureAnswer(const StepProblem& problem, const std::vector<Twist>& velocity, const std::vector<Vec2>& impulse,
                              std::vector<std::int32_t> measured);

/// Interpenetration max(0, -gap) of the host's bodies where they are now.
struct Interpenetration {
  double mean = 0.0;  ///< [m] over all pairs with gap <= alert
  double max = 0.0;   ///< [m]
};
Interpenetration MeasureInterpenetration(PlatformAdapter* adapter, double alert);

}  // namespace nscdd::benchmark
