// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/contact_problem.h"
#include "nscdd/contact_table.h"
#include "nscdd/options.h"

namespace nscdd {

/// The table with its rows in ascending order of id.
BodyTable SortedById(const BodyTable& bodies);

/// The contact problem of a step of `dt` [s] as the TimeStepper makes it, from what an adapter said: V_f = V_i + dt M^-1 f,
/// b_n, scales. `bodies` at the beginning of the step, the rows of `contacts`. Contacts that the normal law does not see are
/// left out; subdomains are left to the solver.
ContactProblem AssembleStep(const BodyTable& bodies, const ContactTable& contacts, const SteppingOptions& stepping, double dt);

}  // namespace nscdd
