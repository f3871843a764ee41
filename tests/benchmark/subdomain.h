// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/step_problem.h"
#include "problem/subdomain_problem.h"

namespace nscdd::benchmark {

/// All contacts of a step's problem as one subdomain, in their order; built by the core's own parts outside of the TimeStepper.
SubdomainProblem BuildSubdomain(const StepProblem& step);

}  // namespace nscdd::benchmark
